#include "libskel/animation/builtin_clips.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libskel/core/error.h"

namespace skel {

namespace {

struct Key {
  double time_s, degrees;
};

// Keys are the extremes of a motion: it comes to rest at each and eases between them.
double eased(const std::vector<Key>& keys, double time_s) {
  std::size_t next = 1;
  while (next + 1 < keys.size() && keys[next].time_s < time_s) ++next;
  const Key &a = keys[next - 1], &b = keys[next];
  const double t = std::clamp((time_s - a.time_s) / (b.time_s - a.time_s), 0.0, 1.0);
  return a.degrees + (b.degrees - a.degrees) * (0.5 - 0.5 * std::cos(t * std::numbers::pi));
}

// Turns about the axis to the viewer, counter-clockwise as he sees them.
JointTrack frontalTrack(const std::string& joint, const std::vector<Key>& keys,
                        const Eigen::Vector3f& bone = Eigen::Vector3f::Zero()) {
  constexpr double kRate_hz = 30;
  JointTrack track;
  track.joint = joint;
  track.bone = bone;
  const int last = int(std::lround(keys.back().time_s * kRate_hz));
  for (int i = 0; i <= last; ++i) {
    const double time_s = i / kRate_hz;
    track.times_s.push_back(float(time_s));
    const double angle = eased(keys, time_s) * std::numbers::pi / 180;
    track.rotations.emplace_back(Eigen::AngleAxisf(float(angle), Eigen::Vector3f::UnitZ()));
  }
  return track;
}

// The right arm goes up at its side, the forearm waves three times, the arm goes down; the trunk leans away
// from it a little and the head tilts towards it.
Clip makeWave() {
  const Eigen::Vector3f down(0, -1, 0);
  Clip clip;
  clip.name = "wave";
  clip.lead_s = 0.6f;
  clip.tracks = {
      frontalTrack("body", {{0, 0}, {0.6, -2.5}, {1.0, -1}, {1.4, -3}, {1.8, -1}, {2.2, -2.5}, {2.8, 0}}),
      frontalTrack("neck", {{0, 0}, {0.7, 1.5}, {2.1, 1.5}, {2.8, 0}}),
      frontalTrack("head", {{0, 0}, {0.7, 5}, {1.4, 3}, {2.1, 5}, {2.8, 0}}),
      frontalTrack("left_shoulder", {{0, 0}, {0.7, 4}, {1.4, 1}, {2.1, 4}, {2.8, 0}}),
      frontalTrack("right_shoulder",
                   {{0, 0},
                    {0.6, -97},
                    {0.8, -101},
                    {1.0, -95},
                    {1.2, -101},
                    {1.4, -95},
                    {1.6, -101},
                    {1.8, -95},
                    {2.0, -101},
                    {2.2, -97},
                    {2.8, 0}},
                   down),
      frontalTrack("right_elbow",
                   {{0, 0},
                    {0.6, -62},
                    {0.8, -94},
                    {1.0, -44},
                    {1.2, -94},
                    {1.4, -44},
                    {1.6, -94},
                    {1.8, -44},
                    {2.0, -94},
                    {2.2, -62},
                    {2.8, 0}},
                   down),
      // The hand trails behind the forearm.
      frontalTrack("right_hand",
                   {{0, 0},
                    {0.4, 8},
                    {0.7, 14},
                    {0.9, -14},
                    {1.1, 14},
                    {1.3, -14},
                    {1.5, 14},
                    {1.7, -14},
                    {1.9, 14},
                    {2.1, -14},
                    {2.4, -8},
                    {2.8, 0}},
                   down),
  };
  return clip;
}

// An animal nods twice and wags its tail, whose tip trails behind.
Clip makeWag() {
  std::vector<Key> root = {{0, 0}}, tip = {{0, 0}, {0.1, 0}};
  for (int i = 0; i < 8; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    root.push_back({0.2 + 0.3 * i, 20 * side});
    tip.push_back({0.3 + 0.3 * i, 25 * side});
  }
  root.push_back({2.6, 0});
  tip.push_back({2.7, 0});
  Clip clip;
  clip.name = "wag";
  clip.tracks = {
      frontalTrack("tail_root", root), frontalTrack("tail", tip),
      frontalTrack("head", {{0, 0}, {0.4, 10}, {0.8, -10}, {1.2, 8}, {1.6, -8}, {2.2, 3}, {2.7, 0}})};
  return clip;
}

// Three leaps on the spot. The legs of a pair swing together, since in a drawing from the side they often
// touch, and as far forwards as back, so that it does not matter where the animal looks.
Clip makeGallop() {
  constexpr double kHalfLeap_s = 0.35;
  const auto swing = [](double delay_s, double degrees) {
    std::vector<Key> keys = {{0, 0}};
    for (int i = 0; i < 6; ++i)
      keys.push_back({delay_s + (i + 0.5) * kHalfLeap_s, i % 2 == 0 ? degrees : -degrees});
    keys.push_back({delay_s + 6.5 * kHalfLeap_s, 0});
    return keys;
  };
  Clip clip;
  clip.name = "gallop";
  for (const std::string side : {"left_", "right_"}) {
    clip.tracks.push_back(frontalTrack(side + "shoulder", swing(0, 18)));
    clip.tracks.push_back(frontalTrack(side + "hip", swing(0, -18)));
    // The lower halves trail behind.
    clip.tracks.push_back(frontalTrack(side + "elbow", swing(0.1, 14)));
    clip.tracks.push_back(frontalTrack(side + "knee", swing(0.1, -14)));
  }
  clip.tracks.push_back(frontalTrack("neck", swing(0.05, -4)));
  clip.tracks.push_back(frontalTrack("tail_root", swing(0.1, 8)));
  return clip;
}

}  // namespace

const std::vector<Clip>& builtinClips() {
  static const std::vector<Clip> clips = {makeWave(), makeWag(), makeGallop()};
  return clips;
}

std::vector<Clip> builtinClipsFor(const SkeletonTemplate& body_plan) {
  std::vector<Clip> fitting;
  for (const Clip& clip : builtinClips())
    if (std::all_of(clip.tracks.begin(), clip.tracks.end(),
                    [&](const JointTrack& track) { return body_plan.find(track.joint) >= 0; }))
      fitting.push_back(clip);
  return fitting;
}

const Clip& builtinClip(std::string_view name) {
  std::string names;
  for (const Clip& clip : builtinClips()) {
    if (clip.name == name) return clip;
    names += (names.empty() ? "" : ", ") + clip.name;
  }
  throw UsageError("there is no clip \"" + std::string(name) + "\"; there are: " + names);
}

}  // namespace skel
