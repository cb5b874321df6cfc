#include "trainer/samples.h"

#include <algorithm>

#include "libskel/core/rng.h"
#include "libskel/labels/twins.h"

namespace skel {

template <class Scalar>
SampleBlocks<Scalar>::SampleBlocks(const Samples& samples) {
  const auto blocksOf = [&](const Eigen::MatrixXf& rows) {
    std::vector<Block<Scalar>> blocks;
    for (Eigen::Index first = 0; first < rows.rows(); first += kBlockSize) {
      const Eigen::Index count = std::min<Eigen::Index>(kBlockSize, rows.rows() - first);
      blocks.push_back(Block<Scalar>::Zero(kBlockSize, rows.cols()));
      blocks.back().topRows(count) = rows.middleRows(first, count).cast<Scalar>().array();
    }
    return blocks;
  };
  inputs = blocksOf(samples.inputs);
  targets = blocksOf(samples.targets);
  weights = blocksOf(samples.weights);
  for (const float weight : samples.weights) total_weight += weight;
}
template struct SampleBlocks<float>;
template struct SampleBlocks<double>;

Characters pointersTo(const std::vector<LabelledCharacter>& characters) {
  Characters pointers;
  for (const LabelledCharacter& character : characters) pointers.push_back(&character);
  return pointers;
}

std::vector<Characters> byPicture(const Characters& characters) {
  std::vector<std::string> pictures;
  for (const LabelledCharacter* character : characters) pictures.push_back(character->image_sha256);
  std::vector<Characters> groups;
  for (const std::vector<std::size_t>& group : groupedByPicture(pictures)) {
    groups.emplace_back();
    for (const std::size_t i : group) groups.back().push_back(characters[i]);
  }
  return groups;
}

Characters joined(const std::vector<Characters>& groups) {
  Characters all;
  for (const Characters& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

namespace {

// A bent number line from 0 to 1, which keeps its ends and its order: t + a t (1 - t) + b t (1 - t) (1 - 2t).
class Bend {
 public:
  Bend(Rng& rng, double strength)
      : skew_(static_cast<float>(rng.uniform(-strength, strength))),
        spread_(static_cast<float>(rng.uniform(-strength, strength))) {}
  float operator()(float t) const { return t + t * (1 - t) * (skew_ + spread_ * (1 - 2 * t)); }

 private:
  float skew_, spread_;
};

Features warped(Features features, double strength, Rng& rng) {
  for (auto column : features.colwise()) {
    const Bend bend(rng, strength);
    for (float& value : column) value = bend(value);
  }
  return features;
}

// x is normalised within the image: its mirror image has 1 - x.
Features mirrored(Features features) {
  features.col(0) = (1 - features.col(0).array()).matrix();
  return features;
}

}  // namespace

Samples samplesOf(const Characters& characters, const SampleOptions& options) {
  std::array<Eigen::Index, kJointClassCount> class_counts{};
  Eigen::Index count = 0;
  for (const LabelledCharacter* character : characters)
    for (const JointClass label : character->labels) ++class_counts[static_cast<std::size_t>(label)], ++count;
  const Eigen::Index total = count * (1 + options.warps) * (options.mirror ? 2 : 1);
  Samples samples{Eigen::MatrixXf(total, 3), Eigen::MatrixXf(total, 2), Eigen::VectorXf::Ones(total)};
  Rng rng(options.seed, 2);
  Eigen::Index row = 0;
  const auto add = [&](const Features& features, const std::vector<JointClass>& labels) {
    samples.inputs.middleRows(row, features.rows()) = features;
    for (const JointClass label : labels) {
      const auto c = static_cast<std::size_t>(label);
      samples.targets.row(row) << static_cast<float>(kJointClassCodes[c][0]),
          static_cast<float>(kJointClassCodes[c][1]);
      if (options.balance_classes)
        samples.weights[row] =
            static_cast<float>(count) / static_cast<float>(kJointClassCount * class_counts[c]);
      ++row;
    }
  };
  for (const LabelledCharacter* character : characters)
    for (int copy = 0; copy <= options.warps; ++copy) {
      const Features features =
          copy == 0 ? character->features : warped(character->features, options.warp, rng);
      add(features, character->labels);
      if (options.mirror) add(mirrored(features), character->labels);
    }
  return samples;
}

Samples joined(const Samples& first, const Samples& second) {
  const Eigen::Index count = first.count() + second.count();
  Samples samples{Eigen::MatrixXf(count, 3), Eigen::MatrixXf(count, 2), Eigen::VectorXf(count)};
  samples.inputs << first.inputs, second.inputs;
  samples.targets << first.targets, second.targets;
  samples.weights << first.weights, second.weights;
  return samples;
}

}  // namespace skel
