// The model from behind, from the side and of a drawing that was turned.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "libskel/mesh/back_colors.h"
#include "libskel/mesh/inflate.h"
#include "libskel/mesh/local_mean.h"
#include "libskel/mesh/outline_band.h"
#include "libskel/mesh/split_seams.h"
#include "tests/support/catch.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;

namespace {

void paintDisc(Image& image, const Eigen::Vector2d& center, double radius, const std::array<int, 3>& color) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if ((Eigen::Vector2d(x, y) - center).norm() <= radius)
        for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = static_cast<std::uint8_t>(color[c]);
}

// Orange, with two black eyes in the head and a white button on the body.
Image withFace(const CapsuleFigure& figure) {
  Image image = capsuleImage(figure);
  for (Eigen::Index i = 0; i < image.rgba.rows(); ++i)
    if (image.rgba(i, 0) == 60) image.rgba.row(i) << 230, 150, 60, 255;
  const Skeleton skeleton = capsuleSkeleton(figure);
  const Eigen::Vector2d head = skeleton.joints[skeleton.index("head")].image;
  paintDisc(image, head - Eigen::Vector2d(14, 4), 6, {0, 0, 0});
  paintDisc(image, head + Eigen::Vector2d(14, -4), 6, {0, 0, 0});
  paintDisc(image, skeleton.joints[skeleton.index("body")].image, 9, {255, 255, 255});
  return image;
}

// A ball drawn by a black line `width` px wide, yellow inside.
Image outlinedBall(int size, double radius, double width) {
  Image image(size, size);
  image.rgba.setConstant(255);
  const Eigen::Vector2d middle = Eigen::Vector2d::Constant(0.5 * (size - 1));
  paintDisc(image, middle, radius, {0, 0, 0});
  paintDisc(image, middle, radius - width, {250, 210, 60});
  return image;
}

Plane8 notWhite(const Image& image) {
  Plane8 mask = Plane8::Zero(image.height, image.width);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.pixel(x, y)[2] < 255) mask(y, x) = 255;
  return mask;
}

int darkTexels(const Image& image) { return static_cast<int>((image.rgba.col(0) < 100).count()); }

// Of the surface that is seen from the side, the share whose texture is dark.
double darkFromTheSide(const TriangleMesh& mesh) {
  double dark = 0, all = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::Vector3d a = mesh.vertices.row(mesh.triangles(t, 0)).cast<double>(),
                          b = mesh.vertices.row(mesh.triangles(t, 1)).cast<double>(),
                          c = mesh.vertices.row(mesh.triangles(t, 2)).cast<double>();
    const double seen = (b - a).cross(c - a).x();
    if (seen <= 0) continue;
    constexpr int kSteps = 6;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j + i < kSteps; ++j) {
        const float u = (i + 0.33f) / kSteps, v = (j + 0.33f) / kSteps;
        const Eigen::RowVector2f uv =
            (1 - u - v) * mesh.uvOf(t, 0) + u * mesh.uvOf(t, 1) + v * mesh.uvOf(t, 2);
        const int x = std::min(mesh.texture.width - 1, static_cast<int>(uv.x() * mesh.texture.width));
        const int y = std::min(mesh.texture.height - 1, static_cast<int>(uv.y() * mesh.texture.height));
        all += seen;
        if (mesh.texture.pixel(x, y)[0] < 125) dark += seen;
      }
  }
  return dark / all;
}

}  // namespace

TEST_CASE("no face on the back of the head, no button on the back") {
  const CapsuleFigure figure;
  const Image image = withFace(figure);
  const Plane8 mask = capsuleMask(figure);
  HeadDisc head{capsuleSkeleton(figure).joints[3].image, 40};
  const Image back = backColors(image, mask, head);
  CHECK(darkTexels(image) > 150);
  CHECK(darkTexels(back) == 0);
  for (int y = 0; y < back.height; ++y)
    for (int x = 0; x < back.width; ++x)
      if (mask(y, x)) {
        REQUIRE(std::abs(back.pixel(x, y)[0] - 230) < 12);
        REQUIRE(std::abs(back.pixel(x, y)[2] - 60) < 25);
      }
}

