#include "animator/handles.h"

#include "animator/orbit.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

TEST_CASE("pulling a ring turns the joint so that the ring's point follows the mouse") {
  const Skeleton skeleton = figureSkeleton();
  const int joint = skeleton.index("left_elbow");
  for (const double yaw : {0.0, 0.7, 2.0, -1.2})
    for (const double pitch : {0.1, 0.8}) {
      Camera camera;
      camera.target = {0, 0.9, 0};
      camera.yaw_rad = yaw;
      camera.pitch_rad = pitch;
      const Projection projection(camera, 600, 600);
      std::vector<Eigen::Quaternionf> rotations(skeleton.joints.size(), Eigen::Quaternionf::Identity());
      rotations[std::size_t(joint)] = Eigen::AngleAxisf(0.5f, Eigen::Vector3f(1, 2, 3).normalized());
      const JointTransforms posed = posedFromRest(skeleton, rotations);
      const auto rings = jointRings(skeleton, posed, joint, projection, camera, 70);
      for (int axis = 0; axis < 3; ++axis) {
        const Ring& ring = rings[std::size_t(axis)];
        for (std::size_t i = 0; i < ring.points.size(); i += 5) {
          const auto found = grip(rings, ring.points[i], 6);
          REQUIRE(found);
          if (found->axis != axis || !ring.in_front[i] || found->per_rad.norm() < 30) continue;
          // Where that point of the ring lies after a small turn.
          const double angle = 0.02;
          auto turned = rotations;
          turned[std::size_t(joint)] =
              turned[std::size_t(joint)] * Eigen::AngleAxisf(float(angle), Eigen::Vector3f::Unit(axis));
          const auto after =
              jointRings(skeleton, posedFromRest(skeleton, turned), joint, projection, camera, 70);
          CAPTURE(yaw, pitch, axis, i);
          CHECK(found->angleTo(after[std::size_t(axis)].points[i]) == Approx(angle).epsilon(0.15));
        }
      }
    }
}

TEST_CASE("a mouse beside all rings holds none") {
  const Skeleton skeleton = figureSkeleton();
  Camera camera;
  camera.target = {0, 0.9, 0};
  const Projection projection(camera, 600, 600);
  const JointTransforms rest(skeleton.joints.size(), Eigen::Affine3f::Identity());
  const auto rings = jointRings(skeleton, rest, 0, projection, camera, 70);
  const Eigen::Vector2d middle = *projection(skeleton.joints[0].position);
  CHECK_FALSE(grip(rings, middle + Eigen::Vector2d(90, 0), 6));
  CHECK(grip(rings, middle + Eigen::Vector2d(49.5, 49.5), 6)->axis == 2);
}

TEST_CASE("moving and zooming keep the point under the mouse") {
  Camera camera;
  camera.target = {0.2, 0.9, -0.1};
  camera.yaw_rad = 0.4;
  camera.pitch_rad = 0.3;
  const Eigen::Vector3d point =
      camera.target + eyeFromModel(camera).transpose() * Eigen::Vector3d(0.3, -0.2, 0);
  const Eigen::Vector2d before = *Projection(camera, 500, 400)(point);
  Camera moved = camera;
  pan(moved, 37, -21, 400);
  CHECK((*Projection(moved, 500, 400)(point) - before - Eigen::Vector2d(37, -21)).norm() < 1e-6);
  Camera nearer = camera;
  zoom(nearer, 1.7, before.x() - 249.5, before.y() - 199.5, 400);
  CHECK((*Projection(nearer, 500, 400)(point) - before).norm() < 1e-6);
  CHECK(nearer.view_height_m == Approx(camera.view_height_m / 1.7));
  Camera turned = camera;
  orbit(turned, 0, 1e5, 400);
  CHECK(turned.pitch_rad < 1.5708);
  orbit(turned, -400, 0, 400);
  CHECK(std::abs(std::remainder(turned.yaw_rad - camera.yaw_rad, 2 * std::numbers::pi)) ==
        Approx(std::numbers::pi));
}
