# Several files of a folder are compiled as one: most of the time that a small file takes is spent
# on the headers that its neighbours read too. The names in the anonymous namespaces of a folder are
# therefore all different. A batch is small, so that a change of one file is compiled within seconds.
# The presets with sanitizers build each file on its own, so that one that forgets an include of its
# own is found there.
option(PITWALL_UNITY "Several files of a folder are compiled as one" ON)

# pitwall_unity(TARGET [FILE...]): all files of a target but those that are named.
function(pitwall_unity target)
  if(PITWALL_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    if(ARGN)
      set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target}
        PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endif()
endfunction()
