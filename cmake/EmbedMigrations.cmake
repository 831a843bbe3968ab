# truepose_embed_migrations(OUTPUT): a generated source file with every migrations/NNNN_name.sql in the order of numbers.
set(TRUEPOSE_WRITE_MIGRATIONS ${CMAKE_CURRENT_LIST_DIR}/WriteMigrations.cmake)

function(truepose_embed_migrations output)
  file(GLOB files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/migrations/*.sql)
  list(SORT files)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DFOLDER=${PROJECT_SOURCE_DIR}/migrations -P ${TRUEPOSE_WRITE_MIGRATIONS}
    DEPENDS ${files} ${TRUEPOSE_WRITE_MIGRATIONS} VERBATIM)
endfunction()
