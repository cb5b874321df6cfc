#include "libskel/animation/retarget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "libskel/animation/arm_abilities.h"
#include "libskel/animation/bone_turn.h"
#include "libskel/animation/check_clip.h"
#include "libskel/animation/clip_limits.h"
#include "libskel/animation/follow_through.h"
#include "libskel/animation/plant_feet.h"
#include "libskel/animation/pose_hash.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/animation/shortest_turn.h"
#include "libskel/animation/thin_keys.h"
#include "libskel/core/error.h"
#include "libskel/core/segment.h"
#include "libskel/core/signed_angle.h"
#include "libskel/core/smooth_step.h"
#include "libskel/skeleton/check_skeleton.h"
#include "libskel/skeleton/hanging.h"
#include "libskel/skeleton/joint_lookup.h"

namespace skel {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kTolerance = 0.0015;  // of thinned keys, in heights
constexpr float kNoise = 1e-9f;
// By eye on eight of the unseen drawings that walk, run and jump.
constexpr double kWaddle_rad = 5;    // for each height that the clip sways, of one who takes no steps
constexpr double kLeastLift = 0.12;  // of a step, in heights
constexpr double kAsDrawn = 0.6;     // FootPlanting::as_drawn of feet that come towards the viewer
constexpr double kShortSquat = 0.6;  // so much less deep squat legs that are one piece

// Moments of the clip on the drawn skeleton.
struct Retargeter {
  const Skeleton& skeleton;
  std::vector<bool> pointed;            // joints whose bone follows the canonical one
  std::vector<bool> upright;            // those of them that are the trunk's, which may lean some way
  std::vector<BoneTurn> turns;          // canonical to drawn
  std::vector<double> swing;            // extra turn about z of a pointed joint and those below it, radians
  std::vector<Vector3d> raised;         // a bone whose swing grows as it points up; zero: swings always
  std::vector<double> share_of_motion;  // 1: as the clip says, 0: the joint does not turn, 2: twice as far
  Quaterniond figure_from_clip = Quaterniond::Identity();  // about the vertical
  std::vector<Vector3d> bones;                             // of pointed joints, canonical
  std::vector<Vector3d> ahead, behind;  // what is added for each unit that it points at the viewer, or away
  std::vector<Quaterniond> undone;      // the whole `turns`, back

  // How each joint turns from its parent, and from the canonical figure.
  struct Motion {
    std::vector<Quaterniond> locals, globals;
  };
  Motion motionOf(const Pose& canonical) const {
    const std::size_t count = skeleton.joints.size();
    Motion motion{std::vector<Quaterniond>(count), std::vector<Quaterniond>(count)};
    for (std::size_t j = 0; j < count; ++j) {
      const int parent = skeleton.joints[j].parent;
      Quaterniond& local = motion.locals[j] = canonical.rotations[j].cast<double>();
      if (share_of_motion[j] != 1) local = Quaterniond::Identity().slerp(share_of_motion[j], local);
      if (figure_from_clip.w() != 1) local = figure_from_clip * local * figure_from_clip.conjugate();
      motion.globals[j] = parent < 0 ? local : motion.globals[parent] * local;
    }
    return motion;
  }

  // The joint's rotation to the model frame; `globals`: its parent's.
  Quaterniond global(const Motion& motion, double share, std::size_t joint,
                     const std::vector<Quaterniond>& globals) const {
    if (!pointed[joint]) {
      const int parent = skeleton.joints[joint].parent;
      return parent < 0 ? motion.locals[joint] : globals[std::size_t(parent)] * motion.locals[joint];
    }
    const double swung = swungAt(motion, int(joint));
    const Quaterniond turn =
        swung == 0 ? motion.globals[joint] : aboutZ(swung * share) * motion.globals[joint];
    const Vector3d bone = turn * bones[joint];
    const Vector3d seen =
        upright[joint] ? bone : Vector3d(bone + share * bone.z() * (bone.z() > 0 ? ahead : behind)[joint]);
    return shortestTurn(bone, seen) * turn *
           (share == 1 ? undone[joint] : turns[joint].share(share).conjugate());
  }
  std::vector<Quaterniond> globals(const Motion& motion, double share) const {
    std::vector<Quaterniond> result(skeleton.joints.size());
    for (std::size_t j = 0; j < result.size(); ++j) result[j] = global(motion, share, j, result);
    return result;
  }

