# cmake --install: the library, its headers and find_package(meshtween).
include(CMakePackageConfigHelpers)
set(destination ${CMAKE_INSTALL_LIBDIR}/cmake/meshtween)
install(TARGETS meshtween EXPORT meshtweenTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT meshtweenTargets NAMESPACE meshtween:: DESTINATION ${destination})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/meshtween TYPE INCLUDE FILES_MATCHING PATTERN "*.h" PATTERN "report.h" EXCLUDE)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/meshtweenConfig.cmake.in
    ${PROJECT_BINARY_DIR}/meshtweenConfig.cmake INSTALL_DESTINATION ${destination})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/meshtweenConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/meshtweenConfig.cmake ${PROJECT_BINARY_DIR}/meshtweenConfigVersion.cmake
    DESTINATION ${destination})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
