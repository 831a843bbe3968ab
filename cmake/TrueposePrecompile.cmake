# truepose_precompile_by_folder(TARGET SUFFIX): with TRUEPOSE_PRECOMPILE, TARGET's sources begin with headers that most of them
# parse anyhow, compiled once: those of core or of what stands above it, by TARGET's folder; SUFFIX "_tests" adds GoogleTest.
# Off by default: ccache keeps nothing of such a build, and a header that a source forgets to include goes unnoticed.
option(TRUEPOSE_PRECOMPILE "Precompile common headers, for builds that find nothing in ccache" OFF)

function(truepose_precompile_by_folder name suffix)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  # compensation/ has options of its own, which precompiled headers do not fit.
  if(NOT TRUEPOSE_PRECOMPILE OR folder MATCHES "^(tests/)?compensation")
    return()
  endif()
  set(layer service)
  if(folder MATCHES "^(core|tests/core|tests/laws|tests/golden)(/|$)" OR NOT TRUEPOSE_BUILD_SERVICE)
    set(layer core)
  endif()
  target_precompile_headers(${name} REUSE_FROM truepose_${layer}${suffix}_headers)
  target_compile_options(${name} PRIVATE -pthread)  # gRPC has it, and they must agree
endfunction()

# precompiled_headers(NAME HEADERS header... LINKS library...): a library of one empty source.
function(precompiled_headers name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINKS" ${ARGN})
  set(empty ${PROJECT_BINARY_DIR}/precompiled/empty.cc)
  file(WRITE ${empty} "")
  add_library(${name} OBJECT ${empty})
  target_link_libraries(${name} PRIVATE truepose_options ${ARG_LINKS})
  target_compile_options(${name} PRIVATE -pthread)
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()

if(TRUEPOSE_PRECOMPILE)
  set(core_headers <Eigen/Dense> <algorithm> <array> <cmath> <cstdint> <functional> <map> <memory> <numbers> <optional>
    <random> <set> <string> <string_view> <utility> <vector> <absl/status/statusor.h> <absl/strings/str_cat.h>
    <absl/strings/str_format.h> <absl/strings/str_join.h> <absl/strings/str_split.h>)
  set(service_headers ${core_headers} <grpcpp/grpcpp.h> <chrono> <filesystem> <fstream> <mutex> <thread> <absl/time/time.h>)
  foreach(services admin_ compensation_table_ download_ plant_ recalibration_ "" watch_)
    list(APPEND service_headers <truepose/v1/${services}services.grpc.pb.h>)
  endforeach()
  set(core_links Eigen3::Eigen absl::status absl::statusor absl::strings absl::str_format)
  set(service_links ${core_links} truepose_proto_grpc)
  foreach(layer core service)
    if(layer STREQUAL core OR TRUEPOSE_BUILD_SERVICE)
      precompiled_headers(truepose_${layer}_headers HEADERS ${${layer}_headers} LINKS ${${layer}_links})
      if(TRUEPOSE_BUILD_TESTS)
        precompiled_headers(truepose_${layer}_tests_headers HEADERS ${${layer}_headers} <gmock/gmock.h> <gtest/gtest.h>
          LINKS ${${layer}_links} GTest::gmock)
      endif()
    endif()
  endforeach()
endif()
