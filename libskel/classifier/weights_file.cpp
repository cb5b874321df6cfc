#include "libskel/classifier/weights_file.h"

#include <climits>
#include <locale>
#include <nlohmann/json.hpp>
#include <sstream>

#include "embedded/default_weights.h"
#include "libskel/core/check.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/core/net_format.h"
#include "libskel/core/number_chars.h"

namespace skel {
namespace {

constexpr const char* kFormat = "skel-weights";
// The only normalisation that features() knows, spelt out for other readers of the file.
constexpr const char* kNormalization = "min-max over all maxima of the image";
constexpr int kMaxLayers = 16;
constexpr int kMaxUnits = 1024;

std::vector<int> readSizes(const JsonValue& layers) {
  std::vector<int> sizes;
  for (const JsonValue& size : layers.items()) sizes.push_back(size.asInt(1, kMaxUnits));
  if (sizes.size() < 2 || sizes.size() > kMaxLayers)
    layers.fail("has " + std::to_string(sizes.size()) + " sizes, must have 2 to " +
                std::to_string(kMaxLayers));
  if (sizes.front() != 3) layers.items().front().fail("must be 3: x, y and radius of a candidate");
  if (sizes.back() != 2) layers.items().back().fail("must be 2: the two bits of the class");
  return sizes;
}

std::vector<JsonValue> itemsOf(const JsonValue& list, std::size_t count, const char* what) {
  const auto items = list.items();
  if (items.size() != count)
    list.fail("has " + std::to_string(items.size()) + " " + what + ", must have " + std::to_string(count) +
              " by \"layers\"");
  return items;
}

float readWeight(const JsonValue& value) {
  return static_cast<float>(value.asNumber(-kMaxWeight, kMaxWeight));
}

Mlp readNet(const JsonValue& root) {
  const std::vector<int> sizes = readSizes(root.at("layers"));
  const auto weights = itemsOf(root.at("weights"), sizes.size() - 1, "layers");
  const auto biases = itemsOf(root.at("biases"), sizes.size() - 1, "layers");
  Mlp mlp;
  for (std::size_t l = 0; l + 1 < sizes.size(); ++l) {
    MlpLayer layer{Eigen::MatrixXf(sizes[l + 1], sizes[l]), Eigen::VectorXf(sizes[l + 1])};
    const auto rows = itemsOf(weights[l], static_cast<std::size_t>(sizes[l + 1]), "rows");
    const auto bias = itemsOf(biases[l], static_cast<std::size_t>(sizes[l + 1]), "numbers");
    for (int j = 0; j < sizes[l + 1]; ++j) {
      const auto row =
          itemsOf(rows[static_cast<std::size_t>(j)], static_cast<std::size_t>(sizes[l]), "numbers");
      for (int i = 0; i < sizes[l]; ++i) layer.weights(j, i) = readWeight(row[static_cast<std::size_t>(i)]);
      layer.biases[j] = readWeight(bias[static_cast<std::size_t>(j)]);
    }
    mlp.layers.push_back(std::move(layer));
  }
  return mlp;
}

void checkClasses(const JsonValue& classes) {
  classes.allowOnly({kJointClassNames[0], kJointClassNames[1], kJointClassNames[2], kJointClassNames[3]});
  for (int c = 0; c < kJointClassCount; ++c) {
    const JsonValue code = classes.at(kJointClassNames[c]);
    const auto bits = code.asNumbers(2);
    if (bits[0] != kJointClassCodes[c][0] || bits[1] != kJointClassCodes[c][1])
      code.fail("must be [" + std::to_string(kJointClassCodes[c][0]) + ", " +
                std::to_string(kJointClassCodes[c][1]) + "]: other codes are not known to this program");
  }
}

WeightsProvenance readProvenance(const JsonValue& value) {
  value.allowOnly({"data_sha256", "samples", "characters", "seed", "options", "epochs", "accuracy"});
  WeightsProvenance provenance;
  const JsonValue hash = value.at("data_sha256");
  provenance.data_sha256 = hash.asString();
  if (provenance.data_sha256.size() != 64 ||
      provenance.data_sha256.find_first_not_of("0123456789abcdef") != std::string::npos)
    hash.fail("must be 64 hexadecimal digits");
  provenance.samples = value.at("samples").asInt(0, INT_MAX);
  provenance.characters = value.at("characters").asInt(0, INT_MAX);
  provenance.seed = value.at("seed").asInt(0, INT_MAX);
  provenance.options = value.at("options").asString();
  provenance.epochs = value.at("epochs").asInt(0, INT_MAX);
  provenance.accuracy = value.at("accuracy").asNumber(0, 1);
  return provenance;
}

// The shortest text that reads back as the same float.
std::string show(float number) {
  char text[32];
  // A JSON reader takes -0 for 0.
  const auto end = shortestChars(text, text + sizeof text, number == 0 ? 0 : number);
  return std::string(text, end);
}

}  // namespace

WeightsFile parseWeights(std::string_view text, const std::string& file) {
  checkNetFormat(text, file, kFormat);
  const JsonDocument document = JsonDocument::parse(text, file);
  const JsonValue root = document.root();
  root.checkFormat(kFormat, kWeightsVersion);
  root.allowOnly(
      {"format", "version", "layers", "weights", "biases", "classes", "normalization", "provenance"});
  const JsonValue normalization = root.at("normalization");
  if (normalization.asString() != kNormalization)
    normalization.fail("must be \"" + std::string(kNormalization) +
                       "\", nothing else is known to this program");
  checkClasses(root.at("classes"));
  return {readNet(root), readProvenance(root.at("provenance"))};
}

WeightsFile readWeights(const std::string& path) { return parseWeights(readFile(path), path); }

std::string formatWeights(const WeightsFile& weights) {
  const auto& layers = weights.mlp.layers;
  for (const MlpLayer& layer : layers) SKEL_CHECK(layer.weights.allFinite() && layer.biases.allFinite());
  std::ostringstream out;
  out.exceptions(std::ios::badbit);  // else it swallows the end where memory ends
  out.imbue(std::locale::classic());
  const auto list = [&](const auto& numbers) {
    for (Eigen::Index i = 0; i < numbers.size(); ++i) out << (i ? ", " : "[") << show(numbers(i));
    out << "]";
  };
  out << "{\n  \"format\": \"" << kFormat << "\",\n  \"version\": " << kWeightsVersion
      << ",\n  \"layers\": [";
  const auto sizes = weights.mlp.sizes();
  for (std::size_t l = 0; l < sizes.size(); ++l) out << (l ? ", " : "") << sizes[l];
  out << "],\n  \"weights\": [\n";
  for (std::size_t l = 0; l < layers.size(); ++l) {
    for (Eigen::Index j = 0; j < layers[l].weights.rows(); ++j) {
      out << (j ? ",\n     " : "    [");
      list(layers[l].weights.row(j));
    }
    out << (l + 1 < layers.size() ? "],\n" : "]\n");
  }
  out << "  ],\n  \"biases\": [\n";
  for (std::size_t l = 0; l < layers.size(); ++l) {
    out << "    ";
    list(layers[l].biases);
    out << (l + 1 < layers.size() ? ",\n" : "\n");
  }
  out << "  ],\n  \"classes\": {";
  for (int c = 0; c < kJointClassCount; ++c)
    out << (c ? ", " : "") << "\"" << kJointClassNames[c] << "\": [" << kJointClassCodes[c][0] << ", "
        << kJointClassCodes[c][1] << "]";
  const WeightsProvenance& from = weights.provenance;
  out << "},\n  \"normalization\": \"" << kNormalization
      << "\",\n  \"provenance\": {\n    \"data_sha256\": " << nlohmann::json(from.data_sha256).dump()
      << ",\n    \"samples\": " << from.samples << ",\n    \"characters\": " << from.characters
      << ",\n    \"seed\": " << from.seed << ",\n    \"options\": " << nlohmann::json(from.options).dump()
      << ",\n    \"epochs\": " << from.epochs
      << ",\n    \"accuracy\": " << nlohmann::json(from.accuracy).dump() << "\n  }\n}\n";
  return out.str();
}

const WeightsFile& defaultWeights() {
  static const WeightsFile weights =
      parseWeights(embedded::default_weights, "weights/default.json (built in)");
  return weights;
}

}  // namespace skel
