# With SKEL_UNITY most rooms are compiled as one unit each: most of the time goes into the headers of Eigen and of JSON.
# Names of anonymous namespaces differ within each of these rooms, but for the files that stay by themselves.
if(NOT SKEL_UNITY)
  return()
endif()
set(alone mesh/obj mesh/planar_mesh silhouette/page silhouette/ruling skin/geodesic skin/volumetric video/video_writer)
foreach(room animation candidates classifier convnet core cutout deform draw export import jointnet labels mesh pipeline silhouette
             skeleton skin style video animating labeling styling)
  if(TARGET skel_${room})
    set_target_properties(skel_${room} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  endif()
endforeach()
foreach(file ${alone})
  get_filename_component(room ${file} DIRECTORY)
  if(TARGET skel_${room})
    set_source_files_properties(${PROJECT_SOURCE_DIR}/libskel/${file}.cpp TARGET_DIRECTORY skel_${room} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endforeach()
if(TARGET skel_styling)
  set_source_files_properties(${PROJECT_SOURCE_DIR}/stylizer/puppet_film.cpp ${PROJECT_SOURCE_DIR}/stylizer/style_file.cpp
    TARGET_DIRECTORY skel_styling PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endif()
