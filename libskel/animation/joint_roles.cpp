#include "libskel/animation/joint_roles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

#include "libskel/core/text.h"

namespace skel {
namespace {

using Eigen::Vector3d;

enum class Side { kNone, kLeft, kRight };

// "mixamorig:LeftForeArm", "forearm.L", "J_Bip_L_LowerArm" …: the side, and the rest in lower case.
struct PlainName {
  Side side = Side::kNone;
  std::string base;
};

// At what is no letter, and before capitals: "LHipJoint" is l, hip, joint.
std::vector<std::string> wordsOf(std::string_view name) {
  std::vector<std::string> words(1);
  const auto upper = [&](std::size_t i) {
    return i < name.size() && std::isupper(static_cast<unsigned char>(name[i]));
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    if (!std::isalpha(c)) {
      words.emplace_back();
      continue;
    }
    const bool after_lower = i > 0 && std::islower(static_cast<unsigned char>(name[i - 1]));
    const bool before_lower = i + 1 < name.size() && std::islower(static_cast<unsigned char>(name[i + 1]));
    if (upper(i) && (after_lower || (upper(i - 1) && i > 0 && before_lower))) words.emplace_back();
    words.back() += char(std::tolower(c));
  }
  std::erase(words, "");
  return words;
}

PlainName plainName(std::string_view name) {
  // What stands before a colon is the rig's name.
  name.remove_prefix(name.rfind(':') + 1);
  PlainName plain;
  for (const std::string& word : wordsOf(name)) {
    if (word == "left" || word == "l")
      plain.side = Side::kLeft;
    else if (word == "right" || word == "r")
      plain.side = Side::kRight;
    else if (word != "mixamorig" && word != "def" && word != "org" && word != "j" && word != "bip" &&
             word != "c" && word != "bone" && word != "joint" && word != "jnt")
      plain.base += word;
  }
  return plain;
}

// In the order of trust: "shoulder" is the collar bone where there is an "arm" too, "leg" the shin where
// there is an "upleg".
const std::initializer_list<std::string_view> kArm[3] = {{"upperarm", "uparm", "arm", "shldr", "shoulder"},
                                                         {"forearm", "lowerarm", "lowarm", "elbow"},
                                                         {"hand", "wrist", "frontfoot"}};
const std::initializer_list<std::string_view> kLeg[3] = {
    {"upleg", "upperleg", "thigh", "hip", "leg"},
    {"lowerleg", "lowleg", "shin", "calf", "knee", "leg"},
    {"foot", "ankle", "hindfoot"}};

struct Tree {
  const Skeleton& skeleton;
  std::vector<Vector3d> tips;
  std::vector<std::vector<int>> children;

  Tree(const Skeleton& of, std::vector<Vector3d> tips_of)
      : skeleton(of), tips(std::move(tips_of)), children(of.joints.size()) {
    for (std::size_t j = 0; j < of.joints.size(); ++j)
      if (of.joints[j].parent >= 0) children[std::size_t(of.joints[j].parent)].push_back(int(j));
  }
  const Vector3d& at(int joint) const { return skeleton.joints[std::size_t(joint)].position; }
  int parent(int joint) const { return skeleton.joints[std::size_t(joint)].parent; }

