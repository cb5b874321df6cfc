# The library as others see it: skel::skel, and each room by itself as skel::<room>; for add_subdirectory and, after
# cmake --install, for find_package(skel CONFIG).
include(CMakePackageConfigHelpers)

set(SKEL_LIBRARY_ROOMS core image convnet silhouette candidates classifier mesh skeleton jointnet recognition layers draw
                       animation skin deform cutout labels style export import pipeline)
set(skel_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/skel)

add_library(skel INTERFACE)
add_library(skel::skel ALIAS skel)
add_custom_target(skel-installed) # all that cmake --install takes, without the tests; skel_tool() adds the tools
if(TARGET skel_imgcodecs)
  add_dependencies(skel-installed skel_imgcodecs)
endif()
foreach(room ${SKEL_LIBRARY_ROOMS})
  add_dependencies(skel-installed skel_${room})
  add_library(skel::${room} ALIAS skel_${room})
  set_target_properties(skel_${room} PROPERTIES EXPORT_NAME ${room})
  target_link_libraries(skel INTERFACE skel_${room})
  install(TARGETS skel_${room} EXPORT skelTargets)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/libskel/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/libskel
          FILES_MATCHING PATTERN "*.h" PATTERN plugin EXCLUDE PATTERN "*_impl.h" EXCLUDE) # the latter are included several times, for several processors
endforeach()
set_target_properties(skel_usage PROPERTIES EXPORT_NAME usage)
install(TARGETS skel skel_usage EXPORT skelTargets)
install(EXPORT skelTargets NAMESPACE skel:: DESTINATION ${skel_config_dir})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/skelConfig.cmake.in ${PROJECT_BINARY_DIR}/skelConfig.cmake
                              INSTALL_DESTINATION ${skel_config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/skelConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/skelConfig.cmake ${PROJECT_BINARY_DIR}/skelConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindOpenCVLite.cmake DESTINATION ${skel_config_dir})
if(NOT SKEL_PACKAGES) # which name it as Debian does
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
endif()
