#include "libskel/animation/role_figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libskel/animation/clip_library.h"
#include "libskel/animation/joint_roles.h"
#include "libskel/animation/retarget.h"

namespace skel {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// About the vertical.
Quaterniond levelTurn(const Vector3d& from, const Vector3d& to) {
  const double angle =
      std::atan2(from.z() * to.x() - from.x() * to.z(), from.x() * to.x() + from.z() * to.z());
  return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
}

// By what the limbs say: where the left is.
Vector3d bipedForwards(const JointRoles& roles, const Skeleton& skeleton) {
  Vector3d left = Vector3d::Zero();
  for (const std::string joint : {"hip", "shoulder"})
    left += skeleton.joints[std::size_t(roles.joint("left_" + joint))].position -
            skeleton.joints[std::size_t(roles.joint("right_" + joint))].position;
  return left.cross(Vector3d::UnitY());
}

bool moves(const Skeleton& skeleton, const JointTrack& track) { return skeleton.find(track.joint) >= 0; }

}  // namespace

std::optional<RoleFigure> roleFigure(const Skeleton& theirs) {
  RoleFigure figure;
  std::vector<RoleJoint> parts;
  if (QuadrupedRoles animal = findQuadrupedRoles(theirs); !animal.joints.empty()) {
    figure.skeleton.template_name = "quadruped";
    figure.to_ours = levelTurn(animal.forwards, -Vector3d::UnitX());
    parts = std::move(animal.joints);
  } else {
    const JointRoles roles = findJointRoles(theirs);
    for (std::size_t role = 0; role < kJointRoles.size(); ++role)
      if (roles.joints[role] >= 0) parts.push_back({std::string(kJointRoles[role]), roles.joints[role]});
    const int chest = roles.joint("neck") >= 0 ? roles.joint("neck") : roles.joint("body");
    if (roles.joint("left_hip") < 0 || chest < 0) return std::nullopt;
    const Vector3d up = theirs.joints[std::size_t(chest)].position -
                        theirs.joints[std::size_t(roles.joint("pelvis"))].position;
    if (!(up.y() > 0.7 * up.norm())) return std::nullopt;
    figure.skeleton.template_name = "biped";
    figure.to_ours = levelTurn(bipedForwards(roles, theirs), Vector3d::UnitZ());
    std::sort(parts.begin(), parts.end(),
              [](const RoleJoint& a, const RoleJoint& b) { return a.joint < b.joint; });
  }
  for (std::size_t j = 0; j < theirs.joints.size(); ++j) {
    const Joint& joint = theirs.joints[j];
    // What is above the hips moves with them: the root's place does.
    int carrier = joint.parent < 0 ? 0 : figure.carriers[std::size_t(joint.parent)];
    for (const RoleJoint& part : parts)
      if (part.joint == int(j)) {
        Joint ours;
        ours.name = part.role;
        ours.parent = figure.skeleton.joints.empty() ? -1 : carrier;
        ours.position = figure.to_ours * joint.position;
        carrier = int(figure.skeleton.joints.size());
        figure.skeleton.joints.push_back(ours);
        figure.theirs.push_back(int(j));
        break;
      }
    figure.carriers.push_back(carrier);
  }
  if (figure.skeleton.joints[0].name != "pelvis") return std::nullopt;
  return figure;
}

bool isFor(const Clip& clip, const RoleFigure& figure) {
  const std::string& body_plan = figure.skeleton.template_name;
  return clip.template_name.empty() ? fits(clip, loadTemplate(body_plan)) : clip.template_name == body_plan;
}

bool hasParts(const Clip& clip, const RoleFigure& figure) {
  if (!faultOf(clip, figure.skeleton).empty()) return false;
  const auto there = std::count_if(clip.tracks.begin(), clip.tracks.end(),
                                   [&](const JointTrack& track) { return moves(figure.skeleton, track); });
  return (isOwn(clip) ? there > 0 : 2 * std::size_t(there) > clip.tracks.size()) &&
         std::all_of(clip.contacts.begin(), clip.contacts.end(),
                     [&](const FootContact& contact) { return figure.skeleton.find(contact.joint) >= 0; });
}

bool fits(const Clip& clip, const RoleFigure& figure) {
  return isFor(clip, figure) && hasParts(clip, figure);
}

Clip retargetByRoles(const Clip& clip, const RoleFigure& figure, const Skeleton& theirs,
                     const FigureShape& shape) {
  Clip ours = clip;
  std::erase_if(ours.tracks, [&](const JointTrack& track) { return !moves(figure.skeleton, track); });
  // A model of an animal stands as such animals do, its thighs aslant: no drawing's pose to be taken back.
  if (clip.template_name == "quadruped")
    for (JointTrack& track : ours.tracks) track.slack_rad = float(2 * std::numbers::pi);
  RetargetOptions options;
  options.shape = shape;
  Clip result = retargetToRest(ours, figure.skeleton, options);
  const Eigen::Quaternionf to_theirs = figure.to_ours.conjugate().cast<float>();
  for (JointTrack& track : result.tracks) {
    const int joint = figure.skeleton.index(track.joint);
    track.joint = theirs.joints[std::size_t(figure.theirs[std::size_t(joint)])].name;
    for (Eigen::Quaternionf& rotation : track.rotations)
      rotation = (to_theirs * rotation * to_theirs.conjugate()).normalized();
    for (Eigen::Vector3f& way : track.translations_m) way = to_theirs * way;
  }
  for (Eigen::Vector3f& way : result.root_translations) way = to_theirs * way;
  return result;
}

}  // namespace skel
