#include "libskel/animation/arm_abilities.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libskel/animation/bone_turn.h"
#include "libskel/animation/clip_limits.h"
#include "libskel/animation/mirror_clip.h"
#include "libskel/animation/pose_hash.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/core/smooth_step.h"
#include "libskel/core/text.h"

namespace skel {
namespace {

// Instead of what the arm does, the trunk rocks from side to side, unless it bows as far anyway.
Clip rocking(const Clip& clip, const Skeleton& skeleton, const std::string& side) {
  constexpr double kRock_rad = 16 * std::numbers::pi / 180, kSwing_s = 0.75, kRate_hz = 30;
  Clip result = clip;
  std::erase_if(result.tracks, [&](const JointTrack& track) {
    return track.joint == side + "shoulder" || track.joint == side + "elbow" || track.joint == side + "hand";
  });
  const double duration_s = double(clip.duration_s());
  const double keys = std::ceil(duration_s * kRate_hz),
               swings = std::max(1.0, std::round(duration_s / kSwing_s));
  checkMoments(clip, keys, skeleton.joints.size());
  result.least_duration_s = clip.duration_s();
  JointTrack rock;
  rock.joint = "body";
  double most_rad = 0;
  for (double k = 0; k <= keys; ++k) {
    const double time_s = duration_s * k / keys;
    const Eigen::Quaternionf trunk =
        samplePose(clip, skeleton, float(time_s)).rotations[skeleton.index("body")];
    most_rad = std::max(most_rad, double(Eigen::AngleAxisf(trunk).angle()));
    rock.times_s.push_back(float(time_s));
    rock.rotations.push_back(
        aboutZ(kRock_rad * canonicalShare(clip, time_s) * std::sin(2 * std::numbers::pi * swings * k / keys))
            .cast<float>());
  }
  if (most_rad > kRock_rad) return result;
  std::erase_if(result.tracks, [](const JointTrack& track) { return track.joint == "body"; });
  result.tracks.push_back(std::move(rock));
  return result;
}

std::string acrossFrom(const std::string& side) { return side == "left_" ? "right_" : "left_"; }

bool isStump(const FigureShape& shape, int elbow) {
  return !shape.taken.empty() && shape.taken[elbow] < kStump;
}

// Whether an arm shows what it does.
bool showsArm(const Skeleton& skeleton, const FigureShape& shape, const std::string& side) {
  const int elbow = skeleton.find(side + "elbow");
  return elbow >= 0 && joinedAt(shape, elbow) < kGrownArm && !isStump(shape, elbow);
}

// "left_" or "right_" where the clip is that arm's and this figure's does not show it; else empty.
std::string armThatCannot(const Clip& clip, const Skeleton& skeleton, const FigureShape& shape) {
  constexpr double kOneArm = 3;
  for (const std::string side : {"left_", "right_"})
    if (armTravel(clip, side) > kOneArm * armTravel(clip, acrossFrom(side)) &&
        !showsArm(skeleton, shape, side))
      return side;
  return "";
}

// What is to be said of an arm, before the name of the clip and after it.
struct ArmStay {
  std::string before, after;
  bool operator==(const ArmStay&) const = default;
};

std::vector<ArmStay> staysIn(const Clip& clip, const Skeleton& skeleton, const FigureShape& shape) {
  constexpr double kMoves_rad = 1, kStays = 0.5, kInPart = 1. / 3;
  if (isRelativeTo(clip, skeleton)) return {};
  const auto named = [](const std::string& side) { return side.substr(0, side.size() - 1) + " arm"; };
  const std::string cannot = armThatCannot(clip, skeleton, shape);
  if (!cannot.empty() && armTravel(clip, cannot) > kMoves_rad) {
    const std::string other = acrossFrom(cannot);
    return {{"the " + named(cannot) + " cannot be moved well and does not do ",
             showsArm(skeleton, shape, other) ? "; the " + named(other) + " does"
             : skeleton.find("body") >= 0     ? "; the trunk rocks"
                                              : ""}};
  }
  // Bones of a clip that lets none stay where they were drawn turn all the way, and the flesh that hangs on
  // them.
  const auto follows = [&](const std::string& side, double kept, double least_share) {
    return armTravel(clip, side, heldShare(kept)) >= least_share * armTravel(clip, side) &&
           !isStump(shape, skeleton.find(side + "elbow"));
  };
  std::vector<ArmStay> stays;
  for (const std::string side : {"left_", "right_"})
    if (const double kept = keptArm(skeleton, shape, side);
        armTravel(clip, side) > kMoves_rad && kept > kStays && !follows(side, kept, heldShare(kStays))) {
      const bool in_part = follows(side, kept, kInPart);
      stays.push_back({"the " + named(side) + " is one piece with the body and " +
                           (in_part ? "follows " : "does not follow "),
                       in_part ? " only in part" : ""});
    }
  return stays;
}

}  // namespace

double keptArm(const Skeleton& skeleton, const FigureShape& shape, const std::string& side) {
  const int shoulder = skeleton.find(side + "shoulder"), elbow = skeleton.find(side + "elbow"),
            hand = skeleton.find(side + "hand");
  if (shoulder < 0 || elbow < 0 || hand < 0) return 0;
  const double least = isSeated(skeleton, shape) ? 0.8 : 0;  // on the knees, or to lean on
  const double joined = shape.joined.empty() ? isFolded(skeleton, elbow, hand) : shape.joined[elbow];
  return std::max(least, smoothStep(0.45, kGrownArm, joined));
}

double heldShare(double kept) { return 1 - 0.8 * kept; }

double travelOf(const Clip& clip, const std::set<std::string>& joints, double held_share) {
  double sum = 0;
  for (const JointTrack& track : clip.tracks)
    if (joints.contains(track.joint))
      for (std::size_t k = 1; k < track.rotations.size(); ++k)
        sum += (track.slack_rad > 0 ? held_share : 1) *
               double(track.rotations[k].angularDistance(track.rotations[k - 1]));
  return sum;
}
double armTravel(const Clip& clip, const std::string& side, double held_share) {
  return travelOf(clip, {side + "shoulder", side + "elbow"}, held_share);
}

Clip asItCan(const Clip& clip, const Skeleton& skeleton, const FigureShape& shape) {
  const std::string side = armThatCannot(clip, skeleton, shape);
  if (side.empty()) return clip;
  if (showsArm(skeleton, shape, acrossFrom(side))) return mirrored(clip);
  return skeleton.find("body") >= 0 ? rocking(clip, skeleton, side) : clip;
}

std::vector<std::string> armsThatStay(std::span<const Clip> clips, const Skeleton& skeleton,
                                      const FigureShape& shape) {
  std::vector<ArmStay> stays;
  std::vector<std::vector<std::string>> names;  // of clips, quoted, for each
  for (const Clip& clip : clips)
    for (ArmStay& stay : staysIn(clip, skeleton, shape)) {
      const auto same = std::find(stays.begin(), stays.end(), stay);
      const auto at = std::size_t(same - stays.begin());
      if (same == stays.end()) stays.push_back(std::move(stay)), names.emplace_back();
      names[at].push_back('"' + clip.name + '"');
    }
  std::vector<std::string> clauses;
  for (std::size_t i = 0; i < stays.size(); ++i)
    clauses.push_back(stays[i].before + joined(names[i]) + stays[i].after);
  return clauses;
}

}  // namespace skel
