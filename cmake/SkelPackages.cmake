# Debian packages by cpack -G DEB: skel (the tools), libskel-dev and skel-web. script/build-packages makes them.
set(CPACK_PACKAGE_NAME skel)
set(CPACK_PACKAGE_CONTACT "The skel authors <skel@example.org>" CACHE STRING "Who made the packages, with an address")
set(CPACK_PACKAGE_VENDOR "The skel authors")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
set(CPACK_COMPONENTS_ALL skel libskel-dev)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/package/config.cmake)
set(CPACK_SKEL_PROGRAMS skel-animate skel-infer skel-label skel-style skel-train)
list(TRANSFORM CPACK_SKEL_PROGRAMS PREPEND ${PROJECT_BINARY_DIR}/bin/)
set(CPACK_SKEL_PLUGIN ${PROJECT_BINARY_DIR}/lib/skel/skel_imgcodecs.so)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_SKEL_PACKAGE_NAME skel)
set(CPACK_DEBIAN_SKEL_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_SKEL_DESCRIPTION "The tools: skel-infer rigs drawings, or photos of them, and writes textured
models (.glb) with clips to move by; skel-animate makes films of them and edits
motions, skel-label mends joints and masks, skel-style learns motions from
cartoons, skel-train trains the nets.")
set(CPACK_DEBIAN_LIBSKEL-DEV_PACKAGE_NAME libskel-dev)
set(CPACK_DEBIAN_LIBSKEL-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBSKEL-DEV_PACKAGE_DEPENDS
    "libeigen3-dev (>= 3.4), libjpeg-dev, libopencv-core-dev, libopencv-imgproc-dev, libpng-dev, libtinygltf-dev (>= 2.7)")
set(CPACK_DEBIAN_LIBSKEL-DEV_DESCRIPTION "The library, for programs in C++20: headers, static libraries and CMake files.
find_package(skel CONFIG) brings skel::skel to link with.")

# What else lies in them: the manual and completion, told by the tools themselves, and what Debian wants to know.
set(manual ${PROJECT_BINARY_DIR}/manual)
set(tools skel-animate skel-infer skel-label skel-style skel-train)
list(TRANSFORM tools REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE tool_files)
add_custom_command(OUTPUT ${manual}/done
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${manual}
  COMMAND ${PROJECT_SOURCE_DIR}/cmake/package/make-manual ${manual} ${PROJECT_VERSION} ${tool_files}
  COMMAND ${CMAKE_COMMAND} -E touch ${manual}/done
  DEPENDS ${tools} ${PROJECT_SOURCE_DIR}/cmake/package/make-manual ${PROJECT_SOURCE_DIR}/cmake/package/help.awk
          ${PROJECT_SOURCE_DIR}/cmake/package/completion.awk
  VERBATIM)
add_custom_target(skel_manual ALL DEPENDS ${manual}/done)
install(DIRECTORY ${manual}/man ${manual}/bash-completion ${manual}/zsh DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT skel)
install(DIRECTORY integrations/ DESTINATION ${CMAKE_INSTALL_DATADIR}/skel COMPONENT skel)

# A package of its own, where script/build-web has made the page.
set(page ${PROJECT_SOURCE_DIR}/build/web/skel.html)
if(EXISTS ${page})
  list(APPEND CPACK_COMPONENTS_ALL skel-web)
  set(CPACK_DEBIAN_SKEL-WEB_PACKAGE_NAME skel-web)
  set(CPACK_DEBIAN_SKEL-WEB_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_SKEL-WEB_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_SKEL-WEB_DESCRIPTION "The same in a browser, offline: open /usr/share/skel/skel.html, or copy it
to any other machine.")
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_DATADIR}/skel COMPONENT skel-web)
endif()

execute_process(COMMAND date -R --date=@$ENV{SOURCE_DATE_EPOCH} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
configure_file(cmake/package/changelog.in changelog @ONLY)
execute_process(COMMAND gzip -9nkf changelog WORKING_DIRECTORY ${PROJECT_BINARY_DIR} COMMAND_ERROR_IS_FATAL ANY)
foreach(package ${CPACK_COMPONENTS_ALL})
  install(FILES ${PROJECT_BINARY_DIR}/changelog.gz ${PROJECT_SOURCE_DIR}/cmake/package/copyright
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${package})
endforeach()
include(CPack)