TEST_CASE("the back of the head is hair where hair is at its rim, and the head's colour where none is") {
  // A ball of skin, above and beside it hair.
  Image image(200, 200);
  image.rgba.setConstant(255);
  const Eigen::Vector2d middle(100, 100);
  const bool has_hair = GENERATE(true, false);
  if (has_hair) paintDisc(image, middle, 80, {90, 50, 20});
  paintDisc(image, has_hair ? Eigen::Vector2d(100, 108) : middle, has_hair ? 66 : 80, {240, 200, 160});
  paintDisc(image, {80, 95}, 7, {0, 0, 0});
  paintDisc(image, {120, 95}, 7, {0, 0, 0});
  const Plane8 mask = notWhite(image);
  const Image back = backColors(image, mask, HeadDisc{middle, 80});
  for (int y = 60; y < 130; ++y)
    for (int x = 60; x < 140; ++x) REQUIRE(std::abs(back.pixel(x, y)[0] - (has_hair ? 90 : 240)) < 10);
}

TEST_CASE("a cap covers the back of the head down to the ears, without its badge, and the neck is bare") {
  Image image(200, 200);
  image.rgba.setConstant(255);
  const Eigen::Vector2d middle(100, 100);
  paintDisc(image, middle, 80, {240, 200, 160});
  for (int y = 0; y < 85; ++y)
    for (int x = 0; x < 200; ++x)
      if (image.pixel(x, y)[0] == 240) image.pixel(x, y)[0] = 30, image.pixel(x, y)[1] = 90;
  paintDisc(image, {100, 55}, 12, {255, 220, 0});
  paintDisc(image, {75, 105}, 8, {0, 0, 0});
  const Plane8 mask = notWhite(image);
  const Image back = backColors(image, mask, HeadDisc{middle, 80});
  for (int y = 30; y < 180; ++y)
    for (int x = 70; x < 130; ++x) {
      if (y > 120 && y < 168) continue;
      REQUIRE(std::abs(back.pixel(x, y)[0] - (y < 135 ? 30 : 240)) < 25);
    }
}

TEST_CASE("a cap that sits askew on hair ends on the back of the head in one sharp edge, from side to side") {
  Image image(200, 200);
  image.rgba.setConstant(255);
  const Eigen::Vector2d middle(100, 100);
  const auto cap = [](int x, int y) { return y < 70 + x / 4; };
  paintDisc(image, middle, 80, {200, 120, 80});
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x)
      if (image.pixel(x, y)[0] == 200 && cap(x, y)) image.pixel(x, y)[0] = 30;
  paintDisc(image, {100, 115}, 55, {240, 220, 200});
  // A feather that the rim crosses for a few rows is no part of it.
  for (int y = 52; y < 58; ++y)
    for (int x = 20; x < 60; ++x)
      if (image.pixel(x, y)[0] == 30) image.pixel(x, y)[0] = 130;
  const Image back = backColors(image, notWhite(image), HeadDisc{middle, 80});
  int mixed = 0, wrong = 0;
  for (int x = 40; x < 160; ++x)
    for (int y = 40; y < 160; ++y) {
      const int red = back.pixel(x, y)[0];
      mixed += red > 45 && red < 185;
      const int edge = 70 + x / 4 + 15;  // it hangs a little in the middle
      wrong += std::abs(y - edge) > 25 && (red < 120) != (y < edge);
    }
  CHECK(mixed < 3 * 120);
  CHECK(wrong == 0);
}

TEST_CASE("many lines inside of the figure are no hatching of its back") {
  Image image(200, 200);
  image.rgba.setConstant(255);
  paintDisc(image, {100, 100}, 90, {120, 80, 60});
  for (int y = 70; y < 130; ++y)
    for (int x = 70; x < 130; ++x) {
      const std::uint8_t value = x / 5 % 2 ? 230 : 10;
      std::fill_n(image.pixel(x, y), 3, value);
    }
  const Image back = backColors(image, notWhite(image), std::nullopt);
  for (int y = 75; y < 125; ++y)
    for (int x = 75; x < 125; ++x) REQUIRE(std::abs(back.pixel(x, y)[0] - 120) < 12);
}

