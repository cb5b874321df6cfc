#include "libskel/export/rest_pose.h"

#include "libskel/animation/bone_turn.h"
#include "libskel/animation/clip_library.h"
#include "libskel/animation/retarget.h"
#include "libskel/core/error.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

namespace {

double length(const Skeleton& skeleton, int joint) {
  return (skeleton.joints[joint].position - skeleton.joints[skeleton.joints[joint].parent].position).norm();
}

}  // namespace

TEST_CASE("in A and T the limbs are straight, as long as before, and stand on the same ground") {
  for (const FigurePose& drawn :
       {FigurePose{}, FigurePose{170, 180, 60, -70}, FigurePose{-20, 100, 90, 90, 30}})
    for (const RestPose pose : {RestPose::kA, RestPose::kT}) {
      const RiggedCharacter before = figure(drawn), after = poseToRest(before, pose);
      CHECK(after.mesh.vertices.col(1).minCoeff() ==
            Approx(before.mesh.vertices.col(1).minCoeff()).margin(1e-5));
      for (std::size_t j = 1; j < before.skeleton.joints.size(); ++j)
        CHECK(length(after.skeleton, int(j)) == Approx(length(before.skeleton, int(j))).epsilon(1e-4));
      const double slope = pose == RestPose::kT ? 0 : -std::sqrt(0.5);
      for (const char* joint : {"left_shoulder", "left_elbow", "right_shoulder", "right_elbow"}) {
        const Eigen::Vector3d bone = restBones(after.skeleton)[std::size_t(after.skeleton.index(joint))];
        CHECK(bone.y() == Approx(slope).margin(1e-4));
        CHECK(bone.x() * (joint[0] == 'l' ? 1 : -1) > 0.7);
      }
      for (const char* joint : {"left_hip", "left_knee", "right_hip", "right_knee"})
        CHECK(restBones(after.skeleton)[std::size_t(after.skeleton.index(joint))].y() < -0.99);
      // Twice changes nothing, and clips fit the new pose.
      const RiggedCharacter again = poseToRest(after, pose);
      CHECK((again.mesh.vertices - after.mesh.vertices).cwiseAbs().maxCoeff() < 1e-4f);
      CHECK_FALSE(retargetToRest(clipNamed(builtinClips(), "wave"), after.skeleton).tracks.empty());
    }
}

TEST_CASE("the drawn pose stays, and other body plans have no A or T") {
  RiggedCharacter character = figure();
  CHECK(poseToRest(character, RestPose::kDrawn).mesh.vertices == character.mesh.vertices);
  character.skeleton.joints[character.skeleton.index("left_hip")].name = "fluke";
  CHECK_THROWS_AS(poseToRest(character, RestPose::kT), UsageError);
}
