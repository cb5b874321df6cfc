#include "libskel/cutout/cut_out.h"

#include <algorithm>
#include <array>

#include "libskel/animation/clip_library.h"
#include "libskel/candidates/candidates.h"
#include "libskel/cutout/free_limbs.h"
#include "libskel/cutout/limb_plane.h"
#include "libskel/cutout/paint_cut_out.h"
#include "libskel/cutout/paper_rim.h"
#include "libskel/draw/canvas.h"
#include "libskel/pipeline/rig_drawing.h"
#include "libskel/skeleton/frontal.h"
#include "tests/support/catch.h"
#include "tests/support/clips_on_drawings.h"

using namespace skel;

namespace {

RiggedDrawing drawn(const std::string& path, const std::string& body_plan) {
  return rigWithClips(std::string(SKEL_SOURCE_DIR) + "/datasets/" + path, body_plan,
                      clipsFor(builtinClips(), loadTemplate(body_plan)));
}

std::vector<Eigen::MatrixX2d> posedBy(const RiggedDrawing& drawing, const CutOut& cut_out, const Clip& clip,
                                      float time_s) {
  const RiggedCharacter& character = drawing.character;
  return posedSheets(cut_out,
                     flatPose(character.skeleton, drawing.body_plan,
                              posedFromRest(character.skeleton, samplePose(clip, character.skeleton, time_s),
                                            heightOf(character.mesh))));
}

// Painted in the drawing's own size.
Image painted(const RiggedDrawing& drawing, const CutOut& cut_out, std::vector<Eigen::MatrixX2d> sheets) {
  const ModelFromImage& model = drawing.character.mesh.model_from_image;
  for (Eigen::MatrixX2d& sheet : sheets)
    for (Eigen::Index v = 0; v < sheet.rows(); ++v)
      sheet.row(v) = model.inverse(sheet.row(v).transpose()).transpose();
  Image image = blankImage(drawing.image.width, drawing.image.height, kClear);
  CutOutPainter(cut_out, 1 / model.scale.x()).paint(sheets, image);
  return image;
}

DrawnFigure figureOf(const RiggedDrawing& drawing) {
  return {drawing.image,     drawing.silhouette, drawing.character.skeleton,
          drawing.body_plan, drawing.layers,     drawing.character.mesh.model_from_image};
}

CutOut cutOutOf(const RiggedDrawing& drawing) { return makeCutOut(figureOf(drawing)); }

// Where the joint is drawn, image px.
Eigen::Vector2d at(const RiggedDrawing& drawing, const std::string& joint) {
  const Skeleton& skeleton = drawing.character.skeleton;
  return skeleton.joints[std::size_t(skeleton.index(joint))].image;
}

// Says that the figure's pixels for which `is` holds are of this part.
template <class Is>
void relabel(RiggedDrawing& drawing, Part part, const Is& is) {
  for (int y = 0; y < drawing.image.height; ++y)
    for (int x = 0; x < drawing.image.width; ++x)
      if (drawing.silhouette.mask(y, x) != 0 && is(Eigen::Vector2d(x, y)))
        drawing.layers.part(y, x) = std::uint8_t(part);
}

// With arms and legs that are no sheets of their own.
RiggedDrawing inOneSheet() {
  RiggedDrawing drawing = drawn("characters/cap_boy.png", "biped");
  drawing.layers.limb.resize(0, 0);
  drawing.layers.hidden.clear();
  return drawing;
}

}  // namespace

TEST_CASE("at rest the cut-out is the drawing: its pixels, and nothing around them") {
  for (const auto& [path, plan] :
       {std::pair("characters/cap_boy.png", "biped"), std::pair("animals/cloud_sheep.png", "quadruped")}) {
    CAPTURE(path);
    const RiggedDrawing drawing = drawn(path, plan);
    const CutOut cut_out = cutOutOf(drawing);
    FlatPose rest;
    for (const Joint& joint : drawing.character.skeleton.joints) {
      rest.rest.push_back(joint.position.head<2>());
      rest.place.push_back(joint.position.head<2>());
      rest.turn_rad.push_back(0);
    }
    const Image image = painted(drawing, cut_out, posedSheets(cut_out, rest));
    const Plane8& mask = drawing.silhouette.mask;
    const DistanceField inside = distanceField(mask);
    int other = 0, around = 0, clear = 0;
    for (int y = 1; y + 1 < image.height; ++y)
      for (int x = 1; x + 1 < image.width; ++x) {
        std::array<int, 3> low{255, 255, 255}, high{0, 0, 0};
        bool near = false, all = true;
        for (int v = y - 1; v <= y + 1; ++v)
          for (int u = x - 1; u <= x + 1; ++u) {
            near = near || mask(v, u) != 0;
            all = all && mask(v, u) != 0 && drawing.image.pixel(u, v)[3] == 255;
            for (std::size_t c = 0; c < 3; ++c) {
              low[c] = std::min<int>(low[c], drawing.image.pixel(u, v)[c]);
              high[c] = std::max<int>(high[c], drawing.image.pixel(u, v)[c]);
            }
          }
        const std::uint8_t* p = image.pixel(x, y);
        around += !near && p[3] != 0;
        clear += all && p[3] < 250 && inside(y, x) > 0.02f * float(image.height);
        if (!all) continue;
        for (std::size_t c = 0; c < 3; ++c) other += p[c] + 3 < low[c] || p[c] > high[c] + 3;
      }
    const double figure = double((mask != 0).count());
    CHECK(around == 0);
    CHECK(clear == 0);
    CHECK(other < 0.002 * figure);
  }
}

