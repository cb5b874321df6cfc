#include "libskel/silhouette/silhouette.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <thread>

#include "libskel/core/rng.h"
#include "libskel/image/read_image.h"
#include "libskel/silhouette/line_art.h"
#include "libskel/silhouette/loops.h"
#include "libskel/silhouette/steps.h"
#include "tests/support/catch.h"

using namespace skel;
using Catch::Matchers::Contains;

namespace {

struct Color {
  double r, g, b;
};
constexpr Color kWhite{255, 255, 255}, kBlack{0, 0, 0};

struct Capsule {
  double x0, y0, x1, y1, radius;
};

// Distance of a point to a figure of capsules, negative inside.
double distanceTo(const std::vector<Capsule>& figure, double x, double y) {
  double nearest = 1e9;
  for (const Capsule& c : figure) {
    const double dx = c.x1 - c.x0, dy = c.y1 - c.y0;
    const double t = std::clamp(((x - c.x0) * dx + (y - c.y0) * dy) / (dx * dx + dy * dy + 1e-12), 0.0, 1.0);
    nearest = std::min(nearest, std::hypot(x - c.x0 - t * dx, y - c.y0 - t * dy) - c.radius);
  }
  return nearest;
}

// Arms stretched out, legs apart; fits into 300×400 px.
const std::vector<Capsule> kPerson = {{150, 80, 150, 80, 45},   {150, 130, 150, 230, 35},
                                      {150, 150, 50, 190, 14},  {150, 150, 250, 190, 14},
                                      {140, 240, 110, 350, 17}, {160, 240, 190, 350, 17}};

Plane8 maskOf(const std::vector<Capsule>& figure, int width, int height, double grow = 0) {
  Plane8 mask(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) mask(y, x) = distanceTo(figure, x, y) <= grow ? 255 : 0;
  }
  return mask;
}

using Paint = std::function<Color(double x, double y)>;

Image paint(int width, int height, const Paint& color) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Color c = color(x, y);
      std::uint8_t* p = image.pixel(x, y);
      p[0] = static_cast<std::uint8_t>(std::clamp(c.r, 0.0, 255.0));
      p[1] = static_cast<std::uint8_t>(std::clamp(c.g, 0.0, 255.0));
      p[2] = static_cast<std::uint8_t>(std::clamp(c.b, 0.0, 255.0));
      p[3] = 255;
    }
  }
  return image;
}

Color mix(const Color& a, const Color& b, double t) {
  t = std::clamp(t, 0.0, 1.0);
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

// Smooth edges, as a drawing program makes them.
Image filled(const std::vector<Capsule>& figure, const Paint& ground, const Color& fill) {
  return paint(300, 400,
               [&](double x, double y) { return mix(ground(x, y), fill, 0.5 - distanceTo(figure, x, y)); });
}

Image outlined(
    const std::vector<Capsule>& figure, const Paint& ground, const Color& line, double width,
    const std::function<bool(double, double)>& gap = [](double, double) { return false; }) {
  return paint(300, 400, [&](double x, double y) {
    const double ink = gap(x, y) ? 0 : 0.5 + width / 2 - std::abs(distanceTo(figure, x, y));
    return mix(ground(x, y), line, ink);
  });
}

Color plainWhite(double, double) { return kWhite; }

double iou(const Plane8& a, const Plane8& b) {
  const auto both = ((a != 0) && (b != 0)).count(), any = ((a != 0) || (b != 0)).count();
  return any ? static_cast<double>(both) / static_cast<double>(any) : 1;
}

int parts(const Plane8& mask) {
  Plane8 rest = mask;
  int count = 0;
  for (Eigen::Index start = 0; start < rest.size(); ++start) {
    if (rest.data()[start] == 0) continue;
    ++count;
    std::vector<Eigen::Index> todo = {start};
    rest.data()[start] = 0;
    while (!todo.empty()) {
      const Eigen::Index p = todo.back(), x = p % rest.cols(), y = p / rest.cols();
      todo.pop_back();
      const auto visit = [&](Eigen::Index nx, Eigen::Index ny) {
        if (nx < 0 || ny < 0 || nx >= rest.cols() || ny >= rest.rows() || rest(ny, nx) == 0) return;
        rest(ny, nx) = 0;
        todo.push_back(ny * rest.cols() + nx);
      };
      visit(x - 1, y);
      visit(x + 1, y);
      visit(x, y - 1);
      visit(x, y + 1);
    }
  }
  return count;
}

double areaOf(const Polygon& polygon) {  // positive if clockwise on the screen
  double area = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    area += (a.x() * b.y() - a.y() * b.x()) / 2;
  }
  return area;
}

