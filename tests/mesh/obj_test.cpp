#include "libskel/mesh/obj.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <iostream>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/image/write_image.h"
#include "libskel/mesh/read_mesh.h"
#include "tests/support/catch.h"
#include "tests/support/temp_dir.h"

using namespace skel;

namespace {

TriangleMesh read(const std::string& text) {
  const TempDir dir;
  writeFile(dir.file("a.obj"), text);
  return readObj(dir.file("a.obj"));
}

std::string complaint(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.problem();
  }
  return "none";
}

// Of the texture at a corner of a triangle, drawn a little to its middle.
Eigen::Vector3i colorAt(const TriangleMesh& mesh, int triangle, int corner) {
  Eigen::RowVector2f uv = Eigen::RowVector2f::Zero();
  for (int k = 0; k < 3; ++k) uv += (k == corner ? 0.8f : 0.1f) * mesh.uv.row(mesh.triangles(triangle, k));
  const std::uint8_t* pixel =
      mesh.texture.pixel(std::clamp(static_cast<int>(uv.x() * static_cast<float>(mesh.texture.width)), 0,
                                    mesh.texture.width - 1),
                         std::clamp(static_cast<int>(uv.y() * static_cast<float>(mesh.texture.height)), 0,
                                    mesh.texture.height - 1));
  return {pixel[0], pixel[1], pixel[2]};
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("all forms of faces are read") {
  for (const std::string face :
       {"f 1 2 3 4", "f 1// 2// 3// 4//", "f 1//9 2//9 3//9 4//9", "f -4 -3 -2 -1", "f 1 2 3\nf 1 3 4",
        "f 1 2 3 \\\n 4", "f 1 2 3 4 # a comment\r", "f 1 2 3 4 4"}) {
    INFO(face);
    const TriangleMesh mesh =
        read(kSquare + "# comment\r\no thing\ng group\ns off\nvn 0 0 1\n" + face + "\n");
    CHECK(mesh.vertices.rows() == 4);
    REQUIRE(mesh.triangles.rows() == 2);
    CHECK(mesh.triangles.row(1) == Eigen::RowVector3i(0, 2, 3));
    CHECK(mesh.uv.rows() == 0);
  }
  CHECK(read("v 1e-1 +2 .5 1.0\nv 1 0 0\nv 0 0 1\nf 1 2 3").vertices.row(0) ==
        Eigen::RowVector3f(0.1f, 2, 0.5f));
}

TEST_CASE("a concave face does not cover its notch") {
  const TriangleMesh mesh = read("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 2 3 4 5 6 1\n");
  REQUIRE(mesh.triangles.rows() == 4);
  double area = 0;
  for (Eigen::Index t = 0; t < 4; ++t) {
    const Eigen::Vector3f a = mesh.vertices.row(mesh.triangles(t, 0)),
                          b = mesh.vertices.row(mesh.triangles(t, 1)),
                          c = mesh.vertices.row(mesh.triangles(t, 2));
    area += 0.5 * static_cast<double>((b - a).cross(c - a).norm());
  }
  CHECK(area == Approx(4));
}

TEST_CASE("the texture is found through the material that is used") {
  const TempDir dir;
  Image picture(2, 1);
  picture.rgba << 255, 0, 0, 255, 0, 0, 255, 255;
  writeFile(dir.file("my picture.png"), encodePng(picture));
  writeFile(dir.file("a.mtl"),
            "newmtl other\r\nmap_Kd nowhere.png\r\nnewmtl skin\r\nKd 1 1 1\r\nmap_Kd my picture.png\r\n");
  const std::string text =
      "mtllib a.mtl\nusemtl skin\n" + kSquare + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\n";
  writeFile(dir.file("a.obj"), text + "f 1/1 2/2 3/3\nf 1/5/1 3/3/1 4/4/1\n");
  const TriangleMesh mesh = readObj(dir.file("a.obj"));
  CHECK(mesh.texture.width == 2);
  CHECK(mesh.vertices.rows() == 5);  // the first is split
  CHECK(mesh.uv.row(0) == Eigen::RowVector2f(0, 1));
  CHECK(mesh.uv.row(4) == Eigen::RowVector2f(0.5f, 0.5f));

  writeFile(dir.file("a.obj"), text + "f 1/1 2/2 3/3\nf 1 3 4\n");
  const TriangleMesh mixed =
      readObj(dir.file("a.obj"));  // a face without coordinates has the material's colour
  CHECK(colorAt(mixed, 0, 0) == Eigen::Array3i(255, 0, 0).matrix());
  CHECK(colorAt(mixed, 1, 0) == Eigen::Array3i(255, 255, 255).matrix());
  writeFile(dir.file("b.obj"), "mtllib gone.mtl\n" + text.substr(13) + "f 1/1 2/2 3/3\n");
  CHECK_THROWS_AS(readObj(dir.file("b.obj")), InputError);
}

TEST_CASE("vertices stand in the order of their lines, copies for seams after them") {
  const std::string other = "v 5 5 5\n";  // of no face
  const TempDir dir;
  Image picture(2, 2);
  picture.rgba.setConstant(200);
  writeFile(dir.file("a.png"), encodePng(picture));
  writeFile(dir.file("a.mtl"), "newmtl a\nmap_Kd a.png\n");
  writeFile(dir.file("a.obj"), "mtllib a.mtl\nusemtl a\n" + other + kSquare +
                                   "vt 0 0\nvt 1 0\nvt 1 1\nf 5/1 4/2 2/3\nf 2/1 4/1 3/2\n");
  const TriangleMesh mesh = readObj(dir.file("a.obj"));
  CHECK(mesh.file_vertices == 5);
  CHECK(mesh.file_vertex == Eigen::Vector<int, 6>(1, 2, 3, 4, 1, 3));
  CHECK(mesh.triangles.row(0) == Eigen::RowVector3i(3, 2, 0));
  CHECK(mesh.triangles.row(1) == Eigen::RowVector3i(4, 5, 1));
  for (int v = 0; v < 2; ++v) CHECK(mesh.vertices.row(4 + v) == mesh.vertices.row(2 * v));

  CHECK(read(kSquare + "f 4 3 2\nf 4 2 1\n").file_vertex == Eigen::Vector4i(0, 1, 2, 3));
}

TEST_CASE("several materials, pictures and colours, become one texture") {
  const TempDir dir;
  Image picture(2, 2);  // red green / blue yellow
  picture.rgba << 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 0, 255;
  writeFile(dir.file("a.png"), encodePng(picture));
  Image other(3, 1);
  other.rgba << 10, 20, 30, 255, 10, 20, 30, 255, 10, 20, 30, 255;
  writeFile(dir.file("b.png"), encodePng(other));
  writeFile(dir.file("a.mtl"),
            "newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd b.png\nnewmtl c\nKd 0.2 0.4 0.6\nnewmtl unused\nmap_Kd "
            "gone.png\n");
  // In objects and groups, with indices that count backwards, normals or not; the first picture repeats.
  writeFile(dir.file("a.obj"),
            "mtllib a.mtl\no first\ng left arm\n" + kSquare +
                "vt 0.05 0.95\nvt 2.75 0.95\nvt 0.05 0.3\nvn 0 0 1\n"
                "usemtl a\nf 1/1/1 2/2/1 3/3/1\no second\ng\nusemtl b\nf -4/-3 -2/-2 -1/-1\n"
                "usemtl c\nf 1 2 4\nusemtl unknown\nf 1/1 2/2 4/3\n");
  const TriangleMesh mesh = readObj(dir.file("a.obj"));
  REQUIRE(mesh.triangles.rows() == 4);
  CHECK(mesh.uv.minCoeff() >= 0);
  CHECK(mesh.uv.maxCoeff() <= 1);
  CHECK(mesh.texture.width >= 6 + 2 * 2);
  CHECK(colorAt(mesh, 1, 0) == Eigen::Vector3i(10, 20, 30));
  CHECK(colorAt(mesh, 2, 1) == Eigen::Vector3i(51, 102, 153));
  CHECK(colorAt(mesh, 3, 1) == Eigen::Vector3i(255, 255, 255));
  // The corners themselves: u = 0.05 red, u = 2.75 green (two repeats further), v = 0.7 down blue.
  const auto at = [&](int corner) {
    const Eigen::RowVector2f uv = mesh.uv.row(mesh.triangles(0, corner));
    const std::uint8_t* pixel =
        mesh.texture.pixel(static_cast<int>(uv.x() * static_cast<float>(mesh.texture.width)),
                           static_cast<int>(uv.y() * static_cast<float>(mesh.texture.height)));
    return Eigen::Vector3i(pixel[0], pixel[1], pixel[2]);
  };
  CHECK(at(0) == Eigen::Vector3i(255, 0, 0));
  CHECK(at(1) == Eigen::Vector3i(0, 255, 0));
  CHECK(at(2) == Eigen::Vector3i(0, 0, 255));

  writeFile(dir.file("a.obj"), "mtllib a.mtl\n" + kSquare +
                                   "vt 0 0\nvt 9999 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\nusemtl c\nf 1 2 4\n");
  CHECK_THROWS_WITH(readObj(dir.file("a.obj")),
                    Catch::Contains("its textures do not fit into one of 8192 px a side"));
}

TEST_CASE("a file of 200,000 vertices is read well within a second") {
  std::string text = "mtllib a.mtl\nusemtl a\n";
  constexpr int kSide = 448;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      text += "v " + std::to_string(0.01 * x) + " " + std::to_string(0.01 * y) + " 0.25\nvt 0.5 0.25\n";
  for (int y = 0; y + 1 < kSide; ++y)
    for (int x = 0; x + 1 < kSide; ++x) {
      const int v = y * kSide + x + 1;
      text += "f";
      for (const int corner : {v, v + 1, v + kSide + 1, v + kSide})
        text += " " + std::to_string(corner) + "/" + std::to_string(corner);
      text += "\n";
    }
  const TempDir dir;
  writeFile(dir.file("a.png"), encodePng(Image(2, 2)));
  writeFile(dir.file("a.mtl"), "newmtl a\nmap_Kd a.png\n");
  writeFile(dir.file("a.obj"), text);
  const std::clock_t start = std::clock();
  const TriangleMesh mesh = readObj(dir.file("a.obj"));
  const double took_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  CHECK(mesh.vertices.rows() == kSide * kSide);
  CHECK(mesh.triangles.rows() == 2 * (kSide - 1) * (kSide - 1));
  std::cout << "200,000 vertices read in " << took_s << " s\n";
#if defined(NDEBUG) && !defined(SKEL_SANITIZED)
  CHECK(took_s < 1);
#endif
}

TEST_CASE("models are told by the ending of their names") {
  const TempDir dir;
  writeFile(dir.file("a.OBJ"), kSquare + "f 1 2 3\n");
  CHECK(readMesh(dir.file("a.OBJ")).triangles.rows() == 1);
  CHECK_THROWS_WITH(
      readMesh(dir.file("a.stl")),
      Catch::EndsWith("a.stl: is an STL file: loose triangles without parts, colours or units; open it "
                      "in Blender and export it as OBJ"));
  CHECK_THROWS_WITH(readMesh(dir.file("a.fbx")),
                    Catch::EndsWith("a.fbx: is an FBX file; open it in Blender and export it as glTF Binary "
                                    "(.glb), or as OBJ without its skeleton"));
}

TEST_CASE("a model without height is refused") {
  CHECK(complaint("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n") ==
        "is flat: it has no height along y; turn it so that y points up");
  CHECK(complaint("v 0 0 0\nv 1e6 1e-20 0\nv 0 1e-20 1\nf 1 2 3\n") ==
        "is flat: it has no height along y; turn it so that y points up");
}

TEST_CASE("bad models are refused with the line") {
  CHECK(complaint("") == "holds no faces; export the model as a polygon mesh");
  CHECK(complaint(kSquare) == "holds no faces; export the model as a polygon mesh");
  CHECK(complaint("v 0 0 nan\n") == "line 1: 'nan' is not a finite number");
  CHECK(complaint("v 0 1e30 0\n") == "line 1: a vertex is farther than 1e6 from the origin");
  CHECK(complaint("\n\nv 0 0 1e99\n") == "line 3: '1e99' is not a finite number");
  CHECK(complaint("v 0 0\n") == "line 1: 'v' needs 3 numbers");
  CHECK(complaint("v 0 0 0x\n") == "line 1: '0x' is not a finite number");
  CHECK(complaint(kSquare + "f 1 2\n") == "line 5: a face needs at least 3 corners");
  CHECK(complaint(kSquare + "f 1 2 5\n") == "line 5: there is no vertex 5; 4 are defined so far");
  CHECK(complaint(kSquare + "f 0 1 2\n") == "line 5: there is no vertex 0; 4 are defined so far");
  CHECK(complaint(kSquare + "f -5 1 2\n") == "line 5: there is no vertex -5; 4 are defined so far");
  CHECK(complaint(kSquare + "f 1/1 2/1 3/1\n") ==
        "line 5: there is no texture coordinate 1; 0 are defined so far");
  CHECK(complaint(kSquare + "f 1 2 x\n") == "line 5: 'x' is not the index of a vertex");
  CHECK(complaint(kSquare + "f 1 2 99999999999\n") == "line 5: '99999999999' is not the index of a vertex");
  std::string face = kSquare + "f";
  for (int k = 0; k < 10001; ++k) face += " " + std::to_string(k % 4 + 1);
  CHECK(complaint(face) ==
        "line 5: a face has 10001 corners, at most 10000 are read; export the model as triangles");
  CHECK_THROWS_AS(readObj("/nowhere/a.obj"), InputError);
}

namespace {

// A square for each of these pictures, each by a material of its own.
std::string squaresOf(const std::vector<std::string>& pictures, const TempDir& dir) {
  std::string obj = "mtllib a.mtl\n" + kSquare + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n", mtl;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    obj += "usemtl m" + std::to_string(i) + "\nf 1/1 2/2 3/3 4/4\n";
    mtl += "newmtl m" + std::to_string(i) + "\nmap_Kd " + pictures[i] + "\n";
  }
  writeFile(dir.file("a.mtl"), mtl);
  writeFile(dir.file("a.obj"), obj);
  return dir.file("a.obj");
}

}  // namespace