TEST_CASE("the back of clothes in red or blue that are drawn by black lines holds no black") {
  Image image = outlinedBall(300, 120, 9);
  const std::array<int, 3> color =
      GENERATE(std::array{250, 0, 0}, std::array{0, 0, 250}, std::array{30, 40, 130});
  paintDisc(image, {149.5, 149.5}, 111, color);
  // A pocket.
  for (int y = 150; y < 190; ++y)
    for (int x = 120; x < 160; ++x)
      if (y < 155 || y >= 185 || x < 125 || x >= 155) std::fill_n(image.pixel(x, y), 3, std::uint8_t(0));
  Plane8 mask = Plane8::Zero(300, 300);
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x) mask(y, x) = image.pixel(x, y)[0] + image.pixel(x, y)[1] < 510;
  const Image back = backColors(image, mask, std::nullopt);
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x)
      if (mask(y, x))
        for (int c = 0; c < 3; ++c)
          REQUIRE(std::abs(back.pixel(x, y)[c] - color[static_cast<size_t>(c)]) < 12);
}

TEST_CASE("beyond the figure its back has no drawn outline, whatever lies there in front") {
  Image image = outlinedBall(300, 120, 9);
  const Plane8 mask = notWhite(image);
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x)
      if (mask(y, x) == 0) std::fill_n(image.pixel(x, y), 3, std::uint8_t(0));
  const Image back = backColors(image, mask, std::nullopt);
  const Eigen::Vector2d middle(149.5, 149.5);
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x)
      if ((Eigen::Vector2d(x, y) - middle).norm() < 125) REQUIRE(back.pixel(x, y)[0] > 200);
}

TEST_CASE("what reaches the rim of a piece only where the figure goes on is worn in front") {
  // A blue trunk; between the arms, which are pieces of their own, it is as wide as the brown toy before it.
  Image image(200, 200);
  image.rgba.setConstant(255);
  Image piece = image;
  Plane8 mask = Plane8::Zero(200, 200), whole = mask;
  const bool alike = GENERATE(false, true);
  for (int y = 20; y < 180; ++y)
    for (int x = 20; x < 180; ++x) {
      const bool toy = y >= 70 && y < 130, arm = toy && (x < 60 || x >= 140);
      whole(y, x) = 1, mask(y, x) = !arm;
      const std::array<std::uint8_t, 3> blue{60, 110, 200}, brown{160, 110, 60};
      std::copy_n((toy && (!arm || alike) ? brown : blue).data(), 3, image.pixel(x, y));
      if (!arm) std::copy_n(image.pixel(x, y), 3, piece.pixel(x, y));
    }
  const WholeFigure around{image, whole, {-0.5, -0.5}};
  CHECK(backColors(piece, mask, std::nullopt).pixel(100, 100)[0] == 160);
  // What has the arms' colour goes on there.
  CHECK(backColors(piece, mask, std::nullopt, 200, &around).pixel(100, 100)[0] == (alike ? 160 : 60));
  // Nothing else is known of a piece that lies before others all around.
  mask.setZero();
  mask.block(70, 60, 60, 80).setOnes();
  CHECK(backColors(piece, mask, std::nullopt, 200, &around).pixel(100, 100)[0] == 160);
}

TEST_CASE("lines that tell paper from paper stay on the back, and what is drawn by lines alone does") {
  // A white head in a black ring, on a black line.
  Image image(300, 300);
  image.rgba.setConstant(255);
  paintDisc(image, {150, 100}, 70, {0, 0, 0});
  paintDisc(image, {150, 100}, 65, {255, 255, 254});
  paintDisc(image, {130, 90}, 6, {0, 0, 0});
  for (int y = 165; y < 290; ++y)
    for (int x = 147; x < 153; ++x) std::fill_n(image.pixel(x, y), 3, std::uint8_t(0));
  const Plane8 mask = notWhite(image);
  const Image back = backColors(image, mask, HeadDisc{{150, 100}, 70});
  CHECK(back.pixel(130, 90)[0] > 240);   // no eye
  CHECK(back.pixel(150, 100)[0] > 240);  // and no black skull
  CHECK(back.pixel(82, 100)[0] < 15);    // the ring
  CHECK(back.pixel(150, 240)[0] < 15);   // the body
}

