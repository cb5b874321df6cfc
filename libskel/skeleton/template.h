// What a body plan is: one JSON file names its joints, where they usually lie, and how they are found.
// Another body plan is another file.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "libskel/skeleton/joint_class.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

// How a joint is computed from others instead of being recognised.
enum class DerivationRule {
  kMidpoint,  // half way between two joints
  kTip,       // beyond the second joint, seen from the first, near the figure's outline
};

struct Derivation {
  DerivationRule rule;
  std::array<int, 2> from;  // joints
};

struct TemplateJoint {
  std::string name;
  int parent = -1;
  int mirror = -1;  // its counterpart of the other side; itself if it lies in the middle
  Eigen::Vector2d
      preset;  // in the figure's bounding box: (0, 0) top left, (1, 1) bottom right; facing the viewer
  // The class of candidates nearest to the bone from the parent, from the share `class_from` of its length
  // on; before that they are of the parent's bone_class. Nothing: such candidates belong to other bones.
  std::optional<JointClass> bone_class;
  double class_from = 0;
  std::optional<Derivation> derived;
};

// A chain of joints that one line of candidates gives: shoulder, elbow, hand or hip, knee, foot.
struct TemplateLimb {
  JointClass limb_class;      // of its candidates
  std::array<int, 3> joints;  // from the trunk outwards
};

// The numbers of the rules of Shu & Yang (2018).
struct RecognitionRules {
  double line_reach =
      1;  // (1): two candidates are of one line when they are at most line_reach · (D1 + D2) apart
  double limb_probability = 0.5;  // (3): least P_hand + P_leg of a limb
  double limb_radius = 0.5;       // (3): most mean D of a limb, as a share of the mean D of all candidates
  double separation_px = 2;       // joints closer than this are moved apart, grid px
};

struct SkeletonTemplate {
  std::string name;
  std::vector<TemplateJoint> joints;  // parents before children, joint 0 is the root
  int head = -1, body = -1;           // the two joints that Algorithm 2 looks for first
  std::vector<TemplateLimb> limbs;
  RecognitionRules rules;
  bool from_side = false;  // such figures are drawn from the side: their two sides look alike
  double length_m = 0;     // of a model's longer side, up or across; 0: models are 1.7 m high

  int find(std::string_view joint) const;  // -1 if there is none
  // Of the limbs that are mirror images of each other, each pair once, the one that is named first before.
  std::vector<std::array<int, 2>> limbPairs() const;
};

// Whether the limb stands on the ground: an animal's front leg is one, too.
bool isLeg(const SkeletonTemplate& body_plan, const TemplateLimb& limb);

// A template of this name that skel brings along, or the file of this path. Throws InputError.
SkeletonTemplate loadTemplate(const std::string& name_or_path);
SkeletonTemplate parseTemplate(std::string_view text, const std::string& file);
// The names that loadTemplate() knows.
std::vector<std::string> builtinTemplates();

// A skeleton with the template's joints at their presets in the box from `low` to `high` (image px), all
// completed.
Skeleton presetSkeleton(const SkeletonTemplate& body_plan, const Eigen::Vector2d& low,
                        const Eigen::Vector2d& high);

}  // namespace skel
