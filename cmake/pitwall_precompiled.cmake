# Precompiled headers: one of the standard library for the folders and programs, one with GoogleTest
# beside it for the tests. Made once for the whole tree, because parsing these headers is most of
# the time that a small file takes. The presets with sanitizers build without them, so that a file
# that forgets an include of its own is found there.
option(PITWALL_PRECOMPILED "Precompiled headers of the standard library and of GoogleTest" ON)

set(PITWALL_STANDARD_HEADERS
  <algorithm> <array> <charconv> <chrono> <cmath> <cstdint> <cstdio> <cstring> <deque>
  <fstream> <functional> <iostream> <limits> <map> <memory> <numbers> <optional> <set> <span>
  <sstream> <string> <string_view> <system_error> <tuple> <utility> <variant> <vector>)

function(pitwall_make_precompiled name)
  if(NOT PITWALL_PRECOMPILED)
    return()
  endif()
  set(source "${CMAKE_BINARY_DIR}/generated/${name}.cpp")
  if(NOT EXISTS "${source}")
    file(WRITE "${source}" "// The precompiled header needs a source file of its own.\n")
  endif()
  add_library(${name} OBJECT "${source}")
  target_link_libraries(${name} PRIVATE pitwall_options)
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

function(pitwall_precompiled target)
  if(PITWALL_PRECOMPILED)
    target_precompile_headers(${target} REUSE_FROM pitwall_standard_headers)
  endif()
  target_compile_options(${target} PRIVATE ${PITWALL_LINES})
endfunction()

pitwall_make_precompiled(pitwall_standard_headers ${PITWALL_STANDARD_HEADERS})
if(TARGET pitwall_standard_headers)
  target_compile_options(pitwall_standard_headers PRIVATE ${PITWALL_LINES})
endif()