TEST_CASE("the back of outlined clothes is round up to the rim, the front has its line on a flat band") {
  Image image = outlinedBall(400, 180, 11);
  const Silhouette silhouette = silhouetteFromMask(notWhite(image));
  InflateOptions options;
  options.thin_outline = true;
  options.back = Back::kPlain;
  const TriangleMesh mesh = inflate(image, silhouette, options);
  CHECK(checkMesh(mesh).problem == "");
  CHECK(darkFromTheSide(mesh) < 0.05);
  // 5 % of the ball within the rim: a ball's slope behind, next to nothing before.
  float front = 0, back = 0;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const float away = std::hypot(mesh.vertices(v, 0), mesh.vertices(v, 1) - 0.85f) / 0.85f;
    if (away < 0.94f || away > 0.97f) continue;
    front = std::max(front, mesh.vertices(v, 2)), back = std::min(back, mesh.vertices(v, 2));
  }
  CHECK(front < 0.02f);
  CHECK(back < -0.1f);
}

TEST_CASE("stripes of a shirt stay on the back") {
  Image image = outlinedBall(200, 80, 4);
  for (int y = 30; y < 170; ++y)
    for (int x = 0; x < 200; ++x)
      if (y % 10 < 5 && image.pixel(x, y)[0] == 250) image.pixel(x, y)[0] = 20;
  const Image back = backColors(image, notWhite(image), std::nullopt);
  CHECK(darkTexels(back) > 0.8 * darkTexels(image));
}

TEST_CASE("stripes of a shirt go on over its outline on the back, where they mixed to a grey band") {
  Image image = outlinedBall(200, 80, 4);
  const auto isInside = [](int x, int y, double radius) { return std::hypot(x - 99.5, y - 99.5) < radius; };
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x)
      if (isInside(x, y, 76)) std::fill_n(image.pixel(x, y), 3, std::uint8_t(y % 10 < 5 ? 20 : 240));
  const Image back = backColors(image, notWhite(image), std::nullopt);
  int rim = 0, mixed = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      if (!isInside(x, y, 79) || isInside(x, y, 76)) continue;
      ++rim;
      mixed += back.pixel(x, y)[0] > 80 && back.pixel(x, y)[0] < 180;
    }
  INFO(mixed << " of " << rim);
  CHECK(mixed < 0.1 * rim);
}

// As compilers please, a coordinate was rounded to float before it was placed in the joined texture, or not.
TEST_CASE(
    "one skin: where the back lies in the texture is told from the front's rounded place, to the last bit") {
  const Image image = outlinedBall(200, 80, 4);
  InflateOptions plain;
  plain.back = Back::kPlain;
  const TriangleMesh mesh = inflate(image, silhouetteFromMask(notWhite(image)), plain);
  const bool beside = mesh.texture.width > mesh.texture.height;
  const int along = beside ? 0 : 1;
  for (Eigen::Index v = 0; v < mesh.uv.rows(); ++v) {
    // Half a texture further.
    REQUIRE(mesh.back_uv(v, along) == float(0.5 + double(mesh.uv(v, along))));
    REQUIRE(mesh.back_uv(v, 1 - along) == mesh.uv(v, 1 - along));
  }
}

