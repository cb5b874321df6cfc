#include <algorithm>

#include "libskel/core/error.h"
#include "trainer/figures/biped_painter.h"
#include "trainer/figures/drawing.h"
#include "trainer/figures/other_figures.h"
#include "trainer/figures/quadruped_painter.h"

namespace skel {
namespace {

Drawing drawBiped(Rng& rng, int kind) {
  const BipedPlan plan = sampleBipedPlan(rng, static_cast<BodyKind>(kind));
  PaintedBiped painted = paintBiped(rng, plan);
  return {
      std::move(painted.scene), true, {painted.joints.begin(), painted.joints.end()}, plan.view, kind, {}};
}

FigurePlan biped() {
  FigurePlan plan;
  plan.body_plan = "biped";
  plan.joints = {{"head", PartOwner::kHead, false}, {"body", PartOwner::kTorso, false}};
  for (const bool left : {true, false}) {
    const std::string side = left ? "left_" : "right_";
    const PartOwner arm = left ? PartOwner::kLeftArm : PartOwner::kRightArm;
    const PartOwner leg = left ? PartOwner::kLeftLeg : PartOwner::kRightLeg;
    for (const char* joint : {"shoulder", "elbow", "hand"})
      plan.joints.push_back({side + joint, arm, joint == std::string_view("hand")});
    for (const char* joint : {"hip", "knee", "foot"})
      plan.joints.push_back({side + joint, leg, joint == std::string_view("foot")});
  }
  plan.kinds = {.12, .12, .12, .15, .11, .05, .06, .10, .05, .06, .04, .05};  // as BodyKind
  plan.draw = drawBiped;
  plan.drawOther = paintOther;
  return plan;
}

Drawing drawQuadruped(Rng& rng, int kind) {
  const QuadrupedPlan animal = sampleQuadrupedPlan(rng, static_cast<AnimalKind>(kind));
  PaintedQuadruped painted = paintQuadruped(rng, animal);
  // Near and far legs cannot be told apart: sides go by the picture, as in side views of a biped.
  return {std::move(painted.scene), true, {painted.joints.begin(), painted.joints.end()},
          FigureView::kSide,        kind, animal.has_tail ? std::vector<int>{} : std::vector<int>{3}};
}

FigurePlan quadruped() {
  FigurePlan plan;
  plan.body_plan = "quadruped";
  plan.joints = {{"head", PartOwner::kHead, false},
                 {"body", PartOwner::kTorso, false},
                 {"tail_root", PartOwner::kTail, false},
                 {"tail", PartOwner::kTail, true}};
  for (const bool left : {true, false}) {
    const std::string side = left ? "left_" : "right_";
    const PartOwner front = left ? PartOwner::kLeftArm : PartOwner::kRightArm;
    const PartOwner hind = left ? PartOwner::kLeftLeg : PartOwner::kRightLeg;
    for (const std::string joint : {"shoulder", "elbow", "front_foot"})
      plan.joints.push_back({side + joint, front, joint == "front_foot"});
    for (const std::string joint : {"hip", "knee", "hind_foot"})
      plan.joints.push_back({side + joint, hind, joint == "hind_foot"});
  }
  plan.kinds = {.12, .10, .08, .08, .08, .06, .05, .04, .05, .05, .06, .03, .06, .10, .04};  // as AnimalKind
  plan.draw = drawQuadruped;
  plan.drawOther = paintNoAnimal;
  return plan;
}

}  // namespace

int sampleKind(Rng& rng, const FigurePlan& plan, const std::vector<int>& kinds) {
  if (!kinds.empty()) return kinds[rng.below(static_cast<std::uint32_t>(kinds.size()))];
  double r = rng.uniform();
  int i = 0;
  while (i + 1 < static_cast<int>(plan.kinds.size()) && r >= plan.kinds[i]) r -= plan.kinds[i++];
  return i;
}

std::vector<std::string> jointNames(const FigurePlan& plan) {
  std::vector<std::string> names;
  for (const FigurePlan::Joint& joint : plan.joints) names.push_back(joint.name);
  return names;
}

std::span<const FigurePlan> figurePlans() {
  static const std::vector<FigurePlan> plans = {biped(), quadruped()};
  return plans;
}

const FigurePlan& figurePlan(std::string_view body_plan) {
  const auto plans = figurePlans();
  const auto plan =
      std::find_if(plans.begin(), plans.end(), [&](const FigurePlan& p) { return p.body_plan == body_plan; });
  if (plan != plans.end()) return *plan;
  std::string known;
  for (const FigurePlan& p : plans) known += (known.empty() ? "" : ", ") + std::string(p.body_plan);
  throw UsageError("no figures can be drawn of the template \"" + std::string(body_plan) +
                   "\"; there are figures of: " + known);
}

}  // namespace skel