// What holds for every silhouette that was found.
void checkSound(const Silhouette& s) {
  REQUIRE(s.found());
  CHECK(s.reason.empty());
  CHECK(parts(s.mask) == 1);
  CHECK(parts(s.grid_mask) == 1);
  CHECK(std::max(s.grid.width, s.grid.height) == kWorkingGridSize);
  CHECK(s.grid_mask.cols() == s.grid.width);
  CHECK(s.grid_mask.rows() == s.grid.height);
  REQUIRE(!s.outline.empty());
  double area = 0;
  for (const Polygon& polygon : s.outline) area += areaOf(polygon);
  CHECK(area == Approx(static_cast<double>((s.mask != 0).count())));
  CHECK(areaOf(s.outline.front()) > 0);
  for (size_t i = 1; i < s.outline.size(); ++i) CHECK(areaOf(s.outline[i]) < 0);
}

Silhouette foundIn(const Image& image, const SilhouetteOptions& options = {}) {
  Silhouette s = extractSilhouette(image, options);
  checkSound(s);
  return s;
}

}  // namespace

TEST_CASE("a mask comes back as it is, with its outline and its grid") {
  Plane8 mask = Plane8::Zero(40, 60);
  mask.block(10, 20, 16, 32) = 255;
  const Silhouette s = silhouetteFromMask(mask);
  checkSound(s);
  CHECK((s.mask == mask).all());
  CHECK(s.figure_count == 1);
  CHECK(s.warnings.empty());
  const Polygon corners = {{51.5, 9.5}, {51.5, 25.5}, {19.5, 25.5}, {19.5, 9.5}};
  REQUIRE(s.outline.size() == 1);
  CHECK(s.outline[0] == corners);
  CHECK(s.grid.width == 128);
  CHECK(s.grid.height == 64);
  CHECK(s.grid.scale == 4);
  CHECK((s.grid_mask == 255).all());
  CHECK(s.grid.gridFromImage({20, 10}).isApprox(Eigen::Vector2d(1.5, 1.5)));
  CHECK(s.grid.imageFromGrid({1.5, 1.5}).isApprox(Eigen::Vector2d(20, 10)));
}

TEST_CASE("holes of a mask are kept unless they are to be filled") {
  Plane8 mask = maskOf({{50, 50, 50, 50, 40}}, 100, 100);
  mask = (maskOf({{50, 50, 50, 50, 15}}, 100, 100) != 0).select(Plane8::Zero(100, 100), mask);
  const Silhouette ring = silhouetteFromMask(mask);
  checkSound(ring);
  CHECK(ring.outline.size() == 2);
  CHECK(ring.mask(50, 50) == 0);
  SilhouetteOptions options;
  options.fill_holes = true;
  const Silhouette disc = silhouetteFromMask(mask, options);
  checkSound(disc);
  CHECK(disc.outline.size() == 1);
  CHECK(disc.mask(50, 50) == 255);
}

TEST_CASE("the grid keeps lines that are far thinner than one of its pixels") {
  // A stick figure, one pixel wide, on 1000×1000.
  Plane8 mask = Plane8::Zero(1000, 1000);
  mask.col(500).segment(100, 600) = 255;
  mask.row(300).segment(100, 800) = 255;
  for (int i = 0; i < 250; ++i) {
    mask.block(699 + i, 500 - i, 2, 1) = 255;
    mask.block(699 + i, 500 + i, 2, 1) = 255;
  }
  const Silhouette s = silhouetteFromMask(mask);
  checkSound(s);
  // Every pixel of the figure has a pixel of the grid within 1.5.
  for (Eigen::Index y = 0; y < 1000; ++y) {
    for (Eigen::Index x = 0; x < 1000; ++x) {
      if (mask(y, x) == 0) continue;
      const Eigen::Vector2d g = s.grid.gridFromImage({static_cast<double>(x), static_cast<double>(y)});
      bool near = false;
      for (int v = -1; v <= 1; ++v) {
        for (int u = -1; u <= 1; ++u) {
          const auto gx = std::lround(g.x()) + u, gy = std::lround(g.y()) + v;
          near |= gx >= 0 && gy >= 0 && gx < s.grid.width && gy < s.grid.height && s.grid_mask(gy, gx) != 0;
        }
      }
      if (!near) FAIL("lost the limb at " << x << ", " << y);
    }
  }
  CHECK((s.grid_mask != 0).count() < 900);
}