TEST_CASE("front and back share one texture, and the mesh stays closed") {
  const CapsuleFigure figure;
  const Image image = withFace(figure);
  const Silhouette silhouette = silhouetteFromMask(capsuleMask(figure));
  InflateOptions plain;
  plain.back = Back::kPlain;
  const TriangleMesh mesh = inflate(image, silhouette, plain);
  CHECK(checkMesh(mesh).problem == "");
  REQUIRE(mesh.back_uv.rows() == mesh.uv.rows());
  CHECK(mesh.back_uv.minCoeff() >= 0);
  CHECK(mesh.back_uv.maxCoeff() <= 1);
  const SplitMesh split = splitSeams(mesh);
  CHECK(split.mesh.triangles.rows() == mesh.triangles.rows());
  CHECK(split.mesh.vertices.rows() > mesh.vertices.rows());
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      REQUIRE(split.source[static_cast<size_t>(split.mesh.triangles(t, k))] == mesh.triangles(t, k));
      REQUIRE(split.mesh.uvOf(t, k) == mesh.uvOf(t, k));
    }
  const std::optional<TriangleMesh> whole = joinSeams(split.mesh);
  REQUIRE(whole);
  CHECK(whole->vertices == mesh.vertices);
  CHECK(whole->triangles == mesh.triangles);
  CHECK(splitSeams(*whole).mesh.uv == split.mesh.uv);

  const TriangleMesh same = inflate(image, silhouette);
  CHECK(same.back_uv.rows() == 0);
  CHECK(splitSeams(same).mesh.vertices.rows() == same.vertices.rows());
  CHECK_FALSE(joinSeams(same));
}

TEST_CASE("to part a mesh and to join it takes no second copy of its texture") {
  const CapsuleFigure figure;
  InflateOptions plain;
  plain.back = Back::kPlain;
  TriangleMesh mesh = inflate(withFace(figure), silhouetteFromMask(capsuleMask(figure)), plain);
  REQUIRE_FALSE(mesh.texture.empty());
  SplitMesh split = splitSeams(mesh);
  CHECK(split.mesh.texture.empty());
  split.mesh.texture = std::move(mesh.texture);
  const std::optional<TriangleMesh> whole = joinSeams(split.mesh);
  REQUIRE(whole);
  CHECK(whole->texture.empty());
}

TEST_CASE("a picture of the back lies mirrored on the back") {
  const Image front = outlinedBall(200, 80, 6);
  // Seen from behind, its right half is red.
  auto picture = std::make_shared<BackPicture>();
  picture->image = outlinedBall(100, 40, 3);
  picture->mask = notWhite(picture->image);
  for (int y = 0; y < 100; ++y)
    for (int x = 50; x < 100; ++x)
      if (picture->mask(y, x))
        std::copy_n(std::array<std::uint8_t, 3>{250, 0, 0}.data(), 3, picture->image.pixel(x, y));
  InflateOptions options;
  options.back_picture = picture;
  const TriangleMesh mesh = inflate(front, silhouetteFromMask(notWhite(front)), options);
  int red = 0, wrong = 0;
  for (Eigen::Index t = mesh.first_back; t < mesh.triangles.rows(); ++t) {
    const float x = mesh.vertices(mesh.triangles(t, 0), 0);
    if (std::abs(x) < 0.1f || std::abs(x) > 0.5f) continue;
    const Eigen::RowVector2f uv = mesh.uvOf(t, 0);
    const std::uint8_t* color = mesh.texture.pixel(static_cast<int>(uv.x() * mesh.texture.width),
                                                   static_cast<int>(uv.y() * mesh.texture.height));
    if (color[0] < 200) continue;  // the outline
    const bool is_red = color[1] < 100;
    red += is_red;
    wrong += is_red != (x < 0);  // who looks from behind has the model's -x at the right
  }
  CHECK(red > 50);
  CHECK(wrong == 0);
}

