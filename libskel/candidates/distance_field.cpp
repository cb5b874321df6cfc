// Exact Euclidean distance transform in linear time.
// P. Felzenszwalb, D. Huttenlocher, "Distance Transforms of Sampled Functions" (2012): the lower envelope of
// parabolas, for each row; along a column, where all is inside or outside, by two passes.
#include <algorithm>
#include <vector>

#include "libskel/candidates/candidates.h"

namespace skel {
namespace {

constexpr float kFar = 1e12f;

// result[q] = min over p of (q − p)² + heights[p].
class LowerEnvelope {
 public:
  explicit LowerEnvelope(size_t length) : roots_(length), starts_(length + 1) {}

  void transform(const std::vector<float>& heights, std::vector<float>& result) {
    const int length = static_cast<int>(heights.size());
    int last = 0;
    roots_[0] = 0;
    starts_[0] = -kFar;
    starts_[1] = kFar;
    for (int q = 1; q < length; ++q) {
      float start = meeting(heights, q, roots_[last]);
      while (start <= starts_[last]) start = meeting(heights, q, roots_[--last]);
      roots_[++last] = q;
      starts_[last] = start;
      starts_[last + 1] = kFar;
    }
    int k = 0;
    for (int q = 0; q < length; ++q) {
      while (starts_[k + 1] < static_cast<float>(q)) ++k;
      const float d = static_cast<float>(q - roots_[k]);
      result[q] = d * d + heights[roots_[k]];
    }
  }

 private:
  // Where the parabolas rooted at p < q meet. Heights and squares are whole numbers, exact in double.
  static float meeting(const std::vector<float>& heights, int q, int p) {
    const double fq = heights[q] + double{1} * q * q, fp = heights[p] + double{1} * p * p;
    return static_cast<float>((fq - fp) / (2.0 * (q - p)));
  }

  std::vector<int> roots_;
  std::vector<float> starts_;
};

}  // namespace

DistanceField distanceField(const Plane8& mask) {
  // A frame of one outside pixel all around, since the outside of the array counts as outside.
  const Eigen::Index height = mask.rows() + 2, width = mask.cols() + 2;
  DistanceField squared = DistanceField::Zero(height, width);
  auto inner = squared.block(1, 1, mask.rows(), mask.cols());
  for (Eigen::Index y = 0; y < mask.rows(); ++y)
    inner.row(y) = (mask.row(y) > 0).select(squared.row(y).segment(1, mask.cols()) + 1, 0.0f);
  for (Eigen::Index y = mask.rows(); y-- > 0;)
    inner.row(y) = inner.row(y).min(squared.row(y + 2).segment(1, mask.cols()) + 1);
  squared = squared.square();

  std::vector<float> line(static_cast<size_t>(width)), result(static_cast<size_t>(width));
  LowerEnvelope rows(static_cast<size_t>(width));
  for (Eigen::Index y = 0; y < height; ++y) {
    for (Eigen::Index x = 0; x < width; ++x) line[x] = squared(y, x);
    rows.transform(line, result);
    for (Eigen::Index x = 0; x < width; ++x) squared(y, x) = result[x];
  }
  return squared.block(1, 1, mask.rows(), mask.cols()).sqrt();
}

}  // namespace skel
