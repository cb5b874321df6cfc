# Read by cpack: which packages the programs need, and, recommended only, which the plugin for other formats of pictures needs.
set(work ${CPACK_PACKAGE_DIRECTORY}/depends)
file(MAKE_DIRECTORY ${work}/debian)
file(WRITE ${work}/debian/control "Source: skel\n\nPackage: skel\nArchitecture: any\n")
execute_process(COMMAND dpkg-shlibdeps -O -dDepends ${CPACK_SKEL_PROGRAMS} -dRecommends ${CPACK_SKEL_PLUGIN} WORKING_DIRECTORY ${work}
                OUTPUT_VARIABLE found ERROR_VARIABLE trouble RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "dpkg-shlibdeps: ${trouble}")
endif()
string(REGEX MATCH "shlibs:Depends=([^\n]*)" _ "${found}")
set(CPACK_DEBIAN_SKEL_PACKAGE_DEPENDS "${CMAKE_MATCH_1}")
string(REGEX MATCH "shlibs:Recommends=([^\n]*)" _ "${found}")
set(CPACK_DEBIAN_SKEL_PACKAGE_RECOMMENDS "${CMAKE_MATCH_1}")