TEST_CASE("a dark outline is no broad black band from the side, and the front stays") {
  const Image image = outlinedBall(400, 180, 14);
  const Silhouette silhouette = silhouetteFromMask(notWhite(image));
  InflateOptions thin;
  thin.thin_outline = true;
  const TriangleMesh before = inflate(image, silhouette), after = inflate(image, silhouette, thin);
  CHECK(checkMesh(after).problem == "");
  CHECK(darkFromTheSide(before) > 0.3);
  CHECK(darkFromTheSide(after) < 0.05);
  // From the front: the rim is where it was, and every point of the drawing lies where it is drawn.
  const Eigen::Vector2d texels(after.texture.width, after.texture.height);
  const auto texelOf = [&](Eigen::Index v) {
    return Eigen::Vector2d(after.uv.row(v).transpose().cast<double>().cwiseProduct(texels));
  };
  const auto pixelOf = [&](Eigen::Index v) {
    return after.model_from_image.inverse(after.vertices.row(v).head<2>().transpose().cast<double>());
  };
  const auto rimOf = [](const TriangleMesh& mesh) {
    std::vector<Eigen::Index> rim;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
      if (mesh.vertices(v, 2) == 0) rim.push_back(v);
    return rim;
  };
  const std::vector<Eigen::Index> rim = rimOf(after), rim_before = rimOf(before);
  CHECK(rim.size() > 100);
  REQUIRE(rim.size() == rim_before.size());
  for (std::size_t k = 0; k < rim.size(); ++k)
    REQUIRE(after.vertices.row(rim[k]) == before.vertices.row(rim_before[k]));
  // But for the line's blurred inner edge, which the flange takes along.
  const Eigen::Vector2d margin = texelOf(rim[0]) - pixelOf(rim[0]);
  for (Eigen::Index v = 0; v < after.vertices.rows(); ++v)
    REQUIRE((texelOf(v) - pixelOf(v) - margin).norm() < 0.15 * 14 + 1.6);
}

TEST_CASE("thin outlines lie on the flange all along the rim: no beads of ink on the slope") {
  const double width = GENERATE(2.0, 3.0, 5.0, 8.0);
  CAPTURE(width);
  const Image image = outlinedBall(700, 330, width);
  InflateOptions thin;
  thin.thin_outline = true;
  const TriangleMesh mesh = inflate(image, silhouetteFromMask(notWhite(image)), thin);
  CHECK(checkMesh(mesh).problem == "");
  CHECK(darkFromTheSide(mesh) < 0.015);
}

TEST_CASE("an outline goes on where another line meets it") {
  Image image = outlinedBall(400, 180, 8);
  for (int y = 195; y < 205; ++y)
    for (int x = 200; x < 379; ++x)
      if (image.pixel(x, y)[0] == 250) std::fill_n(image.pixel(x, y), 3, std::uint8_t(0));
  const Plane8 mask = notWhite(image);
  std::vector<std::vector<Eigen::Vector2d>> outline;
  for (const Polygon& corners : silhouetteFromMask(mask).outline) outline.push_back(sideMiddles(corners));
  for (const OutlineSample& sample : drawnOutline(image, mask, outline))
    REQUIRE(sample.width_px == Approx(8).margin(2.5));
}

TEST_CASE(
    "white around a darker figure is an outline, and so are black around navy blue and pink around white") {
  struct Disc {
    std::array<int, 3> line, inside;
    double least_px;  // of what is no paper that shines through
  };
  const Disc disc = GENERATE(Disc{{250, 250, 245}, {200, 20, 20}, 2}, Disc{{20, 10, 25}, {40, 40, 84}, 0},
                             Disc{{228, 110, 165}, {252, 250, 250}, 0});
  CAPTURE(disc.line);
  Image image(600, 600);
  image.rgba.setConstant(255);
  const Eigen::Vector2d middle(299.5, 299.5);
  paintDisc(image, middle, 240, disc.line);
  const double width = GENERATE(5.0, 1.0);
  paintDisc(image, middle, 240 - width, disc.inside);
  Plane8 mask = Plane8::Zero(600, 600);
  for (int y = 0; y < 600; ++y)
    for (int x = 0; x < 600; ++x) mask(y, x) = (Eigen::Vector2d(x, y) - middle).norm() <= 240 ? 255 : 0;
  std::vector<std::vector<Eigen::Vector2d>> outline;
  for (const Polygon& corners : silhouetteFromMask(mask).outline) outline.push_back(sideMiddles(corners));
  REQUIRE(!outline.empty());
  const double expected = width < disc.least_px ? 0 : width;
  for (const OutlineSample& sample : drawnOutline(image, mask, outline))
    REQUIRE(sample.width_px == Approx(expected).margin(expected == 0 ? 0 : 1.6));
}

