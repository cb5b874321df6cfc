// A picture without its noise: the high frequencies are taken out of its Fourier transform.
#pragma once

#include <Eigen/Core>

namespace skel {

using FloatPlane = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// `cutoff`: the frequency that is halved, as a share of the highest there is (0.5 a px), in (0, 1]; the
// filter is Gaussian, so that edges do not ring. The plane is continued by mirroring, as far as the filter
// reaches.
FloatPlane lowPass(const FloatPlane& plane, double cutoff);

}  // namespace skel
