# Compiler settings that every target of ramus shares.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

add_library(ramus_options INTERFACE)
target_compile_options(ramus_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wno-unused-parameter
  # The same expression must give the same bits wherever it is inlined: samples that two bricks share are computed
  # twice and have to agree.
  -ffp-contract=off)
target_compile_definitions(ramus_options INTERFACE RAMUS_VERSION="${PROJECT_VERSION}")
