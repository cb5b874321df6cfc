#include "libskel/candidates/candidates.h"

#include <cmath>

#include "libskel/core/rng.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

constexpr CandidateMethod kAllMethods[] = {CandidateMethod::kMaxima, CandidateMethod::kStrict,
                                           CandidateMethod::kDiscs};

// A silhouette that has nothing but a grid, filled where `inside` says so.
template <class Inside>
Silhouette drawn(int width, int height, Inside inside) {
  Silhouette silhouette;
  silhouette.status = SilhouetteStatus::kFound;
  silhouette.grid = {.width = width, .height = height, .scale = 1};
  silhouette.grid_mask = Plane8::Zero(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (inside(x, y)) silhouette.grid_mask(y, x) = 255;
  return silhouette;
}

DistanceField bruteForce(const Plane8& mask) {
  const int height = static_cast<int>(mask.rows()), width = static_cast<int>(mask.cols());
  DistanceField distance = DistanceField::Zero(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (!mask(y, x)) continue;
      int best = 1 << 30;
      for (int v = -1; v <= height; ++v)
        for (int u = -1; u <= width; ++u) {
          const bool outside = u < 0 || v < 0 || u >= width || v >= height || !mask(v, u);
          if (outside) best = std::min(best, (u - x) * (u - x) + (v - y) * (v - y));
        }
      distance(y, x) = std::sqrt(static_cast<float>(best));
    }
  return distance;
}

Silhouette randomShape(Rng& rng) {
  std::vector<Eigen::Vector3d> discs;
  for (int i = 0; i < 8; ++i) discs.emplace_back(rng.uniform(0, 48), rng.uniform(0, 40), rng.uniform(1, 9));
  const double noise = rng.uniform(0, 0.2);
  return drawn(48, 40, [&](int x, int y) {
    if (rng.chance(noise)) return false;
    for (const auto& d : discs)
      if (std::hypot(x - d.x(), y - d.y()) < d.z()) return true;
    return false;
  });
}

}  // namespace

TEST_CASE("the distance field is exact") {
  Rng rng(7);
  for (int round = 0; round < 30; ++round) {
    const Plane8 mask = randomShape(rng).grid_mask;
    CHECK((distanceField(mask) - bruteForce(mask)).abs().maxCoeff() == 0);
  }
  CHECK(distanceField(Plane8::Constant(1, 1, 255))(0, 0) == 1);
  CHECK(distanceField(Plane8::Constant(9, 9, 255))(4, 4) == 5);
  CHECK(distanceField(Plane8(0, 0)).size() == 0);
}

TEST_CASE("a disc has one kept candidate, at its centre") {
  const Silhouette disc = drawn(41, 41, [](int x, int y) { return std::hypot(x - 20, y - 20) < 20; });
  for (const CandidateMethod method : kAllMethods) {
    const CandidateSet candidates = extractCandidates(disc, {.method = method});
    REQUIRE(!candidates.kept.empty());
    const JointCandidate& largest = candidates.maxima[0];
    CHECK(largest.x == 20);
    CHECK(largest.y == 20);
    CHECK(largest.radius == 20);
    if (method != CandidateMethod::kDiscs) CHECK(candidates.kept.size() == 1);
  }
}

TEST_CASE("a bar's plateau survives >= and is lost to >") {
  const Silhouette bar = drawn(60, 9, [](int, int) { return true; });
  CHECK(extractCandidates(bar).maxima.size() == 52);
  CHECK(extractCandidates(bar, {.method = CandidateMethod::kStrict}).maxima.empty());
}

