#include "libskel/pipeline/drawn_cut_out.h"

#include <algorithm>
#include <vector>

#include "libskel/core/parallel.h"
#include "libskel/deform/measure_figure.h"
#include "libskel/pipeline/posed_character.h"
#include "libskel/skeleton/hanging.h"

namespace skel {
namespace {

// Arms that are one piece with the body would leave behind what they are one with.
LayerMap layersOfCutOut(const RiggedDrawing& drawing) {
  LayerMap layers = drawing.layers;
  const RiggedCharacter& character = drawing.character;
  const FigureShape shape =
      measureFigure(character.mesh, character.weights, character.skeleton, character.facing);
  for (std::size_t k = 0; k < drawing.body_plan.limbs.size(); ++k) {
    const TemplateLimb& limb = drawing.body_plan.limbs[k];
    const int elbow = character.skeleton.find(drawing.body_plan.joints[std::size_t(limb.joints[1])].name);
    if (isLeg(drawing.body_plan, limb) || elbow < 0 || shape.joined[std::size_t(elbow)] < kGrownArm) continue;
    const bool own = layers.has(int(k) + 1);
    if (own && layers.painted) continue;
    layers.hidden.push_back(int(k) + 1);
    if (own) layers.limb = (layers.limb == std::uint8_t(k + 1)).select(std::uint8_t(0), layers.limb);
  }
  return layers;
}

}  // namespace

CutOut cutOutOf(const RiggedDrawing& drawing) {
  return makeCutOut({drawing.colors(), drawing.silhouette, withoutHanging(drawing.character.skeleton),
                     drawing.body_plan, layersOfCutOut(drawing), drawing.character.mesh.model_from_image});
}

Calm calmFor(const RiggedDrawing& drawing, const CutOut& cut_out, const Clip& clip) {
  constexpr int kMoments = 32;
  constexpr Calm kSteps[] = {{1, 1}, {.6, 1}, {.3, 1}, {.1, 1}, {.1, .6}, {.1, .3}};
  Calm calm;
  for (const Calm& step : kSteps) {
    std::vector<double> torn(kMoments);
    parallelFor(torn.size(), 0, [&](std::size_t i) {
      const double time_s = double(clip.duration_s()) * double(i) / (kMoments - 1);
      torn[i] = tornShare(cut_out, posedSheets(cut_out, flatPoseAt(drawing, clip, time_s, step)));
    });
    calm = {step.legs, step.rest, *std::max_element(torn.begin(), torn.end())};
    if (calm.torn <= kMuchTorn) break;
  }
  return calm;
}

FlatPose flatPoseAt(const RiggedDrawing& drawing, const Clip& clip, double time_s, const Calm& calm) {
  const Skeleton& skeleton = drawing.character.skeleton;
  const FlatPose pose = flatPose(skeleton, drawing.body_plan, posedAt(drawing.character, clip, time_s));
  return calm.legs == 1 && calm.rest == 1 ? pose
                                          : calmed(pose, skeleton, drawing.body_plan, calm.legs, calm.rest);
}

}  // namespace skel
