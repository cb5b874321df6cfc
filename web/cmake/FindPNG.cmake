# libpng and zlib, built from Debian's source packages (SKEL_WEB_SOURCES) for WebAssembly.
file(GLOB _zlib LIST_DIRECTORIES true ${SKEL_WEB_SOURCES}/zlib-1*)
file(GLOB _png LIST_DIRECTORIES true ${SKEL_WEB_SOURCES}/libpng1.6-1*)

set(_files adler32 compress crc32 deflate inffast inflate inftrees trees zutil)
list(TRANSFORM _files REPLACE "(.+)" "${_zlib}/\\1.c")
add_library(skel_zlib STATIC ${_files})
target_compile_options(skel_zlib PRIVATE -O3 -w)
target_include_directories(skel_zlib SYSTEM PUBLIC ${_zlib})

configure_file(${_png}/scripts/pnglibconf.h.prebuilt ${CMAKE_BINARY_DIR}/png/pnglibconf.h COPYONLY)
set(_files png pngerror pngget pngmem pngpread pngread pngrio pngrtran pngrutil pngset pngtrans pngwio pngwrite pngwtran
  pngwutil)
list(TRANSFORM _files REPLACE "(.+)" "${_png}/\\1.c")
add_library(skel_png STATIC ${_files})
target_compile_options(skel_png PRIVATE -O3 -w)
target_include_directories(skel_png SYSTEM PUBLIC ${_png} ${CMAKE_BINARY_DIR}/png)
target_link_libraries(skel_png PUBLIC skel_zlib)
add_library(PNG::PNG ALIAS skel_png)
set(PNG_FOUND ON)
