// Weights files; what is read gives probabilities, and the same file again.
#include "libskel/classifier/weights_file.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  mayRefuse([&] {
    const WeightsFile weights = parseWeights(textOf(data, size), "fuzz");
    const ClassProbabilities classes = classify(weights.mlp, Features::Random(5, 3));
    require(classes.allFinite() && classes.minCoeff() >= 0, "probabilities are finite and not negative");
    const std::string text = formatWeights(weights);
    require(formatWeights(parseWeights(text, "again")) == text, "what is written is read as it was");
  });
  return 0;
}
