#include "libskel/style/in_between.h"

#include "libskel/core/check.h"

namespace skel {

PoseMatrix inBetweens(const PoseMatrix& source, const std::vector<int>& keys, const PoseMatrix& key_poses,
                      bool loops) {
  using Eigen::Index;
  using Eigen::Vector2d;
  SKEL_CHECK(!keys.empty());
  SKEL_CHECK_EQ(Index(keys.size()), key_poses.cols());
  SKEL_CHECK_EQ(source.rows(), key_poses.rows());
  const int m = int(source.cols()), last = int(keys.size()) - 1;
  SKEL_CHECK(keys.front() >= 0 && keys.back() < m);
  PoseMatrix result(source.rows(), m);
  int before = loops ? last : 0, after = 0;  // keys around the frame
  for (int f = 0; f < m; ++f) {
    while (after <= last && keys[std::size_t(after)] < f) ++after;
    const bool beyond = after > last;
    if (after > 0) before = after - 1;
    const int a = beyond ? last : before, b = beyond ? (loops ? 0 : last) : after;
    const int from = keys[std::size_t(a)], to = keys[std::size_t(b)];
    const int span = (to - from + m) % m, passed = (f - from + m) % m;
    const double time = span > 0 ? double(passed) / span : 1;
    for (int j = 0; 2 * j < source.rows(); ++j) {
      const Vector2d p = jointOf(source, j, f);
      const Vector2d from_a = p - jointOf(source, j, from), from_b = p - jointOf(source, j, to);
      const double da = from_a.norm(), db = from_b.norm();
      double w = da + db > 1e-12 ? da / (da + db) : time;
      if (f == from) w = 0;
      if (f == to) w = 1;
      result.col(f).segment<2>(2 * j) =
          (1 - w) * (jointOf(key_poses, j, a) + from_a) + w * (jointOf(key_poses, j, b) + from_b);
    }
  }
  return result;
}

}  // namespace skel