TEST_CASE("one picture under many names is one texture") {
  const TempDir dir;
  Image image(64, 32);
  image.rgba.setConstant(200);
  writeFile(dir.file("a.png"), encodePng(image));
  std::filesystem::create_symlink("a.png", dir.file("b.png"));
  const TriangleMesh mesh = readObj(squaresOf({"a.png", "./a.png", "././a.png", "x/../a.png", "b.png"}, dir));
  CHECK(mesh.texture.width == 64);
  CHECK(mesh.texture.height == 32);
}

TEST_CASE("textures that do not fit are refused before all of them are read") {
  const TempDir dir;
  Image image(6000, 6000);
  image.rgba.setConstant(255);
  const std::string png = encodePng(image);
  writeFile(dir.file("a.png"), png);
  writeFile(dir.file("b.png"), png);
  CHECK_THROWS_WITH(readObj(squaresOf({"a.png", "b.png", "not-there.png"}, dir)),
                    Catch::Matchers::Contains("its textures do not fit into one of 8192 px a side"));
}

TEST_CASE("many materials, and one library named many times, are read in time") {
  const TempDir dir;
  std::string obj = kSquare, mtl;
  for (int i = 0; i < 100'000; ++i) {
    obj += "mtllib a.mtl\nusemtl m" + std::to_string(i) + "\nf 1 2 3\n";
    mtl += "newmtl m" + std::to_string(i) + "\nKd 1 0 0\n";
  }
  writeFile(dir.file("a.mtl"), mtl);
  writeFile(dir.file("a.obj"), obj);
  CHECK(readObj(dir.file("a.obj")).triangles.rows() == 100'000);
}

TEST_CASE("a model names up to 100 files of materials, whether they are one file or many") {
  const TempDir dir;
  writeFile(dir.file("a.mtl"), "newmtl red\nKd 1 0 0\n");
  std::string libraries;
  for (std::size_t i = 1; i <= 100; ++i) libraries += "mtllib ." + std::string(i, '/') + "a.mtl\n";
  writeFile(dir.file("a.obj"), libraries + kSquare + "usemtl red\nf 1 2 3 4\n");
  CHECK(readObj(dir.file("a.obj")).texture.rgba(0, 1) == 0);
  CHECK(complaint(libraries + "mtllib b.mtl\n") ==
        "line 101: the model names more than 100 files of materials; join them");
}

TEST_CASE("faces of many corners are cut up to a sum, and refused beyond") {
  std::string face = "f";
  for (int k = 0; k < 10'000; ++k) face += " 1";
  std::string faces = kSquare;
  for (int k = 0; k < 6; ++k) faces += face + "\n";
  CHECK(complaint(faces) ==
        "line 10: the faces have too many corners to be cut; export the model as triangles");
}
