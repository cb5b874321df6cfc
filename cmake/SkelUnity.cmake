# With SKEL_UNITY every target is compiled as one unit: most of the time goes into the headers of Eigen, JSON and Catch2.
# Names of anonymous namespaces differ within a target, but for the files that stay by themselves (skel_alone).
if(SKEL_UNITY)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 0)
endif()

function(skel_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
