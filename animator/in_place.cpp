#include "animator/in_place.h"

#include <algorithm>
#include <cmath>

#include "animator/film.h"
#include "libskel/animation/sample_pose.h"

namespace skel {
namespace {

// The first joint that carries several others: the hips, whatever is above them.
std::size_t hipsOf(const Skeleton& skeleton) {
  std::vector<std::vector<std::size_t>> children(skeleton.joints.size());
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
    if (const int parent = skeleton.joints[j].parent; parent >= 0) children[std::size_t(parent)].push_back(j);
  std::size_t hips = 0;
  while (children[hips].size() == 1) hips = children[hips][0];
  return children[hips].empty() ? 0 : hips;
}

}  // namespace

InPlace inPlace(const Clip& clip, const RiggedCharacter& character) {
  constexpr double kRate_hz = 30, kMostMoments = 20'000;
  const float height_m = heightOf(character);
  const Skeleton& skeleton = character.skeleton;
  InPlace result{clip};
  if (!(height_m > 0)) return result;
  const std::size_t hips = hipsOf(skeleton);
  const Eigen::Vector3f rest = skeleton.joints[hips].position.cast<float>();
  const double duration_s = double(clip.duration_s()),
               steps = std::clamp(std::ceil(duration_s * kRate_hz), 1.0, kMostMoments);
  std::vector<float> times_s;
  std::vector<Eigen::Vector3f> places;
  for (double k = 0; k <= steps; ++k) {
    const double time_s = duration_s * k / steps;
    Eigen::Vector3f way = posedAt(character, clip, time_s)[hips] * rest - rest;
    way.y() = 0;
    result.way_m = std::max(result.way_m, double(way.norm()));
    times_s.push_back(float(time_s));
    places.push_back(samplePose(clip, skeleton, float(time_s)).root_translation - way / height_m);
  }
  result.travels = result.way_m > kSway * double(height_m);
  if (!result.travels) return result;
  result.clip.root_times_s = std::move(times_s);
  result.clip.root_translations = std::move(places);
  return result;
}

}  // namespace skel
