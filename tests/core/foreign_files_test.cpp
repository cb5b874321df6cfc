#include "libskel/core/foreign_files.h"

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("whoever has a file that is not read learns what to convert it with, by its ending") {
  CHECK(howToConvert("a/Hero.FBX") ==
        "is an FBX file; open it in Blender and export it as glTF Binary (.glb), or as OBJ without its "
        "skeleton");
  CHECK(howToConvert("b.stl") ==
        "is an STL file: loose triangles without parts, colours or units; open it in "
        "Blender and export it as OBJ");
  CHECK(howToConvert("c d.svg") ==
        "is an SVG drawing; convert it by `rsvg-convert -h 1000 'c d.svg' -o out.png`");
  CHECK(howToConvert("e.pdf") == "is a PDF file; convert its pages by `pdftoppm -r 150 -png e.pdf page`");
  CHECK(howToConvert("f.heic") == "is a HEIC picture; convert it by `heif-convert f.heic out.png`");
  for (const char* ending : {".dae", ".gltf", ".blend", ".usdz", ".ply", ".avif", ".psd", ".xcf", ".kra"}) {
    CAPTURE(ending);
    CHECK(howToConvert(std::string("g") + ending).starts_with("is a"));
  }
  for (const char* known : {"h.png", "i.glb", "j.obj", "fbx", ""}) CHECK(howToConvert(known).empty());
}