TEST_CASE("candidates are sorted and pruned by their discs, whatever the method") {
  Rng rng(11);
  for (int round = 0; round < 60; ++round) {
    const Silhouette shape = randomShape(rng);
    for (const CandidateMethod method : kAllMethods) {
      const CandidateSet candidates = extractCandidates(shape, {.method = method});
      for (size_t i = 1; i < candidates.maxima.size(); ++i)
        REQUIRE(candidates.maxima[i - 1].radius >= candidates.maxima[i].radius);
      for (const JointCandidate& c : candidates.maxima)
        REQUIRE(candidates.distance(static_cast<int>(c.y), static_cast<int>(c.x)) == c.radius);
      for (size_t a = 0; a < candidates.kept.size(); ++a)
        for (size_t b = 0; b < a; ++b) {
          const JointCandidate& small = candidates.maxima[candidates.kept[a]];
          const JointCandidate& large = candidates.maxima[candidates.kept[b]];
          REQUIRE(std::hypot(small.x - large.x, small.y - large.y) > large.radius);
        }
    }
  }
}

// docs/pipeline.md has the proof: each pixel lies in a maximal disc (m, D(m)), and m within D(c) >= D(m) of a
// kept c.
TEST_CASE("with maximal discs each pixel is within twice the radius of a kept candidate") {
  Rng rng(13);
  for (int round = 0; round < 200; ++round) {
    const CandidateSet candidates = extractCandidates(randomShape(rng), {.method = CandidateMethod::kDiscs});
    REQUIRE(uncoveredShare(candidates, 2) == 0);
  }
}

TEST_CASE("maxima alone do not cover: on a taper all discs but the last are no maxima") {
  const Silhouette taper = drawn(120, 61, [](int x, int y) { return std::abs(y - 30) * 2.8 <= x; });
  const CandidateSet maxima = extractCandidates(taper);
  const CandidateSet discs = extractCandidates(taper, {.method = CandidateMethod::kDiscs});
  CHECK(uncoveredShare(maxima, 2) > 0.04);
  CHECK(uncoveredShare(discs, 2) == 0);
}

TEST_CASE("each disc of the figure lies in the disc of a candidate of the method discs") {
  Rng rng(17);
  for (int round = 0; round < 10; ++round) {
    const CandidateSet candidates = extractCandidates(randomShape(rng), {.method = CandidateMethod::kDiscs});
    const DistanceField& distance = candidates.distance;
    const auto contains = [&](const JointCandidate& c, int x, int y) {
      const int r = static_cast<int>(distance(y, x));
      const auto norm = [](int a, int b) { return a * a + b * b; };
      const long inner = std::lround(distance(y, x) * distance(y, x)),
                 outer = std::lround(c.radius * c.radius);
      for (int v = y - r; v <= y + r; ++v)
        for (int u = x - r; u <= x + r; ++u)
          if (norm(u - x, v - y) < inner &&
              norm(u - static_cast<int>(c.x), v - static_cast<int>(c.y)) >= outer)
            return false;
      return true;
    };
    for (int y = 0; y < distance.rows(); ++y)
      for (int x = 0; x < distance.cols(); ++x)
        if (distance(y, x) > 0)
          REQUIRE(std::any_of(candidates.maxima.begin(), candidates.maxima.end(),
                              [&](const JointCandidate& c) { return contains(c, x, y); }));
  }
}

TEST_CASE("degenerate figures give candidates without a crash") {
  const auto everything = [](int, int) { return true; };
  for (const CandidateMethod method : kAllMethods) {
    const CandidateOptions options{.method = method};
    CHECK(extractCandidates(drawn(0, 0, everything), options).maxima.empty());
    CHECK(extractCandidates(drawn(1, 1, everything), options).kept.size() == 1);
    CHECK(extractCandidates(drawn(128, 128, [](int, int) { return false; }), options).maxima.empty());
    CHECK(extractCandidates(drawn(30, 1, everything), options).distance.maxCoeff() == 1);
    CHECK(uncoveredShare(extractCandidates(drawn(0, 0, everything), options)) == 0);
    const auto ring = [](int x, int y) { return std::abs(std::hypot(x - 20, y - 20) - 15) < 3; };
    CHECK(extractCandidates(drawn(41, 41, ring), options).distance.maxCoeff() < 5);
  }
}
