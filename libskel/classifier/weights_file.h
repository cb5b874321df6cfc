// Weights files (format "skel-weights"): a trained net, and where it came from.
#pragma once

#include <string>
#include <string_view>

#include "libskel/classifier/mlp.h"

namespace skel {

// What must be the same to get the same bytes again, and how good the net is.
struct WeightsProvenance {
  std::string data_sha256;  // of the training data, see LabelledSet; 64 hexadecimal digits
  std::string options;      // the trainer's options that are not defaults; may be empty
  int seed = 0;
  int epochs = 0;       // that the kept weights took
  int samples = 0;      // labelled candidates that it was trained on, without mirror images
  int characters = 0;   // that they come from
  double accuracy = 0;  // [0, 1], on characters left out of training
};

struct WeightsFile {
  Mlp mlp;  // 3-…-2, every weight within ±kMaxWeight
  WeightsProvenance provenance;
};

inline constexpr double kMaxWeight = 1e6;
inline constexpr int kWeightsVersion = 1;

// Throws InputError that names file, JSON path and reason: another format, a newer version, weights that do
// not fit the layers, numbers that are not finite, other class codes or another normalisation than ours,
// unknown keys.
WeightsFile readWeights(const std::string& path);
// `file` is the name that complaints use.
WeightsFile parseWeights(std::string_view text, const std::string& file);
// The same weights give the same bytes.
std::string formatWeights(const WeightsFile& weights);

// weights/default.json, compiled in.
const WeightsFile& defaultWeights();
inline const Mlp& defaultMlp() { return defaultWeights().mlp; }
inline Mlp readMlp(const std::string& path) { return readWeights(path).mlp; }

}  // namespace skel
