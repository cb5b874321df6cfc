#include "libskel/animation/sample_pose.h"

#include "libskel/animation/clip_library.h"
#include "libskel/core/error.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

TEST_CASE("a pose is between its keys, and holds before the first and after the last") {
  Clip clip;
  clip.name = "nod";
  const Eigen::Quaternionf turn(Eigen::AngleAxisf(1, Eigen::Vector3f::UnitX()));
  clip.tracks = {{"head", {0, 2}, {Eigen::Quaternionf::Identity(), turn}, Eigen::Vector3f::Zero()}};
  clip.root_times_s = {0, 1};
  clip.root_translations = {{0, 0, 0}, {2, 0, 0}};
  const Skeleton skeleton = figureSkeleton();
  const int head = skeleton.index("head");
  CHECK(clip.duration_s() == 2);
  const auto angle = [&](float time_s) {
    return Eigen::AngleAxisf(samplePose(clip, skeleton, time_s).rotations[head]).angle();
  };
  CHECK(angle(-1) == Approx(0).margin(1e-6));
  CHECK(angle(0.5f) == Approx(0.25));
  CHECK(angle(2) == Approx(1));
  CHECK(angle(9) == Approx(1));
  CHECK(samplePose(clip, skeleton, 0.25f).root_translation.x() == Approx(0.5));
  CHECK(samplePose(clip, skeleton, 5).root_translation.x() == Approx(2));
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
    if (int(j) != head)
      CHECK(samplePose(clip, skeleton, 1).rotations[j].isApprox(Eigen::Quaternionf::Identity()));
}

TEST_CASE("joints move out of their places and change their size by keys of their own") {
  Clip clip;
  JointTrack track;
  track.joint = "head";
  track.translation_times_s = {1, 3};
  track.translations_m = {{0, 0, 0}, {0, 4, 0}};
  track.scale_times_s = {0, 1};
  track.scales = {{1, 1, 1}, {3, 1, 1}};
  clip.tracks = {track};
  const Skeleton skeleton = figureSkeleton();
  const std::size_t head = std::size_t(skeleton.index("head"));
  CHECK(clip.duration_s() == 3);
  const Pose pose = samplePose(clip, skeleton, 2);
  CHECK(pose.translations_m[head] == Eigen::Vector3f(0, 2, 0));
  CHECK(pose.scales[head] == Eigen::Vector3f(3, 1, 1));
  CHECK(samplePose(clip, skeleton, 0.5f).scales[head].x() == Approx(2));
  CHECK(pose.translations_m[0].isZero());
  CHECK(pose.scales[0] == Eigen::Vector3f::Ones());
  CHECK(pose.rotations[head].isApprox(Eigen::Quaternionf::Identity()));
  clip.least_duration_s = 7;
  CHECK(clip.duration_s() == 7);
}

TEST_CASE("angles turn beyond half a circle, and slerp of even keys is the same motion") {
  Clip clip;
  JointTrack track;
  track.joint = "head";
  track.times_s = {0, 2};
  track.angles_rad = {{0, 0, 0}, {0, 0, 6}};
  for (const Eigen::Vector3f& angles : track.angles_rad) track.rotations.push_back(rotationOfAngles(angles));
  clip.tracks = {track};
  const Skeleton skeleton = figureSkeleton();
  const std::size_t head = std::size_t(skeleton.index("head"));
  const auto up = [&](const Clip& of, float time_s) {
    return Eigen::Vector3f(samplePose(of, skeleton, time_s).rotations[head] * Eigen::Vector3f::UnitY());
  };
  // The shorter way is backwards.
  CHECK((up(clip, 1) - rotationOfAngles({0, 0, 3 - float(M_PI)}) * Eigen::Vector3f::UnitY()).norm() < 1e-5f);
  clip.interpolation = RotationInterpolation::kAngles;
  CHECK((up(clip, 1) - rotationOfAngles({0, 0, 3}) * Eigen::Vector3f::UnitY()).norm() < 1e-5f);
  const Clip even = withSlerp(clip);
  CHECK(even.interpolation == RotationInterpolation::kSlerp);
  for (float time_s = 0; time_s <= 2; time_s += 0.07f)
    CHECK((up(clip, time_s) - up(even, time_s)).norm() < 1e-3f);
  CHECK(rotationOfAngles({0.3f, 0.2f, 0.1f}).toRotationMatrix()(2, 0) == Approx(-std::sin(0.2f)));
}

TEST_CASE("a clip for another body plan is refused by name") {
  Skeleton skeleton = figureSkeleton();
  skeleton.joints[skeleton.index("right_elbow")].name = "fin";
  CHECK_THROWS_WITH(samplePose(clipNamed(builtinClips(), "wave"), skeleton, 0),
                    "the clip \"wave\" moves \"right_elbow\", which this skeleton lacks; use a clip for the "
                    "template \"biped\"");
}
