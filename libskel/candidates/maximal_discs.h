// Centres of maximal discs, the discrete medial axis.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/candidates/candidates.h"

namespace skel {

// Pixels whose disc {q : |q − p| < D(p)} lies in the disc of no pixel of their 5×5 neighbourhood, by rows.
// Each disc of the figure lies in the disc of one of these: follow the containing discs, which grow, to the
// last.
std::vector<Eigen::Array2i> maximalDiscs(const DistanceField& distance);  // (x, y)

}  // namespace skel
