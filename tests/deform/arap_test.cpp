#include "libskel/deform/arap.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "libskel/core/error.h"
#include "libskel/deform/untangle.h"
#include "tests/support/catch.h"

using namespace skel;
using Eigen::MatrixX2d;
using Eigen::MatrixX3i;

namespace {

struct Sheet {
  MatrixX2d vertices;
  MatrixX3i triangles;
};

// A bar of columns × rows squares, each cut in two, one px a side.
Sheet bar(int columns, int rows) {
  Sheet sheet{MatrixX2d((columns + 1) * (rows + 1), 2), MatrixX3i(2 * columns * rows, 3)};
  const auto at = [&](int x, int y) { return y * (columns + 1) + x; };
  int t = 0;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) {
      sheet.vertices.row(at(x, y)) << x, y;
      if (x == columns || y == rows) continue;
      sheet.triangles.row(t++) << at(x, y), at(x + 1, y), at(x + 1, y + 1);
      sheet.triangles.row(t++) << at(x, y), at(x + 1, y + 1), at(x, y + 1);
    }
  return sheet;
}

const Sheet kBar = bar(40, 8);
const MatrixX2d kHandles = (MatrixX2d(3, 2) << 2.3, 4.1, 20, 4, 37.8, 4.4).finished();

}  // namespace