  bool isAbove(int ancestor, int joint) const {
    while (joint >= 0 && joint != ancestor) joint = parent(joint);
    return joint >= 0;
  }
  int commonAncestor(int a, int b) const {
    while (a >= 0 && !isAbove(a, b)) a = parent(a);
    return a;
  }
  // From the joint down to `joint`, both with it.
  std::vector<int> path(int from, int to) const {
    std::vector<int> joints;
    for (; to >= 0; to = parent(to)) {
      joints.push_back(to);
      if (to == from) break;
    }
    std::reverse(joints.begin(), joints.end());
    return joints;
  }
  int size(int joint) const {
    int count = 1;
    for (const int child : children[std::size_t(joint)]) count += size(child);
    return count;
  }
  // The longest way down.
  std::vector<int> longest(int joint, double* length = nullptr) const {
    std::vector<int> best;
    double best_length = std::size_t(joint) < tips.size() ? tips[std::size_t(joint)].norm() : 0;
    for (const int child : children[std::size_t(joint)]) {
      double below = 0;
      std::vector<int> way = longest(child, &below);
      below += (at(child) - at(joint)).norm();
      if (below > best_length || best.empty())
        best = std::move(way), best_length = std::max(best_length, below);
    }
    best.insert(best.begin(), joint);
    if (length) *length = best_length;
    return best;
  }
};

// The limb's three joints, each above the next. Empty if the names do not tell.
std::vector<int> limbByNames(const Tree& tree, const std::vector<PlainName>& names,
                             const std::initializer_list<std::string_view> (&wanted)[3], Side side) {
  std::vector<int> limb;
  // A joint at its parent's place begins no limb ("LHipJoint" above "LeftHip"), if another can.
  const auto begins = [&](int joint) {
    return tree.parent(joint) < 0 || (tree.at(joint) - tree.at(tree.parent(joint))).norm() > 1e-9;
  };
  // From the end inwards: hand and foot are called so by everyone.
  for (int part = 2; part >= 0; --part) {
    int found = -1;
    for (const std::string_view name : wanted[part]) {
      for (int j = 0; j < int(names.size()); ++j) {
        if (names[std::size_t(j)].side != side || names[std::size_t(j)].base != name ||
            (!limb.empty() && (j == limb.front() || !tree.isAbove(j, limb.front()))))
          continue;
        if (found < 0 || (!begins(found) && begins(j))) found = j;
      }
      if (found >= 0) break;
    }
    if (found < 0) return {};
    limb.insert(limb.begin(), found);
  }
  return limb;
}

// Two neighbouring bones of the way down, both as long as can be.
std::vector<int> limbByShape(const std::vector<int>& way, const Tree& tree) {
  std::vector<int> best;
  double best_length = 0;
  for (std::size_t i = 0; i + 2 < way.size(); ++i) {
    const double length = std::min((tree.at(way[i + 1]) - tree.at(way[i])).norm(),
                                   (tree.at(way[i + 2]) - tree.at(way[i + 1])).norm());
    if (length > best_length) best = {way[i], way[i + 1], way[i + 2]}, best_length = length;
  }
  return best;
}

// The two of `branches` whose ways down are most equally long; {-1, -1}: there are not two.
std::pair<int, int> mostEqual(const Tree& tree, const std::vector<int>& branches) {
  std::pair<int, int> best(-1, -1);
  double best_difference = 1e300;
  for (std::size_t a = 0; a < branches.size(); ++a)
    for (std::size_t b = a + 1; b < branches.size(); ++b) {
      double la = 0, lb = 0;
      tree.longest(branches[a], &la);
      tree.longest(branches[b], &lb);
      const double difference = std::abs(la - lb) / std::max(1e-9, la + lb);
      if (difference < best_difference) best = {branches[a], branches[b]}, best_difference = difference;
    }
  return best;
}

// The first joint from `joint` on, going where most joints are, with so many children.
int forkBelow(const Tree& tree, int joint, std::size_t branches) {
  while (tree.children[std::size_t(joint)].size() < branches) {
    const auto& below = tree.children[std::size_t(joint)];
    if (below.empty()) return -1;
    joint = *std::max_element(below.begin(), below.end(),
                              [&](int a, int b) { return tree.size(a) < tree.size(b); });
  }
  return joint;
}

struct Limbs {
  std::vector<int> left_arm, right_arm, left_leg, right_leg;
  bool complete() const {
    return !left_arm.empty() && !right_arm.empty() && !left_leg.empty() && !right_leg.empty();
  }
};

Limbs limbsByNames(const Tree& tree) {
  std::vector<PlainName> names;
  for (const Joint& joint : tree.skeleton.joints) names.push_back(plainName(joint.name));
  return {limbByNames(tree, names, kArm, Side::kLeft), limbByNames(tree, names, kArm, Side::kRight),
          limbByNames(tree, names, kLeg, Side::kLeft), limbByNames(tree, names, kLeg, Side::kRight)};
}

Limbs limbsByShape(const Tree& tree) {
  const int hips = forkBelow(tree, 0, 3);
  if (hips < 0) return {};
  std::vector<int> branches = tree.children[std::size_t(hips)];
  const auto trunk = std::max_element(branches.begin(), branches.end(),
                                      [&](int a, int b) { return tree.size(a) < tree.size(b); });
  const int chest = forkBelow(tree, *trunk, 3);
  branches.erase(trunk);
  if (chest < 0) return {};
  const auto [leg_a, leg_b] = mostEqual(tree, branches);
  const auto [arm_a, arm_b] = mostEqual(tree, tree.children[std::size_t(chest)]);
  if (leg_a < 0 || arm_a < 0) return {};
  Limbs limbs{limbByShape(tree.longest(arm_a), tree), limbByShape(tree.longest(arm_b), tree),
              limbByShape(tree.longest(leg_a), tree), limbByShape(tree.longest(leg_b), tree)};
  if (!limbs.complete()) return {};
  // Left is where it is for one who looks along his feet, and else along z, or against y where z is up.
  const Vector3d up = tree.at(chest) - tree.at(hips);
  Vector3d forwards = Vector3d::Zero();
  for (const std::vector<int>* leg : {&limbs.left_leg, &limbs.right_leg}) {
    const std::size_t foot = std::size_t(leg->back());
    if (!tree.children[foot].empty())
      forwards += tree.at(tree.children[foot].front()) - tree.at(int(foot));
    else if (foot < tree.tips.size())
      forwards += tree.tips[foot];
  }
  forwards -= forwards.dot(up) / std::max(1e-12, up.squaredNorm()) * up;
  if (!(forwards.norm() > 0.02 * up.norm()))
    forwards = std::abs(up.z()) > std::abs(up.y()) ? Vector3d(0, -1, 0) : Vector3d(0, 0, 1);
  const Vector3d left = up.cross(forwards);
  const auto order = [&](std::vector<int>& a, std::vector<int>& b) {
    if ((tree.at(a[0]) - tree.at(b[0])).dot(left) < 0) std::swap(a, b);
  };
  order(limbs.left_arm, limbs.right_arm);
  order(limbs.left_leg, limbs.right_leg);
  return limbs;
}

// The joint called "head", or where the way up from the chest, past the arms, ends.
int headOf(const Tree& tree, int chest, const Limbs& limbs) {
  for (std::size_t j = 0; j < tree.skeleton.joints.size(); ++j) {
    const PlainName name = plainName(tree.skeleton.joints[j].name);
    if (name.base == "head" && name.side == Side::kNone && tree.isAbove(chest, int(j))) return int(j);
  }
  for (const int child : tree.children[std::size_t(chest)]) {
    if (tree.isAbove(child, limbs.left_arm[0]) || tree.isAbove(child, limbs.right_arm[0])) continue;
    const std::vector<int> way = tree.longest(child);
    return way.back();
  }
  return -1;
}

bool hasWord(const std::string& base, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return base.find(word) != std::string::npos; });
}

