#include "libskel/cutout/limb_plane.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "libskel/image/mask_parts.h"
#include "libskel/mesh/outline.h"

namespace skel {
namespace {

using Eigen::Vector2d;

constexpr double kHeld = 0.25;   // of what a thing touches, so much is the limb that holds it
constexpr double kSpeck = 0.05;  // of all that is of a limb

// 1 on what is no limb's and not the trunk's for sure: things, and specks apart from the rest of their part.
Plane8 unsure(const Plane8& mask, const Plane8& part, const Plane8& limbs) {
  Plane8 result = (mask != 0 && part == std::uint8_t(Part::kThing)).cast<std::uint8_t>();
  for (int limb = 0; limb < 5; ++limb) {
    const MaskParts parts =
        maskParts((mask != 0 && result == 0 && limbs == std::uint8_t(limb)).cast<std::uint8_t>());
    const double all = double(std::accumulate(parts.size.begin(), parts.size.end(), std::int64_t{0}));
    for (const MaskParts::Run& run : parts.runs)
      if (double(parts.size[std::size_t(run.part)]) < kSpeck * all)
        result.row(run.y).segment(run.x0, run.x1 - run.x0).setOnes();
  }
  return result;
}

// Takes from the arms what lies about their roots and is wider than they are farther out: a piece of the
// trunk that a net took for a shoulder would be torn out of it. Legs widen to the hip.
void trimArms(const DrawnFigure& figure, Plane8& limbs) {
  constexpr double kRoot = 0.5;   // so far along the upper bone
  constexpr double kMost = 0.9;   // of the arm's pixels farther out lie within its reach
  constexpr double kWider = 1.5;  // of that reach
  for (std::size_t k = 0; k < std::min<std::size_t>(4, figure.body_plan.limbs.size()); ++k) {
    if (isLeg(figure.body_plan, figure.body_plan.limbs[k])) continue;
    const LimbBones bones = limbBones(figure, k + 1);
    std::vector<double> reach;
    std::vector<std::pair<double, std::uint8_t*>> about_root;
    for (int y = 0; y < limbs.rows(); ++y)
      for (int x = 0; x < limbs.cols(); ++x) {
        if (limbs(y, x) != std::uint8_t(k + 1)) continue;
        const LimbBones::Near from = bones.nearest(Vector2d(x, y));
        if (from.along < kRoot)
          about_root.emplace_back(from.distance, &limbs(y, x));
        else if (from.along < 2)
          reach.push_back(from.distance);
      }
    if (reach.empty()) continue;
    const auto most = reach.begin() + std::ptrdiff_t(kMost * double(reach.size() - 1));
    std::nth_element(reach.begin(), most, reach.end());
    for (const auto& [distance, limb] : about_root)
      if (distance > kWider * *most) *limb = 0;
  }
}

}  // namespace

LimbBones limbBones(const DrawnFigure& figure, std::size_t limb) {
  LimbBones bones;
  for (std::size_t i = 0; i < 3; ++i) {
    const int of_plan = figure.body_plan.limbs[limb - 1].joints[i];
    const int joint = figure.skeleton.find(figure.body_plan.joints[std::size_t(of_plan)].name);
    bones.joints[i] = joint < 0 ? Vector2d::Zero().eval() : figure.skeleton.joints[std::size_t(joint)].image;
  }
  return bones;
}

Plane8 limbPlane(const DrawnFigure& figure, const std::vector<FigurePiece>& pieces) {
  const Plane8 &part = figure.layers.part, &mask = figure.silhouette.mask;
  Plane8 limbs = Plane8::Zero(mask.rows(), mask.cols());
  if (part.size() == 0) return limbs;
  const auto isSheet = [&](int layer) {
    return std::any_of(pieces.begin(), pieces.end(), [&](const FigurePiece& p) { return p.layer == layer; });
  };
  for (int limb = 0; limb < 4; ++limb)
    if (std::count(figure.layers.hidden.begin(), figure.layers.hidden.end(), limb + 1) == 0 &&
        !isSheet(limb + 1))
      limbs = (part == std::uint8_t(limbPart(limb)))
                  .select(Plane8::Constant(part.rows(), part.cols(), std::uint8_t(limb + 1)), limbs);
  trimArms(figure, limbs);
  const MaskParts specks = maskParts(unsure(mask, part, limbs));
  const std::vector<std::array<int, 256>> touched = valuesBeside(specks, mask, limbs);
  for (const MaskParts::Run& run : specks.runs) {
    const std::array<int, 256>& by = touched[std::size_t(run.part)];
    const auto most = std::max_element(by.begin() + 1, by.end());
    const bool held = *most > kHeld * std::accumulate(by.begin(), by.end(), 0);
    limbs.row(run.y)
        .segment(run.x0, run.x1 - run.x0)
        .setConstant(held ? std::uint8_t(most - by.begin()) : std::uint8_t(0));
  }
  return limbs;
}

std::vector<double> limbWidths(const DrawnFigure& figure, const Plane8& limbs) {
  std::vector<double> widths(5, 0);
  for (std::size_t k = 0; k < std::min<std::size_t>(4, figure.body_plan.limbs.size()); ++k) {
    const double length = limbBones(figure, k + 1).length();
    if (length > 0) widths[k + 1] = double((limbs == std::uint8_t(k + 1)).count()) / length;
  }
  return widths;
}

}  // namespace skel
