// The distance from a point to a straight line between two others.
#pragma once

#include <algorithm>

namespace skel {

// The point of the segment from a to b that is nearest to p. a and b may coincide. `Vector` is one of Eigen's
// of a fixed size, float or double.
template <class Vector>
Vector nearestOnSegment(const Vector& p, const Vector& a, const Vector& b) {
  using Scalar = typename Vector::Scalar;
  const Vector along = b - a;
  const Scalar length2 = along.squaredNorm();
  const Scalar t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, Scalar(0), Scalar(1)) : Scalar(0);
  return a + t * along;
}

template <class Vector>
typename Vector::Scalar distanceToSegment(const Vector& p, const Vector& a, const Vector& b) {
  return (nearestOnSegment(p, a, b) - p).norm();
}

}  // namespace skel