TEST_CASE("random masks: one part, a true outline, a grid that keeps the area") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Rng rng(seed);
    const int w = 20 + static_cast<int>(rng.below(280)), h = 20 + static_cast<int>(rng.below(280));
    std::vector<Capsule> figure;
    for (int i = 0; i < 12; ++i) {
      figure.push_back({rng.uniform(0, w), rng.uniform(0, h), rng.uniform(0, w), rng.uniform(0, h),
                        rng.uniform(0.4, 0.08 * std::min(w, h))});
    }
    Plane8 mask = maskOf(figure, w, h);
    for (int i = 0; i < 40; ++i)
      mask(rng.below(static_cast<unsigned>(h)), rng.below(static_cast<unsigned>(w))) ^= 255;
    const Silhouette s = silhouetteFromMask(mask);
    checkSound(s);
    const double grid_area = static_cast<double>((s.grid_mask != 0).count()) / (s.grid.scale * s.grid.scale);
    CHECK(grid_area == Approx(static_cast<double>((s.mask != 0).count())).epsilon(0.25));
  }
}

TEST_CASE("degenerate masks are figures or refused with a reason, never a crash") {
  const auto reason = [](const Plane8& mask) { return silhouetteFromMask(mask).reason; };
  CHECK(reason(Plane8()) == "the mask is empty");
  CHECK(reason(Plane8::Zero(1, 1)) == "the mask is blank");
  CHECK(reason(Plane8::Zero(50, 50)) == "the mask is blank");
  CHECK(reason(Plane8::Constant(1, 1, 255)) == "what is drawn is too small to be a figure");
  CHECK(reason(Plane8::Constant(1, 300, 255)) == "what is drawn is too small to be a figure");
  CHECK(reason(Plane8::Constant(300, 1, 255)) == "what is drawn is too small to be a figure");
  const Silhouette all = silhouetteFromMask(Plane8::Constant(30, 20, 255));
  checkSound(all);
  REQUIRE(all.warnings.size() == 1);
  CHECK_THAT(all.warnings[0], Contains("cut by the border of the picture (top, bottom, left, right)"));
}

TEST_CASE("degenerate pictures are figures or refused with a reason, never a crash") {
  const auto reason = [](int w, int h, const Paint& color) {
    return extractSilhouette(paint(w, h, color)).reason;
  };
  const auto black = [](double, double) { return kBlack; };
  CHECK(extractSilhouette(Image()).reason == "the picture is empty");
  Rng random(3);
  const auto grain = [&](double, double) {
    const double grey = 200 + random.below(40);
    return Color{grey, grey, grey};
  };
  CHECK(reason(200, 300, grain) == "nothing on the picture stands out from its ground");
  CHECK(reason(1, 1, plainWhite) == "the picture is blank");
  CHECK(reason(1, 1, black) == "the picture is blank");
  CHECK(reason(300, 1, plainWhite) == "the picture is blank");
  CHECK(reason(1, 300, black) == "the picture is blank");
  CHECK(reason(200, 300, plainWhite) == "the picture is blank");
  CHECK(reason(200, 300, black) == "the picture is blank");
  for (const int size : {1, 2, 3, 5, 17}) {
    Rng rng(3);
    const auto noise = [&](double, double) { return rng.chance(0.5) ? kWhite : kBlack; };
    for (const auto& [w, h] : {std::pair{size, size}, {size, 100}, {100, size}}) {
      const Silhouette s = extractSilhouette(paint(w, h, noise));
      if (s.found())
        checkSound(s);
      else
        CHECK(!s.reason.empty());
    }
  }
  Image clear = paint(40, 40, black);
  clear.rgba.col(3) = 0;
  CHECK(extractSilhouette(clear).reason == "the picture is fully transparent");
}

TEST_CASE("alpha tells the figure, with its holes") {
  Image image = paint(300, 400, [](double, double) { return Color{200, 30, 90}; });
  Plane8 mask = maskOf(kPerson, 300, 400);
  mask.block(170, 140, 20, 20) = 0;
  for (Eigen::Index i = 0; i < mask.size(); ++i) image.rgba(i, 3) = mask.data()[i] ? 255 : 10;
  const Silhouette s = foundIn(image);
  CHECK((s.mask == mask).all());
  CHECK(s.outline.size() == 2);
}