TEST_CASE("handles at rest leave the mesh at rest") {
  const ArapMesh mesh(kBar.vertices, kBar.triangles, kHandles);
  CHECK((mesh.deform(kHandles) - kBar.vertices).cwiseAbs().maxCoeff() < 1e-6);
  CHECK((mesh.handlesOf(kBar.vertices) - kHandles).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("handles that turn and move together take the mesh along, unchanged") {
  const ArapMesh mesh(kBar.vertices, kBar.triangles, kHandles);
  for (const double degrees : {30., 90., 180., -135.}) {
    CAPTURE(degrees);
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(degrees * std::numbers::pi / 180).toRotationMatrix();
    const auto moved = [&](const MatrixX2d& points) {
      return MatrixX2d((points * turn.transpose()).rowwise() + Eigen::RowVector2d(100, -30));
    };
    CHECK((mesh.deform(moved(kHandles)) - moved(kBar.vertices)).cwiseAbs().maxCoeff() < 1e-6);
  }
}

TEST_CASE("a bar bends like an arm: no triangle flips, its area stays, the handles hold") {
  const ArapMesh mesh(kBar.vertices, kBar.triangles, kHandles);
  const auto area = [&](const MatrixX2d& v) {
    double sum = 0;
    for (Eigen::Index t = 0; t < kBar.triangles.rows(); ++t) {
      const Eigen::Vector2d a = v.row(kBar.triangles(t, 0)), b = v.row(kBar.triangles(t, 1)),
                            c = v.row(kBar.triangles(t, 2));
      sum += 0.5 * ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
    }
    return sum;
  };
  for (const double degrees : {45., 90., 120., 150., 170.}) {
    CAPTURE(degrees);
    const double a = degrees * std::numbers::pi / 180;
    MatrixX2d targets = kHandles;
    targets.row(2) = targets.row(1) + 17.8 * Eigen::RowVector2d(std::cos(a), std::sin(a));
    const MatrixX2d posed = mesh.deform(targets);
    CHECK(flippedTriangles(kBar.vertices, posed, kBar.triangles) == 0);
    CHECK(area(posed) == Approx(area(kBar.vertices)).epsilon(0.15));
    CHECK((mesh.handlesOf(posed) - targets).cwiseAbs().maxCoeff() < 0.5);
  }
}

TEST_CASE("what is folded is unfolded, and what is not stays as it is") {
  const std::vector<MeshHandle> handles = {{{0, 1, 42}, {1, 0, 0}}, {{327, 368, 367}, {0, 1, 0}}};
  const Untangler untangler(kBar.vertices, kBar.triangles, handles);
  const MatrixX2d targets = (MatrixX2d(2, 2) << 0, 0, 40, 8).finished();
  MatrixX2d posed = kBar.vertices;
  untangler.untangle(posed, targets);
  CHECK(posed == kBar.vertices);
  // One vertex across its neighbours: what is far stays.
  posed.row(4 * 41 + 20) += Eigen::RowVector2d(2.5, 0.3);
  REQUIRE(flippedTriangles(kBar.vertices, posed, kBar.triangles) >= 2);
  untangler.untangle(posed, targets);
  CHECK(flippedTriangles(kBar.vertices, posed, kBar.triangles) == 0);
  CHECK((posed - kBar.vertices).cwiseAbs().maxCoeff() < 1.5);
  CHECK(posed.topRows(40) == kBar.vertices.topRows(40));
  CHECK(posed.bottomRows(40) == kBar.vertices.bottomRows(40));
  // A block in a mirror.
  posed = kBar.vertices;
  posed.block(2 * 41 + 5, 0, 4, 1).reverseInPlace();
  posed.block(3 * 41 + 5, 0, 4, 1).reverseInPlace();
  REQUIRE(flippedTriangles(kBar.vertices, posed, kBar.triangles) > 4);
  untangler.untangle(posed, targets);
  CHECK(flippedTriangles(kBar.vertices, posed, kBar.triangles) == 0);
}

TEST_CASE("the result does not depend on what was asked before") {
  const ArapMesh mesh(kBar.vertices, kBar.triangles, kHandles);
  MatrixX2d targets = kHandles;
  targets(2, 1) += 15;
  const MatrixX2d first = mesh.deform(targets);
  mesh.deform(-targets);
  CHECK(mesh.deform(targets) == first);
}

TEST_CASE("triangles that are turned over are counted") {
  MatrixX2d folded = kBar.vertices;
  CHECK(flippedTriangles(kBar.vertices, folded, kBar.triangles) == 0);
  folded.col(0) *= -1;
  CHECK(flippedTriangles(kBar.vertices, folded, kBar.triangles) == kBar.triangles.rows());
}

TEST_CASE("of two bars that lie over each other, each goes with the vertices that it is held by") {
  const Eigen::Index count = kBar.vertices.rows();
  MatrixX2d both(2 * count, 2);
  both << kBar.vertices, kBar.vertices;
  MatrixX3i triangles(2 * kBar.triangles.rows(), 3);
  triangles << kBar.triangles, kBar.triangles.array() + int(count);
  const std::vector<int> held = {0, 40, int(count), int(count) + 40};
  const ArapMesh mesh(both, triangles, held);
  MatrixX2d targets(4, 2);
  for (Eigen::Index h = 0; h < 4; ++h) targets.row(h) = both.row(held[std::size_t(h)]);
  targets.bottomRows(2).rowwise() += Eigen::RowVector2d(0, 50);
  const MatrixX2d posed = mesh.deform(targets);
  CHECK((posed.topRows(count) - kBar.vertices).cwiseAbs().maxCoeff() < 1e-6);
  CHECK((posed.bottomRows(count) - both.bottomRows(count)).col(1).minCoeff() > 49.99);
  CHECK_THROWS_AS(ArapMesh(both, triangles, std::vector<int>{7}), UsageError);
}

TEST_CASE("meshes and handles that cannot be used are refused") {
  CHECK_THROWS_AS(ArapMesh(kBar.vertices, MatrixX3i(0, 3), kHandles), UsageError);
  CHECK_THROWS_AS(ArapMesh(kBar.vertices, kBar.triangles, kHandles.topRows(1)), UsageError);
  CHECK_THROWS_AS(ArapMesh(kBar.vertices, kBar.triangles, kHandles.topRows(1).replicate(3, 1)), UsageError);
  MatrixX2d bad = kBar.vertices;
  bad(7, 0) = std::nan("");
  CHECK_THROWS_AS(ArapMesh(bad, kBar.triangles, kHandles), UsageError);
  CHECK_THROWS_AS(
      ArapMesh(MatrixX2d::Zero(3, 2), MatrixX3i((MatrixX3i(1, 3) << 0, 1, 2).finished()), kHandles),
      UsageError);
}