bool isCalledNeck(const PlainName& name) { return name.base.starts_with("neck"); }

// Where the four legs end: left front, right front, left hind, right hind; -1: not found.
using FourFeet = std::array<int, 4>;
bool complete(const FourFeet& feet) { return std::count(feet.begin(), feet.end(), -1) == 0; }

std::vector<int> endsNearGround(const Tree& tree) {
  constexpr double kNear = 0.25;  // of the highest joint's height over the lowest
  const auto below = [](const Joint& a, const Joint& b) { return a.position.y() < b.position.y(); };
  const auto [low, high] =
      std::minmax_element(tree.skeleton.joints.begin(), tree.skeleton.joints.end(), below);
  const double limit = low->position.y() + kNear * (high->position.y() - low->position.y());
  std::vector<int> ends;
  for (std::size_t j = 0; j < tree.children.size(); ++j)
    if (tree.children[j].empty() && tree.parent(int(j)) >= 0 && tree.at(int(j)).y() <= limit)
      ends.push_back(int(j));
  return ends;
}

// The first of the joints that say so: a tail on the ground is no leg.
FourFeet feetByNames(const Tree& tree, const std::vector<PlainName>& names, const std::vector<int>& ends) {
  // Once a name, which may be long: many ends may hang on one way.
  std::vector<char> says_front(names.size(), 0), says_hind(names.size(), 0);
  for (std::size_t j = 0; j < names.size(); ++j) {
    const std::string& base = names[j].base;
    says_front[j] = hasWord(base, {"front", "fore", "arm", "hand", "shoulder", "scapula", "wrist"});
    says_hind[j] = hasWord(base, {"hind", "rear", "back", "thigh", "hip", "shin", "leg", "femur", "foot"});
  }
  FourFeet feet = {-1, -1, -1, -1};
  for (const int end : ends) {
    Side side = Side::kNone;
    bool front = false, hind = false;
    for (int joint = end; joint >= 0; joint = tree.parent(joint)) {
      const auto j = std::size_t(joint);
      if (names[j].side == Side::kNone) continue;
      side = names[j].side;
      front |= says_front[j] != 0;
      hind |= says_hind[j] != 0;
    }
    if (side == Side::kNone || !(front || hind)) continue;
    int& foot = feet[std::size_t((front ? 0 : 2) + (side == Side::kRight ? 1 : 0))];
    if (foot < 0) foot = end;
  }
  return feet;
}

