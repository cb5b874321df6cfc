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
        "is an SVG drawing; convert it by `rsvg-convert -h 1000 'c d.svg' -o 'c d.png'` (Debian's package "
        "librsvg2-bin)");
  CHECK(
      howToConvert("e.pdf") ==
      "is a PDF file; convert its pages by `pdftoppm -r 150 -png e.pdf e` (Debian's package poppler-utils)");
  CHECK(howToConvert("mixed/IMG_1.HEIC") ==
        "is a HEIC picture; convert it by `heif-convert mixed/IMG_1.HEIC mixed/IMG_1.png` (Debian's package "
        "libheif-examples)");
  // As some telephones name them.
  CHECK_THAT(howToConvert("f.jpg", ".heic"), Catch::Matchers::Contains("`heif-convert f.jpg f.png`"));
  CHECK_THAT(howToConvert("{}/{png}.heic"),
             Catch::Matchers::Contains("heif-convert '{}/{png}.heic' '{}/{png}.png'"));
  for (const char* ending : {".dae", ".gltf", ".blend", ".usdz", ".ply", ".avif", ".psd", ".xcf", ".kra"}) {
    CAPTURE(ending);
    CHECK(howToConvert(std::string("g") + ending).starts_with("is a"));
  }
  for (const char* known : {"h.png", "i.glb", "j.obj", "fbx", ""}) CHECK(howToConvert(known).empty());
}

TEST_CASE("a photo that lies beside what it was converted to is passed over, in whatever folder") {
  using Pictures = std::vector<std::string>;
  const auto left = [](Pictures pictures) {
    passOverConverted(pictures);
    return pictures;
  };
  CHECK(left({"Ömer.heic", "Ömer.png", "a.b.HEIC", "a.b.jpg"}) == Pictures{"Ömer.png", "a.b.jpg"});
  CHECK(left({"1/Eva.heic", "2/Eva.png", "Eva.avif", "Eva 2.png"}) ==
        Pictures{"1/Eva.heic", "2/Eva.png", "Eva.avif", "Eva 2.png"});
  CHECK(left({"Eva.heic", "Eva.avif"}) == Pictures{"Eva.heic", "Eva.avif"});
  CHECK(left({"Eva.jpg", "Eva.png"}) == Pictures{"Eva.jpg", "Eva.png"});
}