 private:
  double swungAt(const Motion& motion, int joint) const {
    double swung = 0;
    for (; joint >= 0; joint = skeleton.joints[joint].parent)
      if (swing[joint] != 0)
        swung +=
            swing[joint] *
            (raised[joint].isZero() ? 1 : smoothStep(-0.2, 0.6, (motion.globals[joint] * raised[joint]).y()));
    return swung;
  }
};

std::vector<Vector3d> positions(const Skeleton& skeleton, const std::vector<Quaterniond>& globals) {
  return jointPositions(skeleton, {0, globals, Vector3d::Zero(), 1});
}

void checkAsked(const Clip& clip, const Skeleton& skeleton, const RetargetOptions& options) {
  checkClip(clip);
  checkSkeleton(skeleton, "the skeleton of the clip \"" + clip.name + "\"");
  if (!(options.rate_hz > 0) || !std::isfinite(options.rate_hz))
    throw UsageError("RetargetOptions::rate_hz must be a finite number of more than 0");
  if (!(options.into_picture >= 0 && options.into_picture <= 1))
    throw UsageError("RetargetOptions::into_picture must be from 0 to 1");
}

// What the clip puts on the ground must end a limb of two bones.
void checkContacts(const Clip& clip, const Skeleton& skeleton) {
  for (const FootContact& contact : clip.contacts) {
    const int foot = skeleton.find(contact.joint);
    const int knee = foot < 0 ? -1 : skeleton.joints[foot].parent;
    if (knee < 0 || skeleton.joints[knee].parent < 0)
      throw Error(ExitCode::kInput, "the clip \"" + clip.name + "\" puts \"" + contact.joint +
                                        "\" on the ground, which " +
                                        (foot < 0 ? "this skeleton lacks" : "ends no limb of two bones"));
  }
}

// How far the line from the root to the neck leans to the left of the vertical, rad, and by how much less
// than straight the hips are, those of the straighter leg. Nothing of what has no neck or legs.
struct Stance {
  double lean_rad = 0, bent_rad = 0;
};
Stance stanceOf(const Skeleton& skeleton) {
  const int neck = skeleton.find("neck");
  if (neck < 0) return {};
  const auto between = [&](int from, int to) -> Vector2d {
    return (skeleton.joints[to].position - skeleton.joints[from].position).head<2>();
  };
  const Vector2d trunk = between(0, neck);
  Stance stance{signedAngle(Vector2d::UnitY(), trunk), kPi};
  for (const std::string side : {"left_", "right_"})
    if (const int hip = skeleton.find(side + "hip"), knee = skeleton.find(side + "knee");
        hip >= 0 && knee >= 0)
      stance.bent_rad = std::min(stance.bent_rad, std::abs(signedAngle(-trunk, between(hip, knee))));
  return stance;
}

// Who stands on his hands comes down for clips, too, that leave others lying as they are drawn.
void comeDown(const Skeleton& skeleton, Clip& clip) {
  constexpr double kUpsideDown_rad = 0.75 * kPi;
  if (skeleton.template_name != "biped" || std::abs(stanceOf(skeleton).lean_rad) < kUpsideDown_rad) return;
  for (const std::string_view trunk : kTrunkJoints) {
    const std::string name(trunk);
    if (skeleton.find(name) < 0) continue;
    auto track = std::find_if(clip.tracks.begin(), clip.tracks.end(),
                              [&](const JointTrack& one) { return one.joint == name; });
    if (track == clip.tracks.end()) {
      clip.tracks.emplace_back().joint = name;
      track = clip.tracks.end() - 1;
    }
    if (!track->bone.isZero()) continue;
    track->bone = Eigen::Vector3f::UnitY();
    track->slack_rad = kTrunkSlack_rad;
    if (track->times_s.empty()) track->times_s = {0}, track->rotations = {Eigen::Quaternionf::Identity()};
  }
}

// Of a lean, what is taken back: nothing within the slack, and the more the farther it goes beyond, so that
// who lies stands up.
double straightened(double lean_rad, double slack_rad) {
  constexpr double kLies = 3;  // times the slack
  const double lean = std::abs(lean_rad) / slack_rad;
  const double kept = std::min({1., lean, std::max(0., (kLies - lean) / (kLies - 1))});
  return lean <= 1 ? 0 : lean_rad - std::copysign(kept * slack_rad, lean_rad);
}

// How far the trunk is turned to stand upright, against that. One who is bent at the hips by more than a
// right angle, crouching or folded, stays as he was drawn: straightened he would only tear.
double trunkTurn(const Skeleton& skeleton, const std::vector<bool>& upright,
                 const std::vector<double>& slack_rad) {
  const Stance stance = stanceOf(skeleton);
  return upright[0] && stance.bent_rad <= kPi / 2 ? straightened(stance.lean_rad, slack_rad[0]) : 0;
}

// The trunk turns as one piece, the head by itself, if the trunk does.
void standUp(const Skeleton& skeleton, const std::vector<double>& slack_rad, const std::vector<bool>& upright,
             double trunk_turn_rad, std::vector<BoneTurn>& turns) {
  std::vector<bool> of_trunk(turns.size(), false);
  for (int j = skeleton.find("neck"); j >= 0; j = skeleton.joints[j].parent)
    of_trunk[j] = skeleton.joints[j].name != "neck";
  for (std::size_t j = 0; j < turns.size(); ++j) {
    if (!upright[j]) continue;
    const bool alone = trunk_turn_rad != 0 && !of_trunk[j];
    turns[j].angle_rad = alone ? straightened(turns[j].angle_rad, slack_rad[j]) : trunk_turn_rad;
    if (!alone) turns[j].out_of_plane.setIdentity();
  }
}

// Of each joint of a limb, how far what it was drawn against turns: the trunk, of limbs that were drawn along
// it rather than as they hang, so that who stands on his hands has his legs below him and not crossed.
std::vector<double> turnsOfGround(const Skeleton& skeleton, const std::vector<Vector3d>& canonical,
                                  double trunk_turn_rad) {
  std::vector<double> ground(skeleton.joints.size(), 0);
  if (trunk_turn_rad == 0) return ground;
  const std::vector<Vector3d> bones = restBones(skeleton);
  for (std::size_t j = 0; j < ground.size(); ++j) {
    if (canonical[j].isZero() || pointsUp(canonical[j])) continue;
    const int parent = skeleton.joints[j].parent;
    if (parent >= 0 && !canonical[parent].isZero() && !pointsUp(canonical[parent]))
      ground[j] = ground[parent];
    else if (const double turn_rad = boneTurn(canonical[j], bones[j], 0).angle_rad;
             std::abs(std::remainder(turn_rad - trunk_turn_rad, 2 * kPi)) < std::abs(turn_rad))
      ground[j] = trunk_turn_rad;
  }
  return ground;
}

// Lets bones stay where they were drawn as far as `slack` and the trunk allow: the rest of the turn remains.
void giveSlack(const Skeleton& skeleton, const std::vector<double>& slack_rad,
               const std::vector<double>& hang_rad, const std::vector<bool>& upright,
               const std::vector<double>& ground_rad, std::vector<BoneTurn>& turns) {
  for (std::size_t j = 0; j < turns.size(); ++j) {
    if (slack_rad[j] <= 0 || upright[j]) continue;
    const double side = outwards(skeleton, int(j), ground_rad[j]);
    const double most = std::max(slack_rad[j], hang_rad.empty() ? 0 : hang_rad[j]);
    const double drawn = side * (turns[j].angle_rad - ground_rad[j]),
                 kept = std::clamp(drawn, -slack_rad[j], most);
    turns[j].angle_rad = side * (drawn - kept) + ground_rad[j];
    if (drawn == kept) turns[j].out_of_plane.setIdentity();
  }
}

// Lets the joints keep the share `kept` of how they were drawn, and move so much less.
void hold(Retargeter& retargeter, std::initializer_list<int> joints, double kept,
          std::vector<double>& slack_rad) {
  for (const int joint : joints) {
    if (slack_rad[joint] <= 0) continue;
    slack_rad[joint] += kept * 2 * kPi;
    retargeter.share_of_motion[joint] = heldShare(kept);
  }
}

void holdArms(Retargeter& retargeter, const FigureShape& shape, std::vector<double>& slack_rad) {
  const Skeleton& skeleton = retargeter.skeleton;
  for (const std::string side : {"left_", "right_"})
    if (const double kept = keptArm(skeleton, shape, side); kept > 0)
      hold(retargeter,
           {skeleton.index(side + "shoulder"), skeleton.index(side + "elbow"), skeleton.index(side + "hand")},
           kept, slack_rad);
}

// Who can speak with neither arm, as holdArms() has it, does so with the trunk: what that does of a gesture
// grows, but no lean beyond kFarthest_rad.
void gestureWithoutArms(Retargeter& retargeter, const Clip& clip) {
  constexpr double kFarthest_rad = 20 * kPi / 180;
  constexpr double kGesture_rad = 6;  // of both arms together; steps are none, nor is breath
  const Skeleton& skeleton = retargeter.skeleton;
  double more = 1;
  for (const char* name : {"left_elbow", "right_elbow"}) {
    const int elbow = skeleton.find(name);
    more = std::min(more, elbow < 0 ? 0 : 1 - retargeter.share_of_motion[elbow]);
  }
  if (more <= 0) return;
  const double arms = armTravel(clip, "left_") + armTravel(clip, "right_"),
               legs = travelOf(clip, {"left_hip", "right_hip", "left_knee", "right_knee"});
  more = std::min(more, smoothStep(0.5, 0.8, arms / std::max(kGesture_rad, arms + legs)));
  for (const JointTrack& track : clip.tracks) {
    if (track.joint != "body") continue;
    double farthest = 0;
    for (const Eigen::Quaternionf& rotation : track.rotations)
      farthest = std::max(farthest, double(Eigen::AngleAxisf(rotation).angle()));
    if (const int joint = skeleton.find(track.joint); joint >= 0 && farthest > 0)
      retargeter.share_of_motion[joint] = 1 + std::clamp(kFarthest_rad / farthest - 1, 0., more);
  }
}

// Legs that are one piece, under a gown, take small steps, and those of one who sits none.
double holdLegs(Retargeter& retargeter, const FigureShape& shape, const std::vector<FootContact>& contacts,
                std::vector<double>& slack_rad) {
  const Skeleton& skeleton = retargeter.skeleton;
  const bool seated = isSeated(skeleton, shape);
  double least = 1;
  for (const FootContact& contact : contacts) {
    const int foot = skeleton.index(contact.joint), knee = skeleton.joints[foot].parent,
              hip = skeleton.joints[knee].parent;
    if (retargeter.share_of_motion[foot] < 1) continue;
    const double steps = seated ? 0.15 : 1 - 0.55 * smoothStep(0.6, 1, joinedAt(shape, foot));
    if (seated) hold(retargeter, {hip, knee, foot}, 1, slack_rad);
    for (const int joint : {hip, knee, foot}) retargeter.share_of_motion[joint] = steps;
    least = std::min(least, steps);
  }
  return least;
}

// What is added to a direction for each unit that it points at the viewer. All to one side, as if the limbs
// were seen aslant: so steps stay steps.
Vector3d wayAslant(const FigureShape& shape, double share) {
  share *= std::abs(shape.looks * std::cos(shape.yaw_rad));
  return {shape.looks * share, 0, -share};
}

// The same to the right of the picture, by a turn about the vertical: so the bone keeps its height.
Vector3d wayTurned(double share) {
  const double angle_rad = share * kPi / 2;
  return {std::sin(angle_rad), 0, std::cos(angle_rad) - 1};
}

// One who comes towards the viewer, by his own legs: knees turn out and let shins hang, hands swing across
// the belly and out behind, as in drawn animation. One whose steps went aslant would walk sideways like a
// crab.
bool comesTowardsViewer(const FigureShape& shape, const Clip& clip, const RetargetOptions& options) {
  return clip.frame == ClipFrame::kBody && shape.looks != 0 && shape.yaw_rad == 0 && !options.aslant;
}

struct ClipMoment {
  Retargeter::Motion motion;
  Vector3d root_translation;  // in heights
  double share;               // of the drawn pose that is taken back
};
using ClipMoments = std::vector<ClipMoment>;

// Whether bones, all arms' or all legs', rather move towards the viewer than in the picture: 0…1. As H. J.
// Smith et al., "A method for animating children's drawings of the human figure" (2023), look at each group
// of limbs from the front or from the side.
double shareAside(const Retargeter& retargeter, const ClipMoments& moments,
                  const std::vector<std::size_t>& joints) {
  constexpr std::size_t kEnough = 100;
  constexpr double kFront = 0.4, kSide = 0.6;  // shares of what moves towards the viewer
  double towards = 0, all = 0;
  for (std::size_t k = 0; k < moments.size(); k += 1 + moments.size() / kEnough) {
    for (const std::size_t j : joints) {
      const Vector3d bone = moments[k].motion.globals[j] * retargeter.bones[j];
      towards += bone.z() * bone.z();
      all += bone.z() * bone.z() + bone.x() * bone.x();
    }
  }
  return all > 0 ? smoothStep(kFront, kSide, towards / all) : 1;
}

// Arms, and legs, that move in the picture stay as they are; the figure goes where its legs take it.
void sparePictured(const ClipMoments& moments, Retargeter& retargeter) {
  for (const auto& [upper, middle] : {std::pair("shoulder", "elbow"), std::pair("hip", "knee")}) {
    std::vector<std::size_t> joints;
    for (const std::string side : {"left_", "right_"})
      for (const char* name : {upper, middle})
        if (const int joint = retargeter.skeleton.find(side + name); joint >= 0)
          joints.push_back(std::size_t(joint));
    const double share = shareAside(retargeter, moments, joints);
    if (upper == std::string("hip")) joints.push_back(0);
    for (const std::size_t j : joints) retargeter.ahead[j] *= share;
  }
}

void turnIntoPicture(const FigureShape& shape, const Clip& clip, const RetargetOptions& options,
                     const ClipMoments& moments, Retargeter& retargeter) {
  const Skeleton& skeleton = retargeter.skeleton;
  const bool turns = skeleton.find("left_front_foot") < 0 && options.into_picture > 0;
  const bool aslant = turns && !comesTowardsViewer(shape, clip, options);
  const Vector3d way = aslant ? wayAslant(shape, options.into_picture) : Vector3d::Zero();
  retargeter.ahead.assign(skeleton.joints.size(), way);
  if (aslant && options.aslant) sparePictured(moments, retargeter);
  retargeter.behind = retargeter.ahead;
  if (!turns || aslant) return;
  // Which way, and how far: by eye on eight of the unseen drawings.
  struct Limb {
    std::array<const char*, 3> joints;
    double ahead, behind;  // of what is asked for; outwards
  };
  for (const Limb& limb :
       {Limb{{"hip", "knee", "foot"}, 1, 0.2}, Limb{{"shoulder", "elbow", "hand"}, -0.5, -1}})
    for (const std::string side : {"left_", "right_"})
      for (const char* name : limb.joints) {
        const int joint = skeleton.find(side + name);
        if (joint < 0) continue;
        const double out = side == "left_" ? options.into_picture : -options.into_picture;
        retargeter.ahead[std::size_t(joint)] = wayTurned(out * limb.ahead);
        retargeter.behind[std::size_t(joint)] = wayTurned(out * limb.behind);
      }
}

// How long the legs are that the clip puts on the ground, m.
double legLength(const Skeleton& skeleton, const std::vector<FootContact>& contacts) {
  double sum = 0;
  for (const FootContact& contact : contacts) {
    const int foot = skeleton.index(contact.joint), knee = skeleton.joints[foot].parent,
              hip = skeleton.joints[knee].parent;
    const auto at = [&](int joint) -> const Vector3d& { return skeleton.joints[joint].position; };
    sum += (at(foot) - at(knee)).norm() + (at(knee) - at(hip)).norm();
  }
  return sum / double(contacts.size());
}

// How the feet stand that the clip puts on the ground.
FootPlanting footPlanting(const Retargeter& retargeter, const Clip& clip, const FigureShape& shape) {
  const Skeleton& skeleton = retargeter.skeleton;
  const std::size_t count = skeleton.joints.size();
  FootPlanting planting;
  planting.standing_y_m.assign(count, 0);
  planting.standing_turn.assign(count, Quaterniond::Identity());
  const Vector3d forwards = retargeter.figure_from_clip *
                            (clip.template_name == "quadruped" ? Vector3d(-1, 0, 0) : Vector3d(0, 0, 1));
  for (const Vector3d& way : retargeter.ahead) planting.forwards.push_back(forwards + forwards.z() * way);
  const auto drawnAt = [&](int joint) { return skeleton.joints[joint].position.y(); };
  double ground = 1e9;
  for (const FootContact& contact : clip.contacts) {
    const int foot = skeleton.index(contact.joint);
    ground = std::min(ground, drawnAt(foot) + soleBelow(shape, foot, Quaterniond::Identity()));
  }
  // Who is stood up, with feet about as high as the hips, stands on what he lay on.
  constexpr double kStands = 0.4;  // of the legs, below the pelvis
  const bool lay = retargeter.upright[0] && retargeter.turns[0].angle_rad != 0 &&
                   drawnAt(0) - ground < kStands * legLength(skeleton, clip.contacts);
  if (lay) ground = 0;
  for (const FootContact& contact : clip.contacts) {
    const int foot = skeleton.index(contact.joint), knee = skeleton.joints[foot].parent;
    // One that was drawn in the air comes down, if the clip has a say in how the leg is held.
    double sole_y = drawnAt(foot) + soleBelow(shape, foot, Quaterniond::Identity());
    if (const int turned = retargeter.pointed[foot] ? foot : knee; retargeter.pointed[turned]) {
      planting.standing_turn[foot] = retargeter.turns[turned].share(1).conjugate();
      if (lay || sole_y > ground + 0.06 * shape.height_m) sole_y = ground;
    }
    planting.standing_y_m[foot] = sole_y - soleBelow(shape, foot, planting.standing_turn[foot]);
  }
  constexpr double kLeast = 0.02;  // of the pelvis' height
  planting.sinks_m = lay ? drawnAt(0) : kLeast * std::max(0.0, drawnAt(0) - ground);
  return planting;
}

// How much higher than drawn the root stands when the legs are as the clips' figure holds them: as high as
// the leg of least reach lets it. A leg that was drawn much shorter than the other does not pull it down: it
// hangs.
double standing(const Skeleton& skeleton, const std::vector<Vector3d>& still,
                const std::vector<FootContact>& contacts, FootPlanting& planting) {
  double stand = 1e9;
  for (const FootContact& contact : contacts) {
    const int foot = skeleton.index(contact.joint);
    stand = std::min(stand, planting.standing_y_m[foot] - still[foot].y());
  }
  stand = std::max(stand, -planting.sinks_m);
  for (const FootContact& contact : contacts) {
    const int foot = skeleton.index(contact.joint);
    planting.standing_y_m[foot] = std::max(planting.standing_y_m[foot], still[foot].y() + stand);
  }
  return stand;
}

// How long the legs are, in those of the figure that the clips were made for.
double legShare(const Skeleton& skeleton, const std::vector<FootContact>& contacts, double height_m) {
  constexpr double kOfHeight = 0.45;
  return std::min(1.3, legLength(skeleton, contacts) / (kOfHeight * height_m));
}

// Seen from the front, the least turn of the joint's bone away from the trunk that keeps the part from `from`
// to `to` of the bone from there to `end`, in its lengths, off the head at all `moments`.
struct Clearing {
  int turned, end;
  double from, to;
};
double clearingSwing(Retargeter& retargeter, const ClipMoments& moments, const Clearing& part,
                     double head_half_width_m) {
  const Skeleton& skeleton = retargeter.skeleton;
  const int head = skeleton.find("head"), top = skeleton.find("head_top");
  if (head < 0 || top < 0) return 0;
  const double radius =
      std::max(head_half_width_m, (skeleton.joints[top].position - skeleton.joints[head].position).norm());
  const double away = skeleton.joints[part.turned].position.x() < skeleton.joints[head].position.x() ? 1 : -1;
  constexpr double kStep = kPi / 36;
  constexpr int kSteps = 15;  // no further than 75°
  constexpr std::size_t kEvery = 3;
  // The joints that carry the head or the end, parents first, and those of them that the turn moves.
  std::vector<bool> carries(skeleton.joints.size(), false), swings = carries;
  for (const int last : {head, part.end})
    for (int j = skeleton.joints[last].parent; j >= 0; j = skeleton.joints[j].parent) carries[j] = true;
  for (std::size_t j = std::size_t(part.turned); j < carries.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    swings[j] = carries[j] && (int(j) == part.turned || (parent >= 0 && swings[std::size_t(parent)]));
  }
  std::vector<ModelPose> poses(moments.size());
  double best_swing = 0, best_clearance = -1e9;
  for (int step = 0; step <= kSteps; ++step) {
    retargeter.swing[part.turned] = away * step * kStep;
    double clearance = 1e9;
    for (std::size_t k = 0; k < moments.size(); k += kEvery) {
      const auto& [motion, root, share] = moments[k];
      if (share < 1) continue;
      ModelPose& at = poses[k];
      at.globals.resize(carries.size());
      for (std::size_t j = 0; j < carries.size(); ++j)
        if (step == 0 ? carries[j] : swings[j])
          at.globals[j] = retargeter.global(motion, share, j, at.globals);
      const Vector2d begin = jointPosition(skeleton, at, part.turned).head<2>(),
                     along = jointPosition(skeleton, at, part.end).head<2>() - begin;
      clearance = std::min(clearance,
                           distanceToSegment<Vector2d>(jointPosition(skeleton, at, head).head<2>(),
                                                       begin + part.from * along, begin + part.to * along) -
                               1.1 * radius);
    }
    if (clearance > best_clearance) best_clearance = clearance, best_swing = retargeter.swing[part.turned];
    if (clearance >= 0) break;
  }
  return best_swing;
}

// Raised arms go past the head: first the elbow, then the forearm with the hand's tip.
void swingClearOfHead(Retargeter& retargeter, const ClipMoments& moments,
                      const std::vector<Vector3d>& canonical, double head_half_width_m) {
  const Skeleton& skeleton = retargeter.skeleton;
  for (const std::string side : {"left_", "right_"}) {
    const int shoulder = skeleton.find(side + "shoulder"), elbow = skeleton.find(side + "elbow"),
              hand = skeleton.find(side + "hand");
    if (shoulder < 0 || elbow < 0 || hand < 0) continue;
    if (retargeter.pointed[shoulder]) {
      retargeter.raised[shoulder] = canonical[shoulder];
      retargeter.swing[shoulder] =
          clearingSwing(retargeter, moments, {shoulder, elbow, 1, 1}, head_half_width_m);
    }
    if (retargeter.pointed[elbow])
      retargeter.swing[elbow] = clearingSwing(retargeter, moments, {elbow, hand, 0, 1.35}, head_half_width_m);
  }
}

}  // namespace