// The ends' own longer axis is that of the body; the head is higher than the tail.
FourFeet feetByShape(const Tree& tree, const std::vector<int>& ends) {
  FourFeet feet = {-1, -1, -1, -1};
  if (ends.size() < 4) return feet;
  Vector3d middle = Vector3d::Zero(), spread = Vector3d::Zero();
  for (const int end : ends) middle += tree.at(end) / double(ends.size());
  for (const int end : ends) spread += (tree.at(end) - middle).cwiseAbs();
  int top = 0;
  for (std::size_t j = 0; j < tree.children.size(); ++j)
    if (tree.at(int(j)).y() > tree.at(top).y()) top = int(j);
  Vector3d forwards = spread.x() > spread.z() ? Vector3d::UnitX() : Vector3d::UnitZ();
  if ((tree.at(top) - middle).dot(forwards) < 0) forwards = -forwards;
  const Vector3d left = Vector3d::UnitY().cross(forwards);
  for (const int end : ends) {
    const Vector3d from = tree.at(end) - middle;
    int& foot = feet[std::size_t((from.dot(forwards) > 0 ? 0 : 2) + (from.dot(left) > 0 ? 0 : 1))];
    if (foot < 0) foot = end;
  }
  return feet;
}

// Top, knee and foot of the way down from the trunk; empty if it has less than three joints.
std::vector<int> legOf(const Tree& tree, const std::vector<PlainName>& names, std::vector<int> way,
                       const Vector3d& forwards) {
  const auto base = [&](int joint) -> const std::string& { return names[std::size_t(joint)].base; };
  // What is beyond the foot does not carry.
  while (way.size() > 3 && hasWord(base(way.back()), {"toe", "finger", "digit", "end", "tip", "nub"}))
    way.pop_back();
  // Shoulder blade and hip bone belong to the trunk.
  if (way.size() > 4 || (way.size() == 4 && hasWord(base(way.front()), {"shoulder", "scapula", "clavicle",
                                                                        "collar", "hip", "pelvis"})))
    way.erase(way.begin());
  if (way.size() < 3) return {};
  const Vector3d &top = tree.at(way.front()), &foot = tree.at(way.back());
  const Vector3d line = foot - top;
  int knee = -1;
  double most = -1e300;
  for (std::size_t k = 1; k + 1 < way.size(); ++k) {
    const Vector3d from = tree.at(way[k]) - top;
    const double ahead = (from - from.dot(line) / std::max(1e-12, line.squaredNorm()) * line).dot(forwards);
    if (ahead > most) most = ahead, knee = way[k];
  }
  return {way.front(), knee, way.back()};
}

}  // namespace

