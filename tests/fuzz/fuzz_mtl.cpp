// Materials of a model: colours, pictures, names.
#include "libskel/image/write_image.h"
#include "libskel/mesh/obj.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const std::string model = [] {
    Image picture(3, 2);
    picture.rgba.setConstant(128);
    fileOf(encodePng(picture), "skin.png");
    return fileOf(
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 2.5 0\nvt 0 1\n"
        "usemtl skin\nf 1/1 3/3 2/2\nusemtl red\nf 1/1 2/2 4/3\nusemtl none\nf 1 4 3\nusemtl\nf 2 3 4\n",
        "fuzz.obj");
  }();
  fileOf(textOf(data, size), "a.mtl");
  mayRefuse([&] {
    const TriangleMesh mesh = readObj(model);
    require(mesh.triangles.rows() == 4 && mesh.triangles.maxCoeff() < mesh.vertices.rows(),
            "faces are those of the model");
    require(mesh.uv.allFinite(), "texture coordinates are finite");
  });
  return 0;
}