Clip retargetToRest(const Clip& asked, const Skeleton& skeleton, const RetargetOptions& options) {
  const std::size_t count = skeleton.joints.size();
  checkAsked(asked, skeleton, options);
  checkContacts(asked, skeleton);
  if (isRelativeTo(asked, skeleton)) {
    Clip as_it_is = asked;
    as_it_is.rest_pose.clear();
    return as_it_is;
  }
  const FigureShape shape = options.shape ? *options.shape : shapeOfBones(skeleton);
  Clip clip = asItCan(asked, skeleton, shape);
  if (!clip.contacts.empty()) comeDown(skeleton, clip);
  // Of what hangs on another figure.
  std::erase_if(clip.tracks, [&](const JointTrack& track) {
    return isHangingName(track.joint) && skeleton.find(track.joint) < 0;
  });
  Quaterniond figure_from_clip = Quaterniond::Identity();
  if (clip.frame == ClipFrame::kBody && shape.yaw_rad != 0)
    figure_from_clip = Quaterniond(Eigen::AngleAxisd(shape.yaw_rad, Vector3d::UnitY()));
  std::vector<Vector3d> canonical(count, Vector3d::Zero());
  std::vector<double> slack_rad(count, 0);
  for (const JointTrack& track : clip.tracks)
    if (const int joint = skeleton.find(track.joint); joint >= 0) {
      canonical[joint] = figure_from_clip * track.bone.cast<double>();
      slack_rad[joint] = track.slack_rad;
    }

  Retargeter retargeter{skeleton,
                        std::vector<bool>(count),
                        std::vector<bool>(count),
                        {},
                        std::vector<double>(count, 0),
                        std::vector<Vector3d>(count, Vector3d::Zero()),
                        std::vector<double>(count, 1),
                        figure_from_clip,
                        canonical,
                        {},
                        {},
                        {}};
  for (std::size_t j = 0; j < count; ++j) {
    retargeter.pointed[j] = !canonical[j].isZero();
    retargeter.upright[j] = pointsUp(canonical[j]) && slack_rad[j] > 0;
    // Seen from the side, limbs swing where they could else stay away.
    if (clip.frame == ClipFrame::kBody && !retargeter.upright[j])
      slack_rad[j] *= std::abs(std::cos(shape.yaw_rad));
  }
  holdArms(retargeter, shape, slack_rad);
  gestureWithoutArms(retargeter, clip);
  const double steps = holdLegs(retargeter, shape, clip.contacts, slack_rad);
  const double trunk_turn_rad = trunkTurn(skeleton, retargeter.upright, slack_rad);
  const std::vector<double> ground_rad = turnsOfGround(skeleton, canonical, trunk_turn_rad);
  retargeter.turns = turnsFromCanonical(skeleton, canonical, ground_rad);
  giveSlack(skeleton, slack_rad, shape.hang_rad, retargeter.upright, ground_rad, retargeter.turns);
  standUp(skeleton, slack_rad, retargeter.upright, trunk_turn_rad, retargeter.turns);
  for (const BoneTurn& turn : retargeter.turns) retargeter.undone.push_back(turn.share(1).conjugate());

  const float duration = clip.duration_s();
  const double most_keys = double(std::ceil(duration * options.rate_hz - 1e-3f)) + 1;
  // Feet are planted contact by contact.
  checkMoments(clip, most_keys * std::max(1., double(clip.contacts.size()) / 16), count);
  const int keys = int(most_keys);
  ClipMoments moments;
  std::vector<ModelPose> poses(keys);
  const ClipSampler sampler(clip, skeleton);
  for (int k = 0; k < keys; ++k) {
    poses[k].time_s = keys == 1 ? 0 : duration * float(k) / float(keys - 1);
    const Pose pose = sampler.at(poses[k].time_s);
    moments.push_back({retargeter.motionOf(pose), pose.root_translation.cast<double>(),
                       canonicalShare(clip, poses[k].time_s)});
  }
  turnIntoPicture(shape, clip, options, moments, retargeter);
  if (options.clear_of_head) swingClearOfHead(retargeter, moments, canonical, shape.head_half_width_m);

  const bool points = std::count(retargeter.pointed.begin(), retargeter.pointed.end(), true) > 0;
  const bool moves_root = !clip.contacts.empty() || !clip.root_times_s.empty();
  double stride = 1, sway = 1, sink = 1, stand = 0, waddle_rad = 0;
  FootPlanting planting;
  if (!clip.contacts.empty()) {
    planting = footPlanting(retargeter, clip, shape);
    const double legs = legShare(skeleton, clip.contacts, shape.height_m);
    stride = sway = sink = steps * legs;
    if (skeleton.find("left_front_foot") < 0) {
      sway = std::max(steps, stride);
      waddle_rad = kWaddle_rad * std::max(0., 1 - stride);
      double joined = 0;
      for (const FootContact& contact : clip.contacts)
        joined = std::max(joined, joinedAt(shape, skeleton.index(contact.joint)));
      sink = legs * std::min(steps, 1 - kShortSquat * smoothStep(0.3, 0.9, joined));
      planting.least_lift_m = kLeastLift * std::min(1., 2 * steps) * shape.height_m;
      if (comesTowardsViewer(shape, clip, options)) planting.as_drawn = kAsDrawn;
    }
    Pose still;
    still.rotations.assign(count, Eigen::Quaternionf::Identity());
    stand = standing(skeleton, positions(skeleton, retargeter.globals(retargeter.motionOf(still), 1)),
                     clip.contacts, planting);
  }
  const Vector3d ahead = figure_from_clip * Vector3d::UnitZ();
  for (int k = 0; k < keys; ++k) {
    const auto& [motion, root, share] = moments[k];
    poses[k].globals = retargeter.globals(motion, share);
    poses[k].share = share;
    if (!moves_root) continue;
    Vector3d offset = shape.height_m * root;
    // Who takes small steps rocks from foot to foot.
    const Quaterniond roll(Eigen::AngleAxisd(-waddle_rad * share * root.x(), ahead));
    for (Quaterniond& turn : poses[k].globals) turn = roll * turn;
    // Steps are as long as the legs; what is jumped is not.
    offset.x() *= sway;
    offset.z() *= stride;
    // Breath is no squat.
    const double deep = smoothStep(0, 0.1, -root.y());
    if (offset.y() < 0) offset.y() *= stride + deep * (sink - stride);
    offset = retargeter.figure_from_clip * offset;
    if (points) offset += share * offset.z() * retargeter.ahead[0];
    poses[k].root_offset_m = offset + share * stand * Vector3d::UnitY();
  }
  plantFeet(skeleton, clip.contacts, planting, poses);
  followThrough(skeleton, clip, poses);

  Clip result = clip;
  result.lead_s = 0;
  result.interpolation = RotationInterpolation::kSlerp;
  result.frame = ClipFrame::kPicture;
  result.contacts.clear();
  result.rest_pose.clear();
  std::set<std::string> turned;
  for (const JointTrack& track : clip.tracks) turned.insert(track.joint);
  const auto turnToo = [&](const Joint& joint) {
    if (!turned.insert(joint.name).second) return;
    result.tracks.emplace_back().joint = joint.name;
    result.tracks.back().times_s = {0};
  };
  for (const FootContact& contact : clip.contacts)
    for (int joint = skeleton.index(contact.joint), bones = 0; bones < 3;
         ++bones, joint = skeleton.joints[joint].parent)
      turnToo(skeleton.joints[joint]);
  for (const Joint& joint : skeleton.joints)
    if (hangs(joint)) turnToo(joint);
  if (options.thin_keys) {
    std::vector<ModelPose> kept;
    for (const std::size_t k : keysWithin(skeleton, poses, kTolerance * shape.height_m))
      kept.push_back(std::move(poses[k]));
    poses = std::move(kept);
  }
  std::vector<float> times;
  for (const ModelPose& pose : poses) times.push_back(pose.time_s);
  for (JointTrack& track : result.tracks) {
    const bool turns = !track.times_s.empty() || !track.bone.isZero();
    track.bone.setZero();
    track.slack_rad = 0;
    track.times_s = turns ? times : std::vector<float>{};
    track.rotations.clear();
    track.angles_rad.clear();
  }
  const JointLookup joints(skeleton);
  for (JointTrack& track : result.tracks) {
    if (track.times_s.empty()) continue;
    const int joint = joints.find(track.joint), parent = skeleton.joints[joint].parent;
    for (const ModelPose& pose : poses) {
      const std::vector<Quaterniond>& globals = pose.globals;
      Quaterniond local =
          parent < 0 ? globals[joint] : (globals[parent].conjugate() * globals[joint]).normalized();
      Eigen::Quaternionf rotation = local.cast<float>().normalized();
      // What is zero but for rounding errors becomes zero: they are not the same everywhere.
      rotation.coeffs() = (rotation.coeffs().array().abs() < kNoise).select(0.f, rotation.coeffs());
      // Neighbouring keys in the same half of the sphere, for programs that interpolate the four numbers.
      if (!track.rotations.empty() ? rotation.dot(track.rotations.back()) < 0 : rotation.w() < 0)
        rotation.coeffs() = -rotation.coeffs();
      track.rotations.push_back(rotation);
    }
  }
  if (moves_root) {
    result.root_times_s = times;
    result.root_translations.clear();
    for (const ModelPose& pose : poses)
      result.root_translations.push_back((pose.root_offset_m / shape.height_m).cast<float>());
  }
  // What does not turn needs one key.
  if (options.thin_keys)
    for (JointTrack& track : result.tracks)
      if (std::all_of(track.rotations.begin(), track.rotations.end(),
                      [&](const Eigen::Quaternionf& rotation) {
                        return std::abs(rotation.dot(track.rotations[0])) > 1 - 1e-7f;
                      })) {
        track.times_s.resize(std::min<std::size_t>(1, track.times_s.size()));
        track.rotations.resize(track.times_s.size(), Eigen::Quaternionf::Identity());
        result.least_duration_s = duration;
      }
  return result;
}

}  // namespace skel
