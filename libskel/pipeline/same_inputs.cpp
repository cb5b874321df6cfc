// Structs are taken apart by structured bindings, so that none with a new member compiles until it says here
// what that means.
#include "libskel/pipeline/same_inputs.h"

#include <algorithm>
#include <tuple>

namespace skel {
namespace {

template <class A>
bool sameArray(const A& a, const A& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && std::equal(a.data(), a.data() + a.size(), b.data());
}
template <class T>
bool sameList(const std::vector<T>& a, const std::vector<T>& b, bool (*same_item)(const T&, const T&)) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_item);
}

auto members(const SilhouetteOptions& options) {
  const auto& [method, figure, all, alpha, fill_holes, page_net] = options;
  return std::tie(method, figure, all, alpha, fill_holes, page_net);
}

bool sameLayer(const MlpLayer& a, const MlpLayer& b) {
  return sameArray(a.weights, b.weights) && sameArray(a.biases, b.biases);
}

auto members(const Derivation& derivation) {
  const auto& [rule, from] = derivation;
  return std::tie(rule, from);
}
bool sameJoint(const TemplateJoint& a, const TemplateJoint& b) {
  const auto& [name, parent, mirror, preset, bone_class, class_from, derived] = a;
  const bool same_rule = derived && b.derived ? members(*derived) == members(*b.derived)
                                              : derived.has_value() == b.derived.has_value();
  return same_rule && std::tie(name, parent, mirror, preset, bone_class, class_from) ==
                          std::tie(b.name, b.parent, b.mirror, b.preset, b.bone_class, b.class_from);
}
bool sameLimb(const TemplateLimb& a, const TemplateLimb& b) {
  const auto members = [](const TemplateLimb& limb) {
    const auto& [limb_class, joints] = limb;
    return std::tie(limb_class, joints);
  };
  return members(a) == members(b);
}
auto members(const RecognitionRules& rules) {
  const auto& [line_reach, limb_probability, limb_radius, separation_px] = rules;
  return std::tie(line_reach, limb_probability, limb_radius, separation_px);
}
bool samePlan(const SkeletonTemplate& a, const SkeletonTemplate& b) {
  const auto& [name, joints, head, body, limbs, rules, from_side, length_m] = a;
  return std::tie(name, head, body, from_side, length_m) ==
             std::tie(b.name, b.head, b.body, b.from_side, b.length_m) &&
         members(rules) == members(b.rules) && sameList(joints, b.joints, sameJoint) &&
         sameList(limbs, b.limbs, sameLimb);
}

bool sameJoint(const Joint& a, const Joint& b) {
  const auto members = [](const Joint& joint) {
    const auto& [name, parent, image, position, confidence, origin, tail] = joint;
    return std::tie(name, parent, image, position, confidence, origin, tail);
  };
  return members(a) == members(b);
}

// But what each figure has of its own.
bool sameBody(const InflateOptions& a, const InflateOptions& b) {
  const auto members = [](const InflateOptions& options) {
    const auto& [spacing_px, thickness, max_texture_px, height_m, length_m, turned_rad, thin_outline, body,
                 back, head, back_picture] = options;
    return std::tie(spacing_px, thickness, max_texture_px, height_m, thin_outline, back_picture);
  };
  return members(a) == members(b);
}

auto members(const SkinOptions& options) {
  const auto& [max_influences, smoothing, regions, file] = options;
  return std::tie(max_influences, smoothing, regions, file);
}

}  // namespace

bool same(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && sameArray(a.rgba, b.rgba);
}
bool same(const Plane8& a, const Plane8& b) { return sameArray(a, b); }
bool same(const NamedPicture& a, const NamedPicture& b) { return a.file == b.file && same(a.image, b.image); }
bool same(const Skeleton& a, const Skeleton& b) {
  return a.template_name == b.template_name && sameList(a.joints, b.joints, sameJoint);
}

std::vector<RigPart> changes(const RigOptions& from, const RigOptions& to) {
  const auto& [last, silhouette, candidates, mlp, body_plan, otherwise, recognizer, upright, joint_nets,
               joint_net, layers, cut_limbs, part_net, inflate, back, height_m, facing_rad, skin_method, skin,
               rest_pose, clips, into_picture] = from;
  const bool other_plan = otherwise.has_value() != to.otherwise.has_value() ||
                          (otherwise && !samePlan(otherwise->body_plan, to.otherwise->body_plan));
  const bool other_clips =
      clips != to.clips || (otherwise && to.otherwise && otherwise->clips != to.otherwise->clips);
  std::vector<RigPart> parts;
  const auto note = [&](RigPart part, bool differs) {
    if (differs) parts.push_back(part);
  };
  note(RigPart::kSilhouetteOptions, members(silhouette) != members(to.silhouette));
  note(RigPart::kCandidateOptions, candidates.method != to.candidates.method);
  note(RigPart::kRecognitionOptions,
       other_plan || !samePlan(body_plan, to.body_plan) || !sameList(mlp.layers, to.mlp.layers, sameLayer) ||
           std::tie(recognizer, upright, joint_nets, joint_net) !=
               std::tie(to.recognizer, to.upright, to.joint_nets, to.joint_net));
  note(RigPart::kLayerOptions,
       std::tie(layers, cut_limbs, part_net) != std::tie(to.layers, to.cut_limbs, to.part_net));
  note(RigPart::kMeshOptions,
       !sameBody(inflate, to.inflate) ||
           std::tie(back, height_m, facing_rad) != std::tie(to.back, to.height_m, to.facing_rad));
  note(RigPart::kSkinOptions, skin_method != to.skin_method || members(skin) != members(to.skin));
  note(RigPart::kRestPose, rest_pose != to.rest_pose);
  note(RigPart::kRetargetOptions, into_picture != to.into_picture);
  note(RigPart::kClips, other_clips || last != to.last);
  return parts;
}

}  // namespace skel