TEST_CASE(
    "line art on a clear ground is filled as on paper, gaps in its lines or not, and sticks stay sticks") {
  const bool light = GENERATE(false, true);
  const double gap = GENERATE(0., 6.);  // px, at the belly
  Image image = paint(300, 400, [&](double, double) { return light ? Color{250, 250, 240} : kBlack; });
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 300; ++x) {
      const double distance = distanceTo(kPerson, x, y);
      const bool line = distance <= 0 && distance > -4 && !(x < 150 && std::abs(y - 200) < gap);
      image.pixel(x, y)[3] = line ? 255 : 0;
    }
  const Plane8 person = maskOf(kPerson, 300, 400);
  CHECK(iou(foundIn(image).mask, person) > .97);
  CHECK(needsPaper(image, person));
  const Image on_paper = laidOnPaper(image);
  CHECK((on_paper.rgba.col(3) == 255).all());
  CHECK(int(on_paper.pixel(150, 80)[0]) == (light ? 40 : 255));

  const std::vector<Capsule> sticks = {{150, 60, 150, 60, 6},   {150, 60, 150, 240, 4},
                                       {150, 120, 60, 180, 4},  {150, 120, 240, 180, 4},
                                       {150, 240, 110, 360, 4}, {150, 240, 190, 360, 4}};
  const Plane8 thin = maskOf(sticks, 300, 400);
  for (Eigen::Index i = 0; i < thin.size(); ++i) image.rgba(i, 3) = thin.data()[i];
  const Silhouette stick_figure = foundIn(image);
  CHECK((stick_figure.mask == thin).all());
  CHECK_FALSE(needsPaper(image, stick_figure.mask));
}

TEST_CASE("a hole that is filled was taken for a part of the figure that can be seen through") {
  Image ring = paint(300, 400, [](double, double) { return Color{200, 30, 90}; });
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 300; ++x) {
      const double r = std::hypot(x - 150, y - 200);
      ring.pixel(x, y)[3] = r < 120 && r > 60 ? 255 : 0;
    }
  SilhouetteOptions options;
  options.fill_holes = true;
  const Silhouette filled = extractSilhouette(ring, options);
  REQUIRE(filled.found());
  CHECK(filled.mask(200, 150) != 0);
  CHECK(filled.warnings.empty());
}

TEST_CASE("a soft glow belongs to the figure unless --alpha leaves it out, and is told of") {
  Image image = paint(300, 400, [](double, double) { return Color{200, 30, 90}; });
  const Plane8 mask = maskOf(kPerson, 300, 400);
  const auto near = [&](int x, int y, int reach) {
    for (int v = std::max(0, y - reach); v <= std::min(399, y + reach); ++v)
      for (int u = std::max(0, x - reach); u <= std::min(299, x + reach); ++u)
        if (mask(v, u)) return true;
    return false;
  };
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 300; ++x)
      image.pixel(x, y)[3] = mask(y, x) ? 255 : near(x, y, 12) ? 150 : near(x, y, 16) ? 60 : 0;
  const Silhouette with_glow = foundIn(image);
  CHECK(iou(with_glow.mask, mask) < .8);
  REQUIRE(with_glow.warnings.size() == 1);
  CHECK_THAT(with_glow.warnings[0], Catch::Contains("half-transparent"));
  SilhouetteOptions options;
  options.alpha = .9;
  const Silhouette without = extractSilhouette(image, options);
  REQUIRE(without.found());
  CHECK((without.mask == mask).all());
  CHECK(without.warnings.empty());

  // One that can be seen through everywhere alike has no glow, and one with smooth edges has none either.
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 300; ++x) image.pixel(x, y)[3] = mask(y, x) ? 140 : near(x, y, 2) ? 80 : 0;
  CHECK(foundIn(image).warnings.empty());
  CHECK(extractSilhouette(image, options).reason ==
        "nothing in the picture is as opaque as --alpha asks for");
}

TEST_CASE("transparent corners alone do not make an opaque picture a figure") {
  Image image = filled(kPerson, plainWhite, {200, 30, 30});
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 10 - i; ++j) {
      for (const int x : {i, 299 - i}) {
        for (const int y : {j, 399 - j}) image.pixel(x, y)[3] = 0;
      }
    }
  }
  CHECK(iou(foundIn(image).mask, maskOf(kPerson, 300, 400)) > 0.97);
}

TEST_CASE("fills on white, on colours, on a gradient, in the dark") {
  const Plane8 truth = maskOf(kPerson, 300, 400);
  const Paint gradient = [](double x, double y) { return Color{90 + x / 5, 140 + y / 8, 220}; };
  const Paint dark = [](double, double) { return Color{40, 45, 60}; };
  CHECK(iou(foundIn(filled(kPerson, plainWhite, {220, 60, 40})).mask, truth) > 0.98);
  CHECK(iou(foundIn(filled(kPerson, plainWhite, {228, 243, 250})).mask, truth) > 0.97);
  CHECK(iou(foundIn(filled(kPerson, gradient, {240, 230, 90})).mask, truth) > 0.98);
  CHECK(iou(foundIn(filled(kPerson, dark, {230, 200, 190})).mask, truth) > 0.98);
}

