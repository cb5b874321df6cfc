#include "libskel/animation/sample_pose.h"

#include "libskel/animation/builtin_clips.h"
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

TEST_CASE("each body plan has clips of its own") {
  const auto names = [](const std::string& body_plan) {
    std::vector<std::string> list;
    for (const Clip& clip : builtinClipsFor(loadTemplate(body_plan))) list.push_back(clip.name);
    return list;
  };
  CHECK(names("biped") == std::vector<std::string>{"wave"});
  CHECK(names("quadruped") == std::vector<std::string>{"wag", "gallop"});
}

TEST_CASE("a clip for another body plan is refused by name") {
  Skeleton skeleton = figureSkeleton();
  skeleton.joints[skeleton.index("right_elbow")].name = "fin";
  CHECK_THROWS_WITH(samplePose(builtinClip("wave"), skeleton, 0),
                    "the clip \"wave\" moves \"right_elbow\", which this skeleton lacks; use a clip for the "
                    "template \"biped\"");
  CHECK_THROWS_WITH(builtinClip("fly"), "there is no clip \"fly\"; there are: wave, wag, gallop");
}