TEST_CASE("the rim stands forward where the back shows no outline, and nowhere else") {
  const Image image = outlinedBall(400, 180, 11);
  const Silhouette silhouette = silhouetteFromMask(notWhite(image));
  InflateOptions options;
  options.thin_outline = true;
  options.back = GENERATE(Back::kPlain, Back::kSame);
  const TriangleMesh mesh = inflate(image, silhouette, options);
  const double px = mesh.model_from_image.scale.y();
  int rim = 0;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const Eigen::Vector2d p =
        mesh.model_from_image.inverse(mesh.vertices.row(v).head<2>().transpose().cast<double>());
    if ((p - Eigen::Vector2d(199.5, 199.5)).norm() < 179) continue;
    ++rim;
    if (options.back == Back::kSame)
      REQUIRE(mesh.vertices(v, 2) == 0);
    else
      REQUIRE(mesh.vertices(v, 2) / px == Approx(11).margin(2.5));
  }
  CHECK(rim > 100);
}

TEST_CASE("an outline that is wide for its limb does not make that flat") {
  Image bare(300, 600), outlined(300, 600);
  bare.rgba.setConstant(255), outlined.rgba.setConstant(255);
  for (int y = 20; y < 580; ++y)
    for (int x = 115; x < 185; ++x) {
      const bool line = y < 38 || y >= 562 || x < 133 || x >= 167;
      std::fill_n(bare.pixel(x, y), 3, std::uint8_t(200));
      std::fill_n(outlined.pixel(x, y), 3, std::uint8_t(line ? 0 : 200));
    }
  InflateOptions options;
  options.thin_outline = true;
  options.back = GENERATE(Back::kPlain, Back::kSame);
  const auto depthOf = [&](const Image& image) {
    const TriangleMesh mesh = inflate(image, silhouetteFromMask(notWhite(image)), options);
    CHECK(checkMesh(mesh).problem == "");
    return mesh.vertices.col(2).maxCoeff() - mesh.vertices.col(2).minCoeff();
  };
  const float round = depthOf(bare), depth = depthOf(outlined);
  CHECK(depth > 0.85f * round);
  CHECK(depth <= 1.001f * round);
}

TEST_CASE("a foot stands in a shoe although its leg is a piece that ends above it") {
  Image image(300, 600);
  image.rgba.setConstant(255);
  for (int y = 20; y < 580; ++y)
    for (int x = 120; x < 180; ++x) std::fill_n(image.pixel(x, y), 3, std::uint8_t(150));
  const Silhouette silhouette = silhouetteFromMask(notWhite(image));
  FigurePiece whole, thigh;
  whole.box = {120, 20, 180, 580};
  thigh.box = {120, 20, 180, 200}, thigh.layer = 3;
  for (FigurePiece* piece : {&whole, &thigh}) {
    piece->mask = Plane8::Constant(piece->box.height(), piece->box.width(), 255);
    piece->hidden = piece->over = Plane8::Zero(piece->box.height(), piece->box.width());
  }
  InflateOptions options;
  options.body.bones = {{{150, 30}, {150, 540}, 30, 2.5, 60, 0}};
  const auto toe = [&] {
    const TriangleMesh mesh = inflate(image, silhouette, options, {whole, thigh});
    float front = 0;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
      if (mesh.vertices(v, 1) < 0.06f) front = std::max(front, mesh.vertices(v, 2));
    return front;
  };
  const float bare = toe();
  options.body.feet = {{{150, 380}, {150, 545}, 30, 3}};
  CHECK(toe() > 1.3f * bare);
}

