# Compiler options shared by every target. Presets switch sanitizers, fuzzing and coverage.
option(PITWALL_FUZZ "Build the libFuzzer targets (clang)" OFF)
option(PITWALL_COVERAGE "Instrument for llvm-cov (clang)" OFF)
set(PITWALL_SANITIZE "" CACHE STRING "Sanitizers for every target, e.g. address,undefined")

add_library(pitwall_options INTERFACE)
target_include_directories(pitwall_options INTERFACE "${CMAKE_SOURCE_DIR}" "${CMAKE_BINARY_DIR}/generated")
target_compile_options(pitwall_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor -Wold-style-cast
  -Werror
  # g++ 12 sees overlaps and overruns inside std::string operator+ that are not there (PR 105329, 105651).
  "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overflow>"
  # One build gives one result: no fused multiply-add, plain x86-64.
  -ffp-contract=off)
target_compile_definitions(pitwall_options INTERFACE
  PITWALL_SOURCE_DIR="${CMAKE_SOURCE_DIR}" EIGEN_MPL2_ONLY)

# The product's objects know their lines, so that a run can be followed through its files
# (tests/system/walks); programs are linked without them.
set(PITWALL_LINES "$<$<CONFIG:Release>:-g1>")
add_link_options("$<$<CONFIG:Release>:-Wl,--strip-debug>")

if(PITWALL_SANITIZE)
  add_compile_options(-fsanitize=${PITWALL_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${PITWALL_SANITIZE})
endif()
if(PITWALL_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
if(PITWALL_COVERAGE)
  add_compile_options(-fprofile-instr-generate -fcoverage-mapping)
  add_link_options(-fprofile-instr-generate)
endif()

find_program(PITWALL_CCACHE ccache)
if(PITWALL_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros;${PITWALL_CCACHE}")
endif()