std::size_t roleIndex(std::string_view role) {
  return std::size_t(std::find(kJointRoles.begin(), kJointRoles.end(), role) - kJointRoles.begin());
}

int JointRoles::joint(std::string_view role) const { return joints[roleIndex(role)]; }

JointRoles findJointRoles(const Skeleton& skeleton, const std::vector<Vector3d>& tips) {
  JointRoles roles;
  roles.joints.fill(-1);
  if (skeleton.joints.empty()) return roles;
  const Tree tree(skeleton, tips);
  Limbs limbs = limbsByNames(tree);
  if (!limbs.complete()) {
    limbs = limbsByShape(tree);
    roles.by_shape = true;
  }
  if (!limbs.complete()) return roles;
  const auto set = [&](std::string_view role, int joint) { roles.joints[roleIndex(role)] = joint; };
  const auto limb = [&](const std::vector<int>& joints, std::array<std::string_view, 3> names) {
    for (std::size_t k = 0; k < 3; ++k) set(names[k], joints[k]);
  };
  limb(limbs.left_arm, {"left_shoulder", "left_elbow", "left_hand"});
  limb(limbs.right_arm, {"right_shoulder", "right_elbow", "right_hand"});
  limb(limbs.left_leg, {"left_hip", "left_knee", "left_foot"});
  limb(limbs.right_leg, {"right_hip", "right_knee", "right_foot"});

  const int pelvis = tree.commonAncestor(limbs.left_leg[0], limbs.right_leg[0]);
  const int chest = tree.commonAncestor(limbs.left_arm[0], limbs.right_arm[0]);
  set("pelvis", pelvis);
  if (pelvis < 0 || chest < 0 || chest == pelvis || !tree.isAbove(pelvis, chest)) return roles;
  const int head = headOf(tree, chest, limbs);
  set("head", head);
  const std::vector<int> spine = tree.path(pelvis, chest);
  if (spine.size() > 2 || isCalledNeck(plainName(skeleton.joints[std::size_t(chest)].name))) {
    set("neck", chest);  // what carries the arms
    if (spine.size() > 2) set("body", spine[spine.size() / 2]);
  } else {  // the only joint of a spine
    set("body", chest);
    if (const std::vector<int> way = tree.path(chest, head); way.size() > 2) set("neck", way[1]);
  }
  return roles;
}

std::string whyNoRoles(const Skeleton& skeleton) {
  std::vector<PlainName> names;
  for (const Joint& joint : skeleton.joints) names.push_back(plainName(joint.name));
  constexpr std::array<std::string_view, 3> kArmRoles = {"shoulder", "elbow", "hand"},
                                            kLegRoles = {"hip", "knee", "foot"};
  std::vector<std::string> missing;
  std::size_t found = 0;
  const auto look = [&](Side side, const char* prefix,
                        const std::initializer_list<std::string_view>(&wanted)[3],
                        const std::array<std::string_view, 3>& roles) {
    for (std::size_t part = 0; part < 3; ++part) {
      const bool there = std::any_of(names.begin(), names.end(), [&](const PlainName& name) {
        return name.side == side &&
               std::find(wanted[part].begin(), wanted[part].end(), name.base) != wanted[part].end();
      });
      found += there;
      if (!there) missing.push_back(prefix + std::string(roles[part]));
    }
  };
  for (const auto& [side, prefix] : {std::pair(Side::kLeft, "left_"), std::pair(Side::kRight, "right_")}) {
    look(side, prefix, kArm, kArmRoles);
    look(side, prefix, kLeg, kLegRoles);
  }
  if (found == 0) return "neither the names of its joints nor their tree tell arms and legs, or four legs";
  if (missing.empty()) return "its joints do not hang together as arms and legs on a trunk do";
  return "no joint for " + joined(missing) +
         "; an arm or a leg is three joints, the last one at hand or foot";
}