TEST_CASE("line art: white inside is figure, also through a gap in the outline") {
  const Plane8 truth = maskOf(kPerson, 300, 400, 2);
  CHECK(iou(foundIn(outlined(kPerson, plainWhite, kBlack, 4)).mask, truth) > 0.97);
  // A gap of 8 px at the side of the body, 70 px wide.
  const Image open = outlined(kPerson, plainWhite, kBlack, 4,
                              [](double x, double y) { return x > 170 && std::abs(y - 200) < 4; });
  CHECK(iou(foundIn(open).mask, truth) > 0.96);
}

TEST_CASE("what lies between limbs stays outside, although the way in is narrow") {
  // Hands on the hips, with 6 px between hand and hip.
  std::vector<Capsule> figure = {{150, 80, 150, 80, 40},  {150, 130, 150, 260, 30}, {150, 140, 60, 190, 11},
                                 {60, 190, 100, 250, 11}, {140, 260, 120, 360, 14}, {160, 260, 180, 360, 14}};
  const Plane8 truth = maskOf(figure, 300, 400, 1.5);
  const Silhouette s = foundIn(outlined(figure, plainWhite, kBlack, 3));
  CHECK(iou(s.mask, truth) > 0.96);
  CHECK(s.mask(195, 100) == 0);
}

TEST_CASE("ground that arms on the hips enclose is no figure, clothes as white as the paper are") {
  const std::vector<Capsule> figure = {
      {150, 80, 150, 80, 45},   {150, 130, 150, 250, 35}, {150, 145, 60, 195, 12},  {60, 195, 125, 245, 12},
      {150, 145, 240, 195, 12}, {240, 195, 175, 245, 12}, {138, 250, 125, 360, 15}, {162, 250, 175, 360, 15}};
  const Silhouette s = foundIn(filled(figure, plainWhite, {90, 120, 200}));
  CHECK(iou(s.mask, maskOf(figure, 300, 400)) > 0.96);
  CHECK(s.mask(195, 98) == 0);
  CHECK(s.mask(195, 202) == 0);
  // Arms beside a gown, legs of one who crouches; a white coat that is two fifths of the figure.
  for (const char* name : {"ball_gown", "crouch_frog", "bobble_doctor"}) {
    const std::string file = SKEL_SOURCE_DIR "/datasets/characters/" + std::string(name);
    const Image drawing = readImage(file + ".png");
    CAPTURE(name);
    CHECK(iou(foundIn(laidOnPaper(drawing)).mask, readMask(file + ".mask.png")) > 0.985);
  }
}

TEST_CASE("a loop net of other inputs is refused") {
  const std::string text = formatLoopNet(builtInLoopNet());
  CHECK(formatLoopNet(parseLoopNet(text, "n.json")) == text);
  std::string other = text;
  other.replace(other.find("\"area\""), 6, "\"size\"");
  CHECK_THROWS_WITH(parseLoopNet(other, "n.json"), Contains("n.json") && Contains("must be \"area\""));
}

namespace {

// A graded sky with a low sun, two hills at the sides and a flat ground.
Color scenery(double x, double y) {
  Color color{140 + y / 5, 200 + y / 10, 245};
  const auto lay = [&](double distance, const Color& c) { color = mix(color, c, 0.5 - distance); };
  lay(std::hypot(x - 190, y - 150) - 70, {250, 220, 120});
  lay(std::hypot(x, y - 330) - 110, {150, 200, 130});
  lay(std::hypot(x - 300, y - 340) - 100, {150, 200, 130});
  lay(330 - y, {110, 170, 90});
  return color;
}

}  // namespace

TEST_CASE("a figure with a dark outline before scenery: what has no outline is not figure") {
  const auto inside = [](double x, double y) {
    return mix(scenery(x, y), {230, 170, 140}, 0.5 - distanceTo(kPerson, x, y));
  };
  const Silhouette s = foundIn(outlined(kPerson, inside, {40, 30, 50}, 4));
  CHECK(iou(s.mask, maskOf(kPerson, 300, 400, 2)) > 0.95);
  CHECK(s.mask(150, 240) == 0);  // the sun
}

TEST_CASE("a fill before hills: a colour on two sides of the picture is background") {
  const Paint hills = [](double x, double y) {
    const Color sky{150, 200, 245}, grass{90, 160, 70}, ridge{180, 205, 120};
    const Color behind = mix(sky, ridge, 230 + 15 * std::cos(x / 40) < y ? 1 : 0);
    return mix(behind, grass, y - 320);
  };
  const Silhouette s = foundIn(filled(kPerson, hills, {200, 50, 60}));
  CHECK(iou(s.mask, maskOf(kPerson, 300, 400)) > 0.97);
}