TEST_CASE("paper bends at joints and keeps its size everywhere else") {
  for (const auto& [path, plan] :
       {std::pair("characters/cap_boy.png", "biped"), std::pair("animals/cloud_sheep.png", "quadruped")}) {
    CAPTURE(path);
    const RiggedDrawing drawing = drawn(path, plan);
    const CutOut cut_out = cutOutOf(drawing);
    for (const Clip& clip : drawing.clips) {
      CAPTURE(clip.name);
      int sides = 0, stretched = 0;
      for (int k = 0; k < 6; ++k) {
        const auto posed = posedBy(drawing, cut_out, clip, clip.duration_s() * float(k) / 6);
        for (std::size_t s = 0; s < posed.size(); ++s)
          for (const auto& [a, b, c, d] : cut_out.sheets[s].lattice.squares)
            for (const auto& [from, to] :
                 {std::pair(a, b), std::pair(a, c), std::pair(b, d), std::pair(c, d)}) {
              const double share =
                  (posed[s].row(from) - posed[s].row(to)).norm() /
                  (cut_out.sheets[s].lattice.side_px * drawing.character.mesh.model_from_image.scale.x());
              ++sides;
              stretched += share > 1.5;
            }
      }
      CHECK(stretched < 0.05 * sides);
    }
  }
}

TEST_CASE("arms of who is drawn from the front pass before the trunk, however little they lie behind it") {
  RiggedDrawing drawing = drawn("characters/alien.png", "biped");
  REQUIRE(frontal(drawing.character.skeleton, drawing.body_plan) == 1);
  for (Joint& joint : drawing.character.skeleton.joints)
    if (joint.name.ends_with("_shoulder") || joint.name.ends_with("_elbow") || joint.name.ends_with("_hand"))
      joint.position.z() = -0.05;
  const CutOut cut_out = cutOutOf(drawing);
  std::array<std::size_t, 5> first, last;
  first.fill(cut_out.patches.size()), last.fill(0);
  for (std::size_t i = 0; i < cut_out.patches.size(); ++i) {
    const CutOut::Patch& patch = cut_out.patches[i];
    const std::size_t part = std::size_t(cut_out.sheets[patch.sheet].part[patch.square]);
    first[part] = std::min(first[part], i), last[part] = std::max(last[part], i);
  }
  for (std::size_t k = 0; k < drawing.body_plan.limbs.size(); ++k)
    if (drawing.body_plan.limbs[k].limb_class == JointClass::kHand) {
      REQUIRE(first[k + 1] < cut_out.patches.size());
      CHECK(first[k + 1] > last[0]);
    }
}

TEST_CASE("every patch is painted once, far limbs before the trunk") {
  RigOptions options = rigOptions("quadruped");
  options.cut_limbs = true;
  const RiggedDrawing drawing = rigDrawing(SKEL_SOURCE_DIR "/datasets/animals/cloud_sheep.png", options);
  const CutOut cut_out = cutOutOf(drawing);
  std::size_t squares = 0;
  for (const CutOutSheet& sheet : cut_out.sheets) squares += sheet.lattice.squares.size();
  REQUIRE(cut_out.patches.size() == squares);
  std::vector<std::vector<bool>> seen;
  for (const CutOutSheet& sheet : cut_out.sheets) seen.emplace_back(sheet.lattice.squares.size(), false);
  std::array<std::size_t, 5> first, last;
  first.fill(squares), last.fill(0);
  for (std::size_t i = 0; i < squares; ++i) {
    const CutOut::Patch& patch = cut_out.patches[i];
    CHECK_FALSE(seen[patch.sheet][patch.square]);
    seen[patch.sheet][patch.square] = true;
    const std::size_t part = std::size_t(cut_out.sheets[patch.sheet].part[patch.square]);
    first[part] = std::min(first[part], i), last[part] = std::max(last[part], i);
  }
  const Skeleton& skeleton = drawing.character.skeleton;
  int far = 0;
  for (const int limb : drawing.layers.far) {
    const TemplateLimb& joints = drawing.body_plan.limbs[std::size_t(limb) - 1];
    const int foot = skeleton.index(drawing.body_plan.joints[std::size_t(joints.joints[2])].name);
    CHECK(skeleton.joints[std::size_t(foot)].position.z() < 0);
    if (first[std::size_t(limb)] == squares) continue;
    ++far;
    CHECK(last[std::size_t(limb)] < first[0]);
  }
  CHECK(far == 2);
}

