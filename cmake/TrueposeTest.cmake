# truepose_test(NAME SOURCES a.cc... LINKS dep... [LABELS unit]): one test program; every TEST in it is a ctest test.
# TRUEPOSE_SHARED tells where the measured data are; tests that need them fail without them.
include(GoogleTest)
set(TRUEPOSE_SHARED "$ENV{TRUEPOSE_SHARED}" CACHE PATH "Folder with data/ and bench/ of measured robots")
if(NOT TRUEPOSE_SHARED)
  get_filename_component(TRUEPOSE_SHARED ${PROJECT_SOURCE_DIR}/../shared ABSOLUTE)
endif()

function(truepose_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LINKS;LABELS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE truepose_options ${ARG_LINKS} GTest::gmock GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE
    TRUEPOSE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" TRUEPOSE_BINARY_DIR="${PROJECT_BINARY_DIR}")
  truepose_precompile_by_folder(${name} _tests)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 TEST_PREFIX "${name}." PROPERTIES
    LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT "TRUEPOSE_SHARED=${TRUEPOSE_SHARED}")
endfunction()
