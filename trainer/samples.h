// What a net is trained on.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "libskel/classifier/block.h"
#include "libskel/labels/label_folder.h"

namespace skel {

struct Samples {
  Eigen::MatrixXf inputs;   // N×inputs
  Eigen::MatrixXf targets;  // N×outputs, 0 or 1
  Eigen::VectorXf weights;  // N, > 0: how much a sample counts

  Eigen::Index count() const { return inputs.rows(); }
};

// Samples in the layout that the net is computed in. The last block is filled up with samples of weight 0.
template <class Scalar>
struct SampleBlocks {
  explicit SampleBlocks(const Samples& samples);

  std::vector<Block<Scalar>> inputs, targets, weights;
  double total_weight = 0;
};
extern template struct SampleBlocks<float>;
extern template struct SampleBlocks<double>;

using Characters = std::vector<const LabelledCharacter*>;
Characters pointersTo(const std::vector<LabelledCharacter>& characters);

// Those of one picture are together: what is measured on one of them is not learned from the others. In the
// order of the first of each picture.
std::vector<Characters> byPicture(const Characters& characters);
Characters joined(const std::vector<Characters>& groups);

struct SampleOptions {
  bool mirror = true;  // add each character's mirror image
  // Add so many copies of each character with other proportions: x, y and radius each bent by up to `warp`.
  int warps = 2;
  double warp = 0.5;             // [0, 0.7]
  std::uint64_t seed = 1;        // of the bends
  bool balance_classes = false;  // let each class count the same in sum
};

// Rows of all characters, the targets by kJointClassCodes.
Samples samplesOf(const Characters& characters, const SampleOptions& options);

// The rows of both.
Samples joined(const Samples& first, const Samples& second);

}  // namespace skel
