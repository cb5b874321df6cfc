#include "libskel/classifier/weights_file.h"

#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

const std::string kArchive = std::string(SKEL_SOURCE_DIR) + "/weights/archive";

// The complaint about a good file in which `from` is replaced by `to`.
std::string complaint(const std::string& from, const std::string& to) {
  std::string text = readFile(kArchive + "/version-1.json");
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  try {
    parseWeights(text, "w.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("weights come back to the last bit, and the same weights give the same bytes") {
  const std::string text = formatWeights(defaultWeights());
  CHECK(text == readFile(std::string(SKEL_SOURCE_DIR) + "/weights/default.json"));
  const WeightsFile again = parseWeights(text, "w.json");
  for (std::size_t l = 0; l < again.mlp.layers.size(); ++l) {
    CHECK(again.mlp.layers[l].weights == defaultMlp().layers[l].weights);
    CHECK(again.mlp.layers[l].biases == defaultMlp().layers[l].biases);
  }
  CHECK(again.provenance.data_sha256 == defaultWeights().provenance.data_sha256);
  CHECK(again.provenance.accuracy == defaultWeights().provenance.accuracy);
}

TEST_CASE("a weights file of every past version is still read") {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kArchive)) {
    if (entry.path().extension() != ".json") continue;
    CHECK(readMlp(entry.path()).sizes().front() == 3);
    ++count;
  }
  CHECK(count == kWeightsVersion);
}

TEST_CASE("a net of the wrong kind is named as such") {
  const std::string joint_net = SKEL_SOURCE_DIR "/weights/joint_net.bin";
  CHECK_THROWS_WITH(readMlp(joint_net), joint_net +
                                            ": is a net that finds joints (--joint-net); weights that tell "
                                            "candidates apart (--weights) was expected");
}

TEST_CASE("bad weights files are refused with file, path and reason") {
  CHECK(complaint("skel-weights", "skel-skeleton") ==
        "w.json: is a file of format \"skel-skeleton\", \"skel-weights\" was expected");
  CHECK(complaint("\"version\": 1", "\"version\": 2") ==
        "w.json: version: is 2, this program reads up to 1; use a newer skel");
  CHECK(complaint("[3, 4, 4, 2]", "[3, 5, 4, 2]") ==
        "w.json: weights[0]: has 4 rows, must have 5 by \"layers\"");
  CHECK(complaint("[3, 4, 4, 2]", "[3, 4, 2]") == "w.json: weights: has 3 layers, must have 2 by \"layers\"");
  CHECK(complaint("[3, 4, 4, 2]", "[2, 4, 4, 2]") ==
        "w.json: layers[0]: must be 3: x, y and radius of a candidate");
  CHECK(complaint("[3, 4, 4, 2]", "[3, 4, 4, 4]") ==
        "w.json: layers[3]: must be 2: the two bits of the class");
  CHECK(complaint("[3, 4, 4, 2]", "[3]") == "w.json: layers: has 1 sizes, must have 2 to 16");
  CHECK(complaint("[3, 4, 4, 2]", "[3, 0, 4, 2]") ==
        "w.json: layers[1]: is 0, must be a whole number between 1 and 1024");
  CHECK(complaint("9.940977", "null") == "w.json: weights[0][0][0]: must be a number");
  CHECK(complaint("9.940977", "1e30") ==
        "w.json: weights[0][0][0]: is 1e+30, must be between -1000000 and 1000000");
  CHECK(complaint("9.940977", "NaN").find("w.json: is not JSON") == 0);
  CHECK(complaint("9.940977, ", "") == "w.json: weights[0][0]: has 2 numbers, must have 3 by \"layers\"");
  CHECK(complaint("\"head\": [0, 0]", "\"head\": [1, 1]") ==
        "w.json: classes.head: must be [0, 0]: other codes are not known to this program");
  CHECK(complaint("\"head\"", "\"tail\"") == "w.json: classes: has the unknown key \"tail\"");
  CHECK(complaint("min-max", "z-score").find("w.json: normalization: must be \"min-max") == 0);
  CHECK(complaint("\"seed\"", "\"sead\"") == "w.json: provenance: has the unknown key \"sead\"");
  CHECK(complaint("\"layers\"", "\"layer\"") == "w.json: has the unknown key \"layer\"");
  CHECK(complaint("\"data_sha256\": \"", "\"data_sha256\": \"zz").find("must be 64 hexadecimal digits") !=
        std::string::npos);
  CHECK_THROWS_AS(readMlp("no/such/file.json"), InputError);
}
