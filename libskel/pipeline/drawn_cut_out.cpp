#include "libskel/pipeline/drawn_cut_out.h"

#include "libskel/deform/measure_figure.h"
#include "libskel/pipeline/posed_character.h"
#include "libskel/skeleton/hanging.h"

namespace skel {
namespace {

LayerMap layersOfCutOut(const RiggedDrawing& drawing) {
  LayerMap layers = drawing.layers;
  const RiggedCharacter& character = drawing.character;
  const FigureShape shape =
      measureFigure(character.mesh, character.weights, character.skeleton, character.facing);
  for (std::size_t k = 0; k < drawing.body_plan.limbs.size(); ++k) {
    const TemplateLimb& limb = drawing.body_plan.limbs[k];
    const int elbow = character.skeleton.find(drawing.body_plan.joints[std::size_t(limb.joints[1])].name);
    if (isLeg(drawing.body_plan, limb) || elbow < 0 || (layers.limb == std::uint8_t(k + 1)).any()) continue;
    if (shape.joined[std::size_t(elbow)] >= kGrownArm) layers.hidden.push_back(int(k) + 1);
  }
  return layers;
}

}  // namespace

CutOut cutOutOf(const RiggedDrawing& drawing) {
  return makeCutOut({drawing.colors(), drawing.silhouette, withoutHanging(drawing.character.skeleton),
                     drawing.body_plan, layersOfCutOut(drawing), drawing.character.mesh.model_from_image});
}

FlatPose flatPoseAt(const RiggedDrawing& drawing, const Clip& clip, double time_s) {
  return flatPose(drawing.character.skeleton, drawing.body_plan, posedAt(drawing.character, clip, time_s));
}

}  // namespace skel
