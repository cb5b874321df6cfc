#include "libskel/pipeline/check_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

#include "libskel/animation/check_clip.h"
#include "libskel/core/error.h"
#include "libskel/image/check_image.h"
#include "libskel/mesh/check_mesh.h"
#include "libskel/skeleton/check_skeleton.h"

namespace skel {
namespace {

constexpr double kLeastHeight_m = 1e-3, kMostHeight_m = 1e5, kThinnest = 1e-3, kThickest = 1e3,
                 kMostSmoothing = 1000;

void checkWithin(const char* member, double value, double low, double high) {
  if (value >= low && value <= high) return;
  std::ostringstream text;
  text << member << " is " << value << ", must be from " << low << " to " << high;
  throw UsageError(text.str());
}

void checkAtLeast(const char* member, double value, double low) {
  if (value >= low && std::isfinite(value)) return;
  std::ostringstream text;
  text << member << " is " << value << ", must be " << low << " or more";
  throw UsageError(text.str());
}

void checkModel(const TriangleMesh& model) {
  constexpr float kFlat = 1e-4f;  // of its longest side
  checkMesh(model, "RigInput::model");
  const Eigen::RowVector3f size = model.vertices.colwise().maxCoeff() - model.vertices.colwise().minCoeff();
  if (!(size.y() > kFlat * size.maxCoeff()))
    throw UsageError("RigInput::model is flat: it has no height along y; turn it so that y points up");
}

void checkGivenSkeleton(const Skeleton& skeleton) {
  const std::string name = "RigInput::skeleton";
  checkSkeleton(skeleton, name);
  std::set<std::string_view> names;
  for (const Joint& joint : skeleton.joints) {
    checkJointPlace(joint.name, joint.image, name);
    if (!std::isfinite(joint.confidence))
      throw UsageError(name + ": the confidence of \"" + joint.name + "\" must be finite");
    if (!names.insert(joint.name).second) throw UsageError(name + " has two joints \"" + joint.name + "\"");
  }
}

void checkInput(const RigInput& input) {
  checkImage(input.image, "RigInput::image");
  if (input.mask && !input.image.empty())
    checkPlaneOf(*input.mask, "RigInput::mask", input.image, "RigInput::image");
  if (input.model) checkModel(*input.model);
  if (input.back) checkImage(input.back->image, "RigInput::back");
  if (input.layers) checkImage(input.layers->image, "RigInput::layers");
  if (input.skeleton) checkGivenSkeleton(*input.skeleton);
  for (const auto& [joint, image_px] : input.placed) checkJointPlace(joint, image_px, "RigInput::placed");
}

// 3-…-2, as classify() wants it.
void checkMlp(const Mlp& mlp) {
  Eigen::Index inputs = 3;
  bool fit = !mlp.layers.empty();
  for (const MlpLayer& layer : mlp.layers) {
    fit = fit && layer.weights.cols() == inputs && layer.weights.rows() == layer.biases.size() &&
          layer.weights.allFinite() && layer.biases.allFinite();
    inputs = layer.weights.rows();
  }
  if (!fit || inputs != 2)
    throw UsageError(
        "RigOptions::mlp must have layers of finite numbers that fit, of 3 inputs and 2 outputs");
}

// What a template file cannot say, either.
void checkBodyPlan(const SkeletonTemplate& plan, const std::string& name) {
  const int count = int(plan.joints.size());
  const auto refuse = [&](const std::string& why) { throw UsageError(name + ": " + why); };
  if (count == 0) refuse("has no joints; take loadTemplate()");
  const auto isJoint = [&](int joint) { return joint >= 0 && joint < count; };
  for (int j = 0; j < count; ++j) {
    const TemplateJoint& joint = plan.joints[std::size_t(j)];
    if (j == 0 ? joint.parent != -1 : joint.parent < 0 || joint.parent >= j)
      refuse("joints[" + std::to_string(j) + "].parent must be a joint before it, and -1 for the root");
    const bool derives =
        !joint.derived || (isJoint(joint.derived->from[0]) && isJoint(joint.derived->from[1]));
    if (joint.mirror >= count || joint.mirror < -1 || !derives)
      refuse("joints[" + std::to_string(j) + "] names a joint that there is not");
    if (!joint.preset.allFinite()) refuse("joints[" + std::to_string(j) + "].preset must be finite");
  }
  if (plan.head >= count || plan.head < -1 || plan.body >= count || plan.body < -1)
    refuse("head or body is a joint that there is not");
  for (const TemplateLimb& limb : plan.limbs)
    if (!std::all_of(limb.joints.begin(), limb.joints.end(), isJoint))
      refuse("limbs names a joint that there is not");
  if (!(plan.length_m >= 0 && plan.length_m <= kMostHeight_m)) refuse("length_m must be 0 or a length");
}

void checkInflate(const InflateOptions& inflate) {
  checkAtLeast("RigOptions::inflate.spacing_px", inflate.spacing_px, 0);
  checkWithin("RigOptions::inflate.thickness", inflate.thickness, kThinnest, kThickest);
  checkAtLeast("RigOptions::inflate.max_texture_px", inflate.max_texture_px, kLeastMaxTexture);
  checkWithin("RigOptions::inflate.height_m", inflate.height_m, kLeastHeight_m, kMostHeight_m);
  if (!inflate.back_picture) return;
  const std::string name = "RigOptions::inflate.back_picture";
  checkImage(inflate.back_picture->image, name);
  checkPlaneOf(inflate.back_picture->mask, name + "->mask", inflate.back_picture->image, name + "->image");
}

void checkOptions(const RigOptions& options) {
  checkAtLeast("RigOptions::silhouette.figure", options.silhouette.figure, 1);
  if (options.silhouette.alpha) checkWithin("RigOptions::silhouette.alpha", *options.silhouette.alpha, 0, 1);
  checkMlp(options.mlp);
  checkBodyPlan(options.body_plan, "RigOptions::body_plan");
  if (options.otherwise) checkBodyPlan(options.otherwise->body_plan, "RigOptions::otherwise->body_plan");
  checkInflate(options.inflate);
  if (options.height_m != 0)
    checkWithin("RigOptions::height_m", options.height_m, kLeastHeight_m, kMostHeight_m);
  const std::vector<SkinMethod> methods = skinMethods();
  if (std::find(methods.begin(), methods.end(), options.skin_method) == methods.end())
    throw UsageError("RigOptions::skin_method is none of skinMethods()");
  checkWithin("RigOptions::skin.max_influences", options.skin.max_influences, 1, 4);
  checkWithin("RigOptions::skin.smoothing", options.skin.smoothing, 0, kMostSmoothing);
  if (options.facing_rad)
    checkWithin("RigOptions::facing_rad", *options.facing_rad, -std::numbers::pi, std::numbers::pi);
  checkWithin("RigOptions::into_picture", options.into_picture, 0, 1);
  for (const Clip& clip : options.clips) checkClip(clip, "RigOptions::clips: ");
  if (options.otherwise)
    for (const Clip& clip : options.otherwise->clips) checkClip(clip, "RigOptions::otherwise->clips: ");
}

}  // namespace

void checkRig(const RigInput& input, const RigOptions& options) {
  checkInput(input);
  checkOptions(options);
}

}  // namespace skel
