// What skel-train goes on from and learns from beside drawings: checkpoints, tables of confidence, whose hand
// drew what.
#include "libskel/recognition/confidence_model.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/tiny_net.h"
#include "trainer/confidence_table.h"
#include "trainer/conv_net_trainer.h"
#include "trainer/hands.h"

namespace skel {
namespace {

void readCheckpoint(const std::string& bytes) {
  ConvNetTrainer trainer(tinyNet(), {.steps = 8, .batch = 4, .threads = 1});
  trainer.restore(bytes, "fuzz.checkpoint");
  const std::string written = trainer.checkpoint();
  ConvNetTrainer again(tinyNet(), {.steps = 8, .batch = 4, .threads = 1});
  again.restore(written, "again.checkpoint");
  require(again.checkpoint() == written, "what is written is read as it was");
  if (trainer.done()) return;
  const auto one = [](int, std::vector<float>& input) { std::fill(input.begin(), input.end(), 1.f); };
  const auto judge = [](int, const std::vector<float>&, std::vector<float>& gradient) {
    std::fill(gradient.begin(), gradient.end(), 1.f);
    return 0.;
  };
  trainer.step({one, judge});
}

void readTable(std::string_view text) {
  const std::vector<ConfidenceSample> samples = parseConfidenceTable(text, "fuzz.csv");
  const std::string written = formatConfidenceTable(samples);
  require(formatConfidenceTable(parseConfidenceTable(written, "again.csv")) == written,
          "what is written is read as it was");
  for (const ConfidenceSample& sample : samples) {
    const auto& counts = sample.evidence.counts;
    if (std::find(counts.begin(), counts.end(), true) == counts.end()) continue;
    const Confidences sure = confidencesOf(sample.evidence, builtInConfidenceModel());
    require(sure.figure >= 0 && sure.figure <= 1, "chances lie in [0, 1]");
  }
}

void readHandsOf(const std::string& file) {
  const Hands hands = readHands(file);
  std::vector<std::string> drawings{"nobody's"};
  for (const auto& [drawing, hand] : hands.of_drawing) drawings.push_back(drawing);
  for (const auto& [drawing, fold] : foldOfDrawing(drawings, hands, 3))
    require(fold >= 0 && fold < 3, "each drawing is in a fold");
}

}  // namespace
}  // namespace skel

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  const std::string bytes(textOf(data, size));
  mayRefuse([&] { readCheckpoint(bytes); });
  mayRefuse([&] { readTable(bytes); });
  mayRefuse([&] { readHandsOf(fileOf(bytes, "hands.json")); });
  return 0;
}
