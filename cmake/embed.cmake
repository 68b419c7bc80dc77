# meshtween_embed(TARGET SYMBOL FILE): puts FILE's bytes into TARGET, from SYMBOL_begin to SYMBOL_end.
function(meshtween_embed target symbol file)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.S)
    file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[
    .section .rodata
    .balign 16
    .global @symbol@_begin
@symbol@_begin:
    .incbin "@file@"
    .global @symbol@_end
@symbol@_end:
    .byte 0
    .section .note.GNU-stack,"",%progbits
]])
    add_library(${symbol} OBJECT ${source})
    set_target_properties(${symbol} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS ${file})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${symbol}>)
endfunction()
