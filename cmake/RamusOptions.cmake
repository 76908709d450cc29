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
option(RAMUS_WERROR "Warnings are errors; scripts/check turns it on" OFF)
if(RAMUS_WERROR)
  target_compile_options(ramus_options INTERFACE -Werror)
endif()
target_compile_definitions(ramus_options INTERFACE RAMUS_VERSION="${PROJECT_VERSION}")

# Everything is told apart by which of its branches an input reaches, and watched by the sanitizers. One instruction set
# is enough for that, and compiles in half the time.
option(RAMUS_FUZZ "Build what scripts/fuzz runs, and nothing else; takes clang++" OFF)
if(RAMUS_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "RAMUS_FUZZ takes clang++, which has libFuzzer: cmake --preset fuzz")
  endif()
  add_compile_definitions(HWY_COMPILE_ONLY_STATIC)
  string(APPEND CMAKE_CXX_FLAGS " -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined"
                                " -fno-omit-frame-pointer")
endif()

# Whether the flags have a sanitizer, as the presets asan and tsan do. It takes memory of its own, which tests allow for.
set(RAMUS_SANITIZED OFF)
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=")
  set(RAMUS_SANITIZED ON)
endif()

# For code that runs once and is read by few: the command line and the tests. Most of the time of compiling it would go
# into optimizing CLI11 and doctest.
add_library(ramus_lightly_optimized INTERFACE)
target_compile_options(ramus_lightly_optimized INTERFACE $<$<CONFIG:Release>:-O1>)