namespace {

// A photographed sheet: light that falls off, a hard shadow, grain.
Paint photographed(std::uint64_t seed, bool shadow) {
  auto rng = std::make_shared<Rng>(seed);
  return [rng, shadow](double x, double y) {
    double light = 0.95 - 0.25 * (x / 300) - 0.15 * (y / 400) * (y / 400);
    if (shadow && x + 0.3 * y > 260) light *= 0.75;
    const double grain = rng->normal(0, 3);
    return Color{225 * light + grain, 218 * light + grain, 205 * light + grain};
  };
}

}  // namespace

TEST_CASE("drawings on photographed paper: pencil, crayon, shadows") {
  const bool shadow = GENERATE(false, true);
  const Silhouette pencil = foundIn(outlined(kPerson, photographed(1, shadow), {70, 70, 80}, 3));
  CHECK(iou(pencil.mask, maskOf(kPerson, 300, 400, 2)) > 0.93);
  const Silhouette crayon = foundIn(filled(kPerson, photographed(2, shadow), {200, 80, 60}));
  // On paper a margin of one pixel is kept, a twentieth of this figure.
  CHECK(iou(crayon.mask, maskOf(kPerson, 300, 400, 1)) > 0.93);
}

TEST_CASE("the edge of a shadow that meets an arm and a leg encloses no paper") {
  auto rng = std::make_shared<Rng>(7);
  const Paint sheet = [rng](double x, double y) {
    const double light = x + 0.375 * y > 318 ? 0.72 : 0.95, grain = rng->normal(0, 3);
    return Color{225 * light + grain, 218 * light + grain, 205 * light + grain};
  };
  const Silhouette s = foundIn(outlined(kPerson, sheet, {50, 50, 60}, 4));
  CHECK(iou(s.mask, maskOf(kPerson, 300, 400, 3)) > 0.93);  // with the margin on paper
  CHECK(s.mask(270, 205) == 0);
}

TEST_CASE("blank paper, noise and a strip along the border are no figures") {
  CHECK(!extractSilhouette(paint(300, 400, photographed(5, false))).found());
  CHECK(!extractSilhouette(paint(300, 400, photographed(6, true))).found());
  Rng rng(4);
  const Silhouette noise = extractSilhouette(paint(300, 300, [&](double, double) {
    const double v = rng.uniform(0, 255);
    return Color{v, v, v};
  }));
  CHECK(!noise.found());
  CHECK(!noise.reason.empty());
  const Paint table = [](double, double y) { return y > 390 ? Color{90, 60, 30} : kWhite; };
  CHECK(!extractSilhouette(paint(300, 400, table)).found());
}

namespace {

// `page` at (x, y) of a picture of 600×700 px, where it lies turned and in perspective on wooden boards.
Color onTable(const Paint& page, double x, double y) {
  const double u = x - 300, v = y - 350, w = 1 + 0.0003 * v, c = std::cos(0.15), s = std::sin(0.15);
  const double px = 150 + (c * u + s * v) / w * 0.75, py = 200 + (-s * u + c * v) / w * 0.75;
  if (px >= 0 && py >= 0 && px < 300 && py < 400) return page(px, py);
  const double grain = 14 * std::sin(0.21 * x + 3 * std::sin(0.01 * y)) + (std::fmod(x, 120) < 3 ? -40 : 0);
  return {150 + grain, 105 + grain, 65 + grain};
}

Plane8 pencilMaskOnTable() {
  Plane8 mask(700, 600);
  for (int y = 0; y < 700; ++y)
    for (int x = 0; x < 600; ++x) {
      const auto inside = [](double px, double py) {
        return distanceTo(kPerson, px, py) <= 2 ? kBlack : kWhite;
      };
      mask(y, x) = onTable(inside, x, y).r == 0 ? 255 : 0;
    }
  return mask;
}

// A pencil outline on paper.
Paint pencilled(const Paint& paper) {
  return [paper](double x, double y) {
    return mix(paper(x, y), {70, 70, 80}, 2 - std::abs(distanceTo(kPerson, x, y)));
  };
}

}  // namespace

TEST_CASE("a sheet on a table is straightened, and its figure found in the picture's own pixels") {
  const Paint page = pencilled(photographed(11, false));
  const Silhouette s = foundIn(paint(600, 700, [&](double x, double y) { return onTable(page, x, y); }));
  CHECK(s.mask.rows() == 700);
  CHECK(iou(s.mask, pencilMaskOnTable()) > 0.9);
}

