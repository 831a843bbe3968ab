# truepose_library(NAME SOURCES a.cc... [PUBLIC dep...] [PRIVATE dep...]): one library of a layer.
# PUBLIC only for what its headers show; everything else PRIVATE, so that a layer can't reach through another.
function(truepose_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  if(ARG_SOURCES)
    add_library(${name} STATIC ${ARG_SOURCES})
    target_link_libraries(${name} PUBLIC truepose_options ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
    truepose_precompile_by_folder(${name} "")
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE truepose_options ${ARG_PUBLIC})
  endif()
endfunction()