TEST_CASE("the same drawing in the same pose gives the same bytes") {
  const RiggedDrawing drawing = drawn("characters/cap_boy.png", "biped");
  const CutOut one = cutOutOf(drawing), other = cutOutOf(drawing);
  const Clip& dance = clipNamed(drawing.clips, "dance");
  const Image a = painted(drawing, one, posedBy(drawing, one, dance, 0.7f)),
              b = painted(drawing, other, posedBy(drawing, other, dance, 0.7f));
  CHECK((a.rgba == b.rgba).all());
}

TEST_CASE("an arm takes no piece of the body along that a net took for its shoulder") {
  RiggedDrawing drawing = inOneSheet();
  const Eigen::Vector2d shoulder = at(drawing, "right_shoulder"), body = at(drawing, "body");
  relabel(drawing, Part::kRightArm, [&](const Eigen::Vector2d& p) {
    return (p - shoulder).norm() + (p - body).norm() < 1.2 * (shoulder - body).norm();
  });
  const Plane8 limbs = limbPlane(figureOf(drawing), {});
  const Eigen::Vector2d elbow = at(drawing, "right_elbow");
  CHECK(int(limbs(int(elbow.y()), int(elbow.x()))) == 1);
  CHECK(int(limbs(int(body.y()), int(body.x()))) == 0);
}

TEST_CASE(
    "a limb that touches the body about its root alone is no sheet of its own, unless it holds something") {
  RiggedDrawing drawing = inOneSheet();
  const Eigen::Vector2d hand = at(drawing, "right_hand");
  const Plane8 as_drawn = drawing.layers.part;
  const auto hasArm = [&] { return (withoutFreeLimbs(figureOf(drawing), drawing.layers).limb == 1).any(); };
  drawing.layers.limb = (as_drawn == std::uint8_t(Part::kRightArm)).cast<std::uint8_t>();
  REQUIRE(drawing.layers.any());
  CHECK_FALSE(hasArm());
  relabel(drawing, Part::kThing, [&](const Eigen::Vector2d& p) { return (p - hand).norm() < 12; });
  CHECK(hasArm());
  drawing.layers.part = as_drawn;
  const Eigen::Vector2d body = at(drawing, "body");
  for (int y = 0; y < drawing.image.height; ++y)
    for (int x = 0; x < drawing.image.width; ++x)
      if (drawing.silhouette.mask(y, x) != 0 && (Eigen::Vector2d(x, y) - body).cwiseAbs().maxCoeff() < 20)
        drawing.layers.limb(y, x) = 1;
  CHECK(hasArm());
}

TEST_CASE(
    "paper beside the outermost line is taken off, what lines enclose and grounds of many colours are not") {
  Image image(80, 80);
  Silhouette figure;
  figure.mask = Plane8::Zero(80, 80);
  const auto away = [](int x, int y) { return (Eigen::Vector2d(x, y) - Eigen::Vector2d(40, 40)).norm(); };
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x) {
      const bool line = away(x, y) > 24 && away(x, y) < 28;
      const std::uint8_t value = line ? 30 : 250;
      std::copy_n(std::array<std::uint8_t, 4>{value, value, value, 255}.data(), 4, image.pixel(x, y));
      if (away(x, y) < 29.5) figure.mask(y, x) = 255;
    }
  const Image bare = withoutPaperRim(image, figure);
  CHECK(int(bare.pixel(69, 40)[3]) == 0);
  CHECK(int(bare.pixel(66, 40)[3]) == 255);
  CHECK(int(bare.pixel(60, 40)[3]) == 255);
  CHECK(int(bare.pixel(40, 40)[3]) == 255);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x)
      if (figure.mask(y, x) == 0) image.pixel(x, y)[(x + y) % 3] = 90;
  CHECK((withoutPaperRim(image, figure).rgba == image.rgba).all());
}

TEST_CASE("a slit that a brush left in a mask became a wide hole") {
  constexpr int kSide = 600;
  Image image(kSide, kSide);
  image.rgba.setConstant(255);
  Silhouette figure;
  figure.mask = Plane8::Zero(kSide, kSide);
  for (int y = 50; y < 550; ++y)
    for (int x = 200; x < 400; ++x) {
      figure.mask(y, x) = 255;
      const bool line = x < 204 || x >= 396 || y < 54 || y >= 546;
      if (line) std::fill_n(image.pixel(x, y), 3, std::uint8_t(30));
    }
  figure.mask.block(150, 250, 5, 60).setZero();   // a slit
  figure.mask.block(400, 250, 40, 60).setZero();  // what somebody has erased
  const Image bare = withoutPaperRim(image, figure);
  CHECK(int(bare.pixel(280, 147)[3]) == 255);
  CHECK(int(bare.pixel(280, 397)[3]) == 0);
}

