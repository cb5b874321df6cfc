// How good the weights that skel brings along are, on characters that no net has seen. The floors lie a
// little below what was measured.
#include <cstdlib>
#include <iostream>

#include "libskel/classifier/weights_file.h"
#include "tests/support/catch.h"
#include "trainer/evaluation.h"

using namespace skel;

namespace {

const std::string kCharacters = std::string(SKEL_SOURCE_DIR) + "/datasets/characters";

}  // namespace

TEST_CASE("the labelled set has no inconsistency") { CHECK(checkLabelFolder(kCharacters).empty()); }

TEST_CASE("the built-in weights come from the labelled set and are as good as their file says") {
  const LabelledSet set = readLabelledSet(kCharacters);
  const WeightsProvenance& from = defaultWeights().provenance;
  CHECK(from.data_sha256 == set.sha256);
  CHECK(from.samples == set.sampleCount());
  CHECK(from.accuracy > 0.845);
  CHECK(evaluateOn(defaultMlp(), pointersTo(set.characters)).accuracy() > 0.845);
}

TEST_CASE("the built-in weights know the classes on real drawings") {
  const char* dir = std::getenv("SKEL_EVAL_DIR");
  if (!dir) {
    std::cout << "SKIPPED: SKEL_EVAL_DIR is not set\n";
    return;
  }
  const LabelledSet set = labelAnnotatedImages(std::string(dir) + "/characters");
  const Evaluation evaluation = evaluateOn(defaultMlp(), pointersTo(set.characters));
  CHECK(evaluation.accuracy() > 0.80);
  CHECK(evaluation.balancedAccuracy() > 0.735);
}
