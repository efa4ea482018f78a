# One small library per folder.
#
#   pitwall_folder(DEPS <folder or library>... [ALONE <file>...])
#
# called from a/b/CMakeLists.txt makes the library pitwall_a_b of every .cpp in that folder but
# main.cpp (header-only folders become INTERFACE libraries). A dependency that is a folder of this
# tree is written as its path, e.g. protocol/can; anything else is passed to the linker as it is.
# ALONE: files that are not compiled together with others, see pitwall_unity.cmake.
# Where the folder has a main.cpp, pitwall_program(NAME) makes the program of it.

function(pitwall_target_name out path)
  string(REPLACE "/" "_" name "${path}")
  set(${out} "pitwall_${name}" PARENT_SCOPE)
endfunction()

function(pitwall_resolve_dependencies out)
  set(resolved)
  foreach(dependency IN LISTS ARGN)
    if(dependency MATCHES "^(protocol|vehicle|basestation|hil)(/|$)")
      pitwall_target_name(dependency "${dependency}")
    endif()
    list(APPEND resolved "${dependency}")
  endforeach()
  set(${out} "${resolved}" PARENT_SCOPE)
endfunction()

function(pitwall_folder)
  cmake_parse_arguments(ARG "" "" "DEPS;ALONE" ${ARGN})
  file(RELATIVE_PATH path "${CMAKE_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}")
  pitwall_target_name(name "${path}")
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  pitwall_resolve_dependencies(dependencies ${ARG_DEPS})
  if(sources)
    add_library(${name} STATIC ${sources})
    target_link_libraries(${name} PUBLIC pitwall_options ${dependencies})
    pitwall_precompiled(${name})
    pitwall_unity(${name} ${ARG_ALONE})
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE pitwall_options ${dependencies})
  endif()
endfunction()

function(pitwall_program program)
  cmake_parse_arguments(ARG "" "" "DEPS" ${ARGN})
  pitwall_resolve_dependencies(dependencies ${ARG_DEPS})
  add_executable(${program} "${CMAKE_CURRENT_SOURCE_DIR}/main.cpp")
  target_link_libraries(${program} PRIVATE pitwall_options ${dependencies})
  pitwall_precompiled(${program})
endfunction()

# Adds every direct subfolder that has a CMakeLists.txt.
function(pitwall_subfolders)
  file(GLOB lists CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*/CMakeLists.txt")
  foreach(list_file IN LISTS lists)
    get_filename_component(folder "${list_file}" DIRECTORY)
    add_subdirectory("${folder}")
  endforeach()
endfunction()