TEST_CASE("ruled paper, a margin: what is printed is not drawn") {
  const bool margin = GENERATE(false, true);
  const Paint grain = photographed(12, false);
  const Paint paper = [&](double x, double y) {
    const auto line = [](double p, double period) {
      return 1 - std::abs(std::fmod(p + 1000 * period, period) - period / 2);
    };
    const double level = y + 0.03 * x, upright = x - 0.03 * y;
    Color color = mix(grain(x, y), {110, 130, 190}, 0.6 * std::max(0.0, line(level, 18)));
    if (margin) color = mix(color, {220, 60, 60}, 0.8 * std::max(0.0, 1 - std::abs(upright - 30)));
    return color;
  };
  const Paint page = pencilled(paper);
  const Silhouette s = foundIn(paint(600, 800, [&](double x, double y) { return page(x / 2, y / 2); }));
  Plane8 truth(800, 600);
  for (int y = 0; y < 800; ++y)
    for (int x = 0; x < 600; ++x) truth(y, x) = distanceTo(kPerson, x / 2.0, y / 2.0) <= 2 ? 255 : 0;
  CHECK(iou(s.mask, truth) > 0.9);
}

TEST_CASE("what was seen on the way can be looked at") {
  const Paint page = pencilled(photographed(11, false));
  const SilhouetteSteps steps =
      silhouetteSteps(paint(600, 700, [&](double x, double y) { return onTable(page, x, y); }));
  CHECK(std::max(steps.sheet.width, steps.sheet.height) == 640);
  CHECK(steps.unruled.empty());
  CHECK(steps.figure_share.maxCoeff() > 127);
  const SilhouetteSteps tidy = silhouetteSteps(outlined(kPerson, plainWhite, kBlack, 4));
  CHECK((tidy.sheet.empty() && tidy.unruled.empty() && tidy.figure_share.size() == 0));
}

TEST_CASE("a line of ground is cut where it leaves the feet") {
  const Paint drawn = pencilled(photographed(13, false));
  const Silhouette s = foundIn(paint(300, 400, [&](double x, double y) {
    return mix(drawn(x, y), {70, 70, 80}, x > 20 && x < 280 ? 2 - std::abs(y - 364 - std::sin(x / 25)) : 0);
  }));
  CHECK(iou(s.mask, maskOf(kPerson, 300, 400, 2)) > 0.87);
  CHECK(s.mask(364, 40) == 0);
}

TEST_CASE("of several figures the one asked for is taken, the largest first") {
  const auto image = paint(400, 300, [](double x, double y) {
    const double big = distanceTo({{120, 150, 120, 150, 80}}, x, y);
    const double small = distanceTo({{310, 150, 310, 150, 60}}, x, y);
    const double speck = distanceTo({{310, 280, 310, 280, 4}}, x, y);
    return mix(kWhite, {30, 90, 180}, 0.5 - std::min({big, small, speck}));
  });
  const Silhouette first = foundIn(image);
  CHECK(first.figure_count == 2);
  CHECK(first.mask(150, 120) == 255);
  CHECK(first.mask(150, 310) == 0);
  REQUIRE(first.warnings.size() == 1);
  CHECK_THAT(first.warnings[0], Contains("shows 2 figures; the largest is taken"));
  SilhouetteOptions options;
  options.figure = 2;
  const Silhouette second = foundIn(image, options);
  CHECK(second.mask(150, 310) == 255);
  CHECK(second.warnings.empty());
  options.figure = 3;
  const Silhouette third = extractSilhouette(image, options);
  CHECK(!third.found());
  CHECK(third.reason == "there is no figure 3, only 2");
}

TEST_CASE("all figures of a picture are found by one look at it") {
  const auto two = [](bool clear) {
    Image image = paint(400, 300, [](double x, double y) {
      return mix(kWhite, {30, 90, 180},
                 0.5 - std::min(distanceTo({{120, 150, 120, 150, 80}}, x, y),
                                distanceTo({{310, 150, 310, 150, 60}}, x, y)));
    });
    for (int y = 0; clear && y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) image.pixel(x, y)[3] = image.pixel(x, y)[0] < 140 ? 255 : 0;
    return image;
  };
  for (const bool clear : {false, true}) {
    CAPTURE(clear);
    const Image image = two(clear);
    SilhouetteOptions options;
    FigureFinder finder(options);
    for (const int figure : {2, 1, 3}) {
      options.figure = figure;
      const Silhouette one = extractSilhouette(image, options), found = finder.take(image, figure);
      CHECK(found.outline == one.outline);
      CHECK(found.warnings == one.warnings);
      CHECK(found.reason == one.reason);
    }
    // What it has seen it does not look for again.
    const Silhouette again = finder.take(Image(image.width, image.height), 2);
    CHECK((again.mask == finder.take(image, 2).mask).all());
  }
}

