# Debian's header holds the implementation too, which its library is not there for.
skel_headers(TinyGLTF::TinyGLTF tiny_gltf.h)
file(CONFIGURE OUTPUT tiny_gltf.cpp CONTENT "#define TINYGLTF_IMPLEMENTATION\n#include <fstream>\n#include <tiny_gltf.h>\n" @ONLY)
add_library(skel_tinygltf STATIC ${CMAKE_CURRENT_BINARY_DIR}/tiny_gltf.cpp)
target_compile_options(skel_tinygltf PRIVATE -w)
target_link_libraries(skel_tinygltf PRIVATE TinyGLTF::TinyGLTF nlohmann_json::nlohmann_json)
set_property(TARGET TinyGLTF::TinyGLTF APPEND PROPERTY INTERFACE_COMPILE_DEFINITIONS
  TINYGLTF_NO_FS TINYGLTF_NO_STB_IMAGE TINYGLTF_NO_STB_IMAGE_WRITE)
set_property(TARGET TinyGLTF::TinyGLTF APPEND PROPERTY INTERFACE_LINK_LIBRARIES skel_tinygltf)
set(TinyGLTF_FOUND ON)
