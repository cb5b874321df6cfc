# With SKEL_UNITY (but in the presets dev and tidy) every target of ours is compiled as one unit: most of the time goes
# into the headers of Eigen, JSON and Catch2. Names of anonymous namespaces differ within a target, but for the files
# that stay by themselves (skel_alone).
function(skel_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${SKEL_UNITY} UNITY_BUILD_BATCH_SIZE 0)
endfunction()

function(skel_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