TEST_CASE("legs hold no skirt") {
  RiggedDrawing drawing = inOneSheet();
  relabel(drawing, Part::kTrunk, [](const Eigen::Vector2d&) { return true; });
  const auto heldByLegs = [&] {
    int count = 0;
    for (const CutOutSheet& sheet : cutOutOf(drawing).sheets)
      for (const CutOutSheet::Handle& handle : sheet.handles) {
        const std::string& joint = drawing.character.skeleton.joints[handle.joint].name;
        count += joint.ends_with("_hip") || joint.ends_with("_knee") || joint.ends_with("_foot");
      }
    return count;
  };
  CHECK(heldByLegs() > 0);
  const double waist = at(drawing, "pelvis").y();
  relabel(drawing, Part::kSkirt, [&](const Eigen::Vector2d& p) { return p.y() > waist; });
  CHECK(heldByLegs() == 0);
}

TEST_CASE("legs that come out from under a skirt swing behind its hem, which stays whole") {
  RiggedDrawing drawing = inOneSheet();
  const double waist = at(drawing, "pelvis").y();
  const double hem = 0.2 * at(drawing, "left_hip").y() + 0.8 * at(drawing, "left_knee").y();
  const double middle = at(drawing, "pelvis").x();
  relabel(drawing, Part::kTrunk, [](const Eigen::Vector2d&) { return true; });
  const auto legs = [&](Part left, Part right) {
    relabel(drawing, left, [&](const Eigen::Vector2d& p) { return p.y() > hem && p.x() > middle; });
    relabel(drawing, right, [&](const Eigen::Vector2d& p) { return p.y() > hem && p.x() <= middle; });
  };
  const auto sheetsOf = [&] {
    std::vector<int> layers;
    for (const CutOutSheet& sheet : cutOutOf(drawing).sheets) layers.push_back(sheet.layer);
    return layers;
  };
  legs(Part::kLeftLeg, Part::kRightLeg);
  CHECK(sheetsOf() == std::vector<int>{0});
  relabel(drawing, Part::kSkirt, [&](const Eigen::Vector2d& p) { return p.y() > waist && p.y() <= hem; });
  CHECK(sheetsOf().size() == 3);
  const CutOut cut_out = cutOutOf(drawing);
  std::size_t last_leg = 0, first_trunk = cut_out.patches.size();
  for (std::size_t i = 0; i < cut_out.patches.size(); ++i)
    if (cut_out.sheets[cut_out.patches[i].sheet].layer == 0)
      first_trunk = std::min(first_trunk, i);
    else
      last_leg = i;
  CHECK(last_leg < first_trunk);
  // A leg's sheet goes on below the skirt, the skirt's ends at the hem.
  const auto shows = [&](const CutOutSheet& sheet, const Eigen::Vector2d& p) {
    const Eigen::Vector2d in_sheet =
        p + sheet.placed.origin_px - drawing.character.mesh.model_from_image.origin_px;
    const int x = int(in_sheet.x()), y = int(in_sheet.y());
    return x >= 0 && y >= 0 && x < sheet.picture.width && y < sheet.picture.height &&
           sheet.picture.pixel(x, y)[3] != 0;
  };
  const Eigen::Vector2d knee = at(drawing, "left_knee"), hip = at(drawing, "left_hip");
  const Eigen::Vector2d below = knee, above = hip + (hem - 5 - hip.y()) / (knee.y() - hip.y()) * (knee - hip);
  int legs_above = 0, legs_below = 0;
  for (const CutOutSheet& sheet : cut_out.sheets)
    if (sheet.layer == 0) {
      CHECK(shows(sheet, above));
      CHECK_FALSE(shows(sheet, below));
    } else {
      legs_above += shows(sheet, above), legs_below += shows(sheet, below);
    }
  CHECK(legs_above == 1);
  CHECK(legs_below == 1);
  // A net's teeth along the hem are smoothed.
  relabel(drawing, Part::kSkirt,
          [&](const Eigen::Vector2d& p) { return p.y() > hem && p.y() <= hem + 5 && int(p.x()) % 8 < 2; });
  const CutOutSheet trunk = cutOutOf(drawing).sheets.front();
  REQUIRE(trunk.layer == 0);
  for (int x = int(knee.x()) - 8; x < int(knee.x()) + 8; ++x) {
    CAPTURE(x);
    CHECK(shows(trunk, {x, hem - 3}));
    CHECK_FALSE(shows(trunk, {x, hem + 4}));
  }
}
