#include "libskel/skin/vertex_tree.h"

#include <cmath>
#include <random>

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("the nearest vertex of those added is found, wherever they lie") {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> number(-1, 1);
  Eigen::MatrixX3f vertices(2000, 3);
  // A cloud, a heap at one place, a line, and one far away.
  for (int v = 0; v < vertices.rows(); ++v) vertices.row(v) << number(random), number(random), number(random);
  vertices.middleRows(500, 100).rowwise() = vertices.row(500);
  vertices.block(600, 0, 300, 2).setZero();
  vertices.row(1999) << 1e4f, 0, 0;
  VertexTree tree(vertices);
  CHECK(tree.nearest({0, 0, 0}, 1e6f).vertex == -1);
  std::vector<int> added;
  for (int v = 0; v < vertices.rows(); v += 3) {
    tree.add(v);
    added.push_back(v);
  }
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3f p = 2 * Eigen::Vector3f(number(random), number(random), number(random));
    float least = 1e9f;
    for (const int v : added) least = std::min(least, (vertices.row(v).transpose() - p).norm());
    const VertexTree::Found found = tree.nearest(p, 1e6f);
    REQUIRE(found.vertex % 3 == 0);
    CHECK(found.distance_m == Approx((vertices.row(found.vertex).transpose() - p).norm()));
    CHECK(found.distance_m <= 1.05f * least);
    CHECK(tree.nearest(p, 0.99f * least).vertex == -1);
  }
}

// Each looked at all of them.
TEST_CASE("from the middle of a ball one of its nearest vertices is found without a look at most") {
  Eigen::MatrixX3f ball(200'000, 3);
  for (int v = 0; v < ball.rows(); ++v) {
    const double z = 1 - 2 * (v + 0.5) / 2e5, around = 2.39996322972865 * v, r = std::sqrt(1 - z * z);
    ball.row(v) = Eigen::RowVector3d(r * std::cos(around), z, r * std::sin(around)).cast<float>();
  }
  VertexTree tree(ball);
  for (int v = 0; v < ball.rows(); ++v) tree.add(v);
  float farthest = 0;
  for (int i = 0; i < 20'000; ++i)
    farthest = std::max(farthest, tree.nearest({0, 0, 1e-7f * float(i)}, 2).distance_m);
  CHECK(farthest < 1.05f);
}
