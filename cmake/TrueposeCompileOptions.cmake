# One place for the flags of every target. Assertions stay on in dev builds.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1")

find_program(TRUEPOSE_CCACHE ccache)
if(TRUEPOSE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${TRUEPOSE_CCACHE})
endif()

add_library(truepose_options INTERFACE)
# No contraction: a fused multiply-add in one build and not in another would give other bits.
target_compile_options(truepose_options INTERFACE -Wall -Wextra -Werror=return-type -ffp-contract=off)
target_include_directories(truepose_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_definitions(truepose_options INTERFACE TRUEPOSE_VERSION="${PROJECT_VERSION}")

if(TRUEPOSE_SANITIZE)
  # -O1, and no check of each pointer for null, alignment, type and size: in Eigen's templates these checks treble the
  # time to compile, and what they report the address sanitizer reports as well, but for alignment, which x86 allows.
  set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1")
  add_compile_options(-fsanitize=${TRUEPOSE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  if(TRUEPOSE_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize=null,alignment,vptr,object-size)
  endif()
  add_link_options(-fsanitize=${TRUEPOSE_SANITIZE})
endif()
