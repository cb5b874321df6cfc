#include "libskel/deform/limb_depth.h"

#include "tests/support/catch.h"

namespace skel {
namespace {

// A quadruped's joints, and a column of four vertices around the middle of each leg's lower half, 2 cm thick.
struct FourColumns {
  SkeletonTemplate plan = loadTemplate("quadruped");
  Skeleton skeleton = presetSkeleton(plan, {0, 0}, {100, 100});
  TriangleMesh mesh;
  SkinWeights weights;

  FourColumns() {
    std::vector<int> knees;
    for (const TemplateLimb& limb : plan.limbs)
      knees.push_back(skeleton.index(plan.joints[limb.joints[1]].name));
    const auto count = static_cast<Eigen::Index>(2 * knees.size());
    mesh.vertices.resize(count, 3);
    weights.joints.setZero(count, 4);
    weights.weights.setZero(count, 4);
    for (Eigen::Index v = 0; v < count; ++v) {
      mesh.vertices.row(v) << float(v), 0, v % 2 == 0 ? -.01f : .01f;
      weights.joints(v, 0) = static_cast<std::uint16_t>(knees[static_cast<std::size_t>(v / 2)]);
      weights.weights(v, 0) = 1;
    }
  }
  float depth(int limb) const { return (mesh.vertices(2 * limb, 2) + mesh.vertices(2 * limb + 1, 2)) / 2; }
  double jointDepth(int limb) const {
    return skeleton.joints[skeleton.index(plan.joints[plan.limbs[limb].joints[1]].name)].position.z();
  }
};

TEST_CASE("Legs of a figure from the side lie beside one another, and their joints with them") {
  FourColumns animal;
  partLimbsInDepth(animal.mesh, animal.skeleton, animal.weights, animal.plan, 0);
  const auto limbs = static_cast<int>(animal.plan.limbs.size());
  REQUIRE(limbs == 4);
  for (int l = 0; l < limbs; ++l) {
    CHECK(std::abs(animal.depth(l)) >= .01f);  // no two share a place
    CHECK(animal.jointDepth(l) == Approx(animal.depth(l)).margin(1e-6));
  }
  CHECK(animal.depth(0) * animal.depth(1) < 0);
  CHECK(animal.depth(2) * animal.depth(3) < 0);
}

TEST_CASE("The limb that was seen more surely is the nearer one") {
  FourColumns animal;
  for (const int j : animal.plan.limbs[1].joints)
    animal.skeleton.joints[animal.skeleton.index(animal.plan.joints[j].name)].confidence = .9;
  partLimbsInDepth(animal.mesh, animal.skeleton, animal.weights, animal.plan, 0);
  CHECK(animal.depth(1) > 0);
  CHECK(animal.depth(0) < 0);
}

TEST_CASE("A limb that is known to be the farther one is, however surely it was seen") {
  FourColumns animal;
  for (const int j : animal.plan.limbs[2].joints)
    animal.skeleton.joints[animal.skeleton.index(animal.plan.joints[j].name)].confidence = 1;
  partLimbsInDepth(animal.mesh, animal.skeleton, animal.weights, animal.plan, 0, {2, 3});
  CHECK(animal.depth(0) > 0);
  CHECK(animal.depth(1) < 0);
  CHECK(animal.depth(2) < 0);
  CHECK(animal.depth(3) > 0);
}

TEST_CASE("A body plan that is drawn from the front stays flat unless it is turned") {
  FourColumns animal;
  animal.plan.from_side = false;
  const Eigen::MatrixX3f before = animal.mesh.vertices;
  partLimbsInDepth(animal.mesh, animal.skeleton, animal.weights, animal.plan, 0);
  CHECK(animal.mesh.vertices == before);
  partLimbsInDepth(animal.mesh, animal.skeleton, animal.weights, animal.plan, 1.5);
  CHECK(animal.mesh.vertices != before);
  CHECK(animal.mesh.vertices.leftCols<2>() == before.leftCols<2>());
}

}  // namespace
}  // namespace skel
