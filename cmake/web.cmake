# The pages (the player of exported HTML files, the studio) are TypeScript, bundled by Vite with the packages of
# package-lock.json. npm fetches them once into node_modules; building needs Node 18 or later, running needs neither.
find_program(MESHTWEEN_NODE NAMES node nodejs REQUIRED)
find_program(MESHTWEEN_NPM npm REQUIRED)

set(MESHTWEEN_NODE_MODULES ${PROJECT_SOURCE_DIR}/node_modules/.package-lock.json) # npm writes it last
add_custom_command(OUTPUT ${MESHTWEEN_NODE_MODULES}
    COMMAND ${MESHTWEEN_NPM} ci --silent
    COMMAND ${CMAKE_COMMAND} -E touch ${MESHTWEEN_NODE_MODULES}
    DEPENDS ${PROJECT_SOURCE_DIR}/package.json ${PROJECT_SOURCE_DIR}/package-lock.json
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} COMMENT "Fetching the pages' packages" VERBATIM)
add_custom_target(meshtween_node_modules DEPENDS ${MESHTWEEN_NODE_MODULES})

# meshtween_page(FOLDER OUTPUTS file... SOURCES file...): checks the types of FOLDER, a Vite project with a
# vite.config.mjs and a tsconfig.json, and builds it into ${CMAKE_CURRENT_BINARY_DIR}/page, which then holds OUTPUTS.
function(meshtween_page folder)
    cmake_parse_arguments(PARSE_ARGV 1 page "" "" "OUTPUTS;SOURCES")
    list(TRANSFORM page_OUTPUTS PREPEND ${CMAKE_CURRENT_BINARY_DIR}/page/)
    list(TRANSFORM page_SOURCES PREPEND ${folder}/)
    add_custom_command(OUTPUT ${page_OUTPUTS}
        COMMAND ${MESHTWEEN_NODE} node_modules/typescript/bin/tsc --noEmit -p ${folder}
        COMMAND ${MESHTWEEN_NODE} node_modules/vite/bin/vite.js build ${folder} --outDir ${CMAKE_CURRENT_BINARY_DIR}/page
            --emptyOutDir --logLevel warn
        DEPENDS ${page_SOURCES} ${folder}/vite.config.mjs ${folder}/tsconfig.json meshtween_node_modules
        WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} COMMENT "Building the page of ${folder}" VERBATIM)
endfunction()