QuadrupedRoles findQuadrupedRoles(const Skeleton& skeleton) {
  QuadrupedRoles roles;
  if (skeleton.joints.empty()) return roles;
  const Tree tree(skeleton, {});
  std::vector<PlainName> names;
  for (const Joint& joint : skeleton.joints) names.push_back(plainName(joint.name));
  const std::vector<int> ends = endsNearGround(tree);
  FourFeet feet = feetByNames(tree, names, ends);
  if (!complete(feet)) {
    feet = feetByShape(tree, ends);
    roles.by_shape = true;
  }
  if (!complete(feet)) return {};

  const int chest = tree.commonAncestor(feet[0], feet[1]), pelvis = tree.commonAncestor(feet[2], feet[3]);
  if (chest < 0 || pelvis < 0 || chest == pelvis || !tree.isAbove(pelvis, chest)) return {};
  Vector3d forwards = tree.at(chest) - tree.at(pelvis);
  const double rise = std::abs(forwards.y());
  forwards.y() = 0;
  if (!(forwards.norm() > rise)) return {};
  forwards.normalize();

  std::vector<RoleJoint> found = {{"pelvis", pelvis}};
  const std::array<std::array<std::string, 3>, 4> leg_roles = {
      {{"left_shoulder", "left_elbow", "left_front_foot"},
       {"right_shoulder", "right_elbow", "right_front_foot"},
       {"left_hip", "left_knee", "left_hind_foot"},
       {"right_hip", "right_knee", "right_hind_foot"}}};
  for (std::size_t k = 0; k < 4; ++k) {
    std::vector<int> way = tree.path(k < 2 ? chest : pelvis, feet[k]);
    way.erase(way.begin());
    const std::vector<int> leg = legOf(tree, names, way, forwards);
    if (leg.empty()) return {};
    for (std::size_t part = 0; part < 3; ++part) found.push_back({leg_roles[k][part], leg[part]});
  }

  const auto named = [&](std::string_view word) {
    for (std::size_t j = 0; j < names.size(); ++j)
      if (names[j].side == Side::kNone && names[j].base.starts_with(word)) return int(j);
    return -1;
  };
  const auto onLegs = [&](int joint) {
    return std::any_of(feet.begin(), feet.end(), [&](int foot) { return tree.isAbove(joint, foot); });
  };
  int head = named("head");
  if (head < 0 || head == chest || !tree.isAbove(chest, head)) {
    head = -1;
    for (const int child : tree.children[std::size_t(chest)])
      if (head < 0 && !onLegs(child)) head = tree.longest(child).back();
  }
  const std::vector<int> spine = tree.path(pelvis, chest);
  int body = spine[spine.size() / 2];
  if (head >= 0) {
    const std::vector<int> way = tree.path(chest, head);
    // What carries the head alone, if there is such a joint: the legs do not nod.
    const int neck = way.size() > 2 ? way[1] : chest;
    // The only joint of a spine is no neck, though it carries the head.
    if (neck == body && isCalledNeck(names[std::size_t(neck)])) body = -1;
    if (neck != body) found.push_back({"neck", neck});
    found.push_back({"head", head});
  }
  if (body >= 0) found.push_back({"body", body});
  int tail = named("tail");
  if (tail < 0)
    for (const int child : tree.children[std::size_t(pelvis)])
      if (!onLegs(child) && (tree.at(tree.longest(child).back()) - tree.at(pelvis)).dot(forwards) < 0)
        tail = child;
  if (tail >= 0 && !onLegs(tail) && tree.isAbove(pelvis, tail)) {
    found.push_back({"tail_root", tail});
    if (const std::vector<int> way = tree.longest(tail); way.size() > 1) found.push_back({"tail", way[1]});
  }
  std::sort(found.begin(), found.end(),
            [](const RoleJoint& a, const RoleJoint& b) { return a.joint < b.joint; });
  roles.joints = std::move(found);
  roles.forwards = forwards;
  return roles;
}

}  // namespace skel