TEST_CASE("a mean over the mesh stays within it and keeps what is even") {
  // Two bars that do not touch.
  Plane8 mask = Plane8::Zero(120, 200);
  mask.block(10, 10, 40, 180) = 255, mask.block(60, 10, 40, 180) = 255;
  mask.block(50, 10, 10, 12) = 255;  // but at one end
  const Silhouette silhouette = silhouetteFromMask(mask);
  std::vector<Polygon> outline;
  for (const Polygon& curve : silhouette.outline) outline.push_back(sideMiddles(curve));
  const PlanarMesh mesh = triangulateFigure(mask, figureBox(mask), outline, 4);
  Eigen::VectorXd upper(mesh.inner_count);
  for (int v = 0; v < mesh.inner_count; ++v) upper[v] = mesh.vertices[v].y() < 55 ? 1 : 0;
  const Eigen::VectorXd mean = localMean(mesh, upper, 12);
  REQUIRE(mean.size() == static_cast<Eigen::Index>(mesh.vertices.size()));
  for (int v = 0; v < mean.size(); ++v) {
    const Eigen::Vector2d& p = mesh.vertices[v];
    REQUIRE(mean[v] >= 0);
    REQUIRE(mean[v] < 1);
    if (p.x() < 80) continue;
    if (p.y() > 55) REQUIRE(mean[v] < 0.01);
    if (p.y() < 50 && p.x() < 160) REQUIRE(mean[v] == Approx(0.9).margin(0.07));
  }
}

TEST_CASE("a shoe wears its colour, not the line that is drawn above it") {
  // A leg, and a foot that is turned out.
  Image image(300, 300);
  image.rgba.setConstant(255);
  const auto box = [&](int x0, int y0, int x1, int y1, std::uint8_t value) {
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) std::fill_n(image.pixel(x, y), 3, value);
  };
  box(100, 20, 150, 260, 0), box(100, 210, 240, 280, 0);
  box(106, 26, 144, 270, 220), box(106, 216, 234, 274, 220);
  InflateOptions options;
  options.thin_outline = true;
  options.back = Back::kPlain;
  const DepthBone shin{{125, 40}, {125, 230}, 25, 2.5, 50, 0};
  options.body.bones = {shin};
  options.body.feet = {{{125, 120}, {125, 230}, 25, 0}};
  const TriangleMesh mesh = inflate(image, silhouetteFromMask(notWhite(image)), options);
  CHECK(checkMesh(mesh).problem == "");
  CHECK(darkFromTheSide(mesh) < 0.05);
}

TEST_CASE("a figure that is dark all the way through has no outline") {
  const Image image = outlinedBall(200, 80, 80);
  const Plane8 mask = notWhite(image);
  std::vector<std::vector<Eigen::Vector2d>> outline;
  for (const Polygon& corners : silhouetteFromMask(mask).outline) outline.push_back(sideMiddles(corners));
  for (const OutlineSample& sample : drawnOutline(image, mask, outline)) REQUIRE(sample.width_px == 0);
  const Image ball = outlinedBall(200, 80, 5);
  for (const OutlineSample& sample : drawnOutline(ball, mask, outline))
    REQUIRE(sample.width_px == Approx(5).margin(1.6));
}

TEST_CASE("a drawing that was turned gives an upright model") {
  const CapsuleFigure figure;
  const Image image = capsuleImage(figure);
  Image lying(image.height, image.width);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      std::copy_n(image.pixel(x, y), 4, lying.pixel(image.height - 1 - y, x));
  InflateOptions turned;
  turned.turned_rad = std::numbers::pi / 2;
  turned.height_m = 2;
  const TriangleMesh mesh = inflate(lying, silhouetteFromMask(notWhite(lying)), turned);
  CHECK(checkMesh(mesh).problem == "");
  CHECK(mesh.vertices.col(1).minCoeff() == Approx(0).margin(1e-5));
  CHECK(mesh.vertices.col(1).maxCoeff() == Approx(2));
  CHECK(mesh.vertices.col(0).minCoeff() == Approx(-mesh.vertices.col(0).maxCoeff()).margin(1e-5));
  const Skeleton skeleton = capsuleSkeleton(figure);
  const auto place = [&](const char* name) {
    const Eigen::Vector2d p = skeleton.joints[skeleton.index(name)].image;
    return mesh.model_from_image(Eigen::Vector2d(image.height - 1 - p.y(), p.x()));
  };
  CHECK(place("head_top").y() > place("pelvis").y());
  CHECK(place("left_hand").x() > 0);
  CHECK(std::abs(place("head").x()) < 0.01);
  const Eigen::Vector2d p(123, 45);
  CHECK((mesh.model_from_image.inverse(mesh.model_from_image(p)) - p).norm() < 1e-9);
}