TEST_CASE("a figure that is cut by the border is found, and the side is named") {
  std::vector<Capsule> figure = kPerson;
  for (Capsule& c : figure) c.y0 += 90, c.y1 += 90;
  const Silhouette s = foundIn(filled(figure, plainWhite, {60, 120, 200}));
  CHECK(iou(s.mask, maskOf(figure, 300, 400)) > 0.97);
  REQUIRE(s.warnings.size() == 1);
  CHECK(s.warnings[0] == "the figure is cut by the border of the picture (bottom)");
}

TEST_CASE("a picture that is clear beside the figure is cropped, not cut, by its border") {
  std::vector<Capsule> figure = kPerson;
  for (Capsule& c : figure) c.y0 += 90, c.y1 += 90;
  Image image = filled(figure, plainWhite, {60, 120, 200});
  const Plane8 inside = maskOf(figure, image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image.pixel(x, y)[3] = inside(y, x);
  for (const Silhouette& s : {foundIn(image), silhouetteFromMask(inside, image)}) {
    CHECK((s.mask != 0).row(image.height - 1).any());
    CHECK(s.clear_around);
    CHECK(s.cut_sides.empty());
    CHECK(s.warnings.empty());
  }
  CHECK(silhouetteFromMask(inside).cut_sides == "bottom");
}

TEST_CASE("the paper's method fills what dark lines enclose, and fails where they are open") {
  SilhouetteOptions paper;
  paper.method = SilhouetteMethod::kPaper;
  const Plane8 truth = maskOf(kPerson, 300, 400, 2);
  CHECK(iou(foundIn(outlined(kPerson, plainWhite, kBlack, 4), paper).mask, truth) > 0.95);
  const Image open = outlined(kPerson, plainWhite, kBlack, 4,
                              [](double x, double y) { return x > 170 && std::abs(y - 200) < 4; });
  CHECK(iou(foundIn(open, paper).mask, truth) < 0.5);
}

TEST_CASE("large photos are found at a smaller size and come back at their own") {
  const double scale = 8;
  const Image image = paint(2400, 3200, [&](double x, double y) {
    const double ink = 12 - std::abs(distanceTo(kPerson, x / scale, y / scale)) * scale;
    return mix({235, 230, 220}, {40, 40, 50}, ink);
  });
  const Silhouette s = foundIn(image);
  Plane8 truth(3200, 2400);
  for (int y = 0; y < 3200; ++y) {
    for (int x = 0; x < 2400; ++x) truth(y, x) = distanceTo(kPerson, x / scale, y / scale) <= 1.5 ? 255 : 0;
  }
  CHECK(iou(s.mask, truth) > 0.97);
}

TEST_CASE("the same picture gives the same bytes on any thread") {
  const Image image = outlined(kPerson, photographed(1, true), {70, 70, 80}, 3);
  const Silhouette alone = foundIn(image);
  std::vector<Silhouette> results(4);
  std::vector<std::thread> threads;
  for (Silhouette& result : results) threads.emplace_back([&] { result = extractSilhouette(image); });
  for (std::thread& thread : threads) thread.join();
  for (const Silhouette& result : results) {
    CHECK((result.mask == alone.mask).all());
    CHECK((result.grid_mask == alone.grid_mask).all());
  }
}

TEST_CASE("real drawings without transparency") {
  const char* dir = std::getenv("SKEL_EVAL_DIR");
  if (dir == nullptr) {
    std::puts("SKIPPED: SKEL_EVAL_DIR is not set");
    return;
  }
  namespace fs = std::filesystem;
  const fs::path root = fs::path(dir) / "characters";
  double sum = 0;
  int count = 0, good = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().filename() != "joints.json") continue;
    const fs::path folder = entry.path().parent_path();
    const Image image = readImage((folder / "image.png").string());
    if (image.rgba.col(3).minCoeff() < 128) continue;
    const Silhouette s = extractSilhouette(image);
    const double score = s.found() ? iou(s.mask, readMask((folder / "mask.png").string())) : 0;
    sum += score;
    good += score >= 0.9;
    ++count;
  }
  REQUIRE(count > 10);
  std::printf("silhouettes of %d real drawings: mean IoU %.3f, %d with at least 0.9\n", count, sum / count,
              good);
  CHECK(sum / count > 0.965);
  CHECK(good >= 0.92 * count);
  for (const char* blank : {"blank_paper", "blank_white"}) {
    CHECK(!extractSilhouette(readImage((root / "neg" / blank / "image.png").string())).found());
  }
}
