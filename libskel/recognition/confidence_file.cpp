// Files of the confidence model.
#include <nlohmann/json.hpp>

#include "embedded/confidence_weights.h"
#include "libskel/core/json.h"
#include "libskel/core/logistic_net.h"
#include "libskel/core/net_format.h"
#include "libskel/recognition/confidence_model.h"

namespace skel {
namespace {

constexpr const char* kFormat = "skel-confidence";
constexpr int kVersion = 1;

std::vector<std::string> inputsOf(bool figure) {
  std::vector<std::string> names;
  if (!figure) return {kJointInputs.begin(), kJointInputs.end()};
  names.assign(kFigureInputs.begin(), kFigureInputs.end());
  names.insert(names.end(), kJointSummary.begin(), kJointSummary.end());
  return names;
}

}  // namespace

ConfidenceModel parseConfidenceModel(std::string_view text, const std::string& file) {
  checkNetFormat(text, file, kFormat);
  const JsonDocument document = JsonDocument::parse(text, file);
  const JsonValue root = document.root();
  root.checkFormat(kFormat, kVersion);
  root.allowOnly({"format", "version", "provenance", "joint", "figure"});
  ConfidenceModel model;
  model.provenance = root.at("provenance").asString();
  model.joint = logisticNetAt(root.at("joint"), inputsOf(false));
  model.figure = logisticNetAt(root.at("figure"), inputsOf(true));
  return model;
}

std::string formatConfidenceModel(const ConfidenceModel& model) {
  return "{\n  \"format\": \"" + std::string(kFormat) + "\",\n  \"version\": " + std::to_string(kVersion) +
         ",\n  \"provenance\": " + nlohmann::json(model.provenance).dump() +
         ",\n  \"joint\": " + formatLogisticNet(model.joint, inputsOf(false)) +
         ",\n  \"figure\": " + formatLogisticNet(model.figure, inputsOf(true)) + "\n}\n";
}

const ConfidenceModel& builtInConfidenceModel() {
  static const ConfidenceModel model =
      parseConfidenceModel(embedded::confidence_weights, "weights/confidence.json (built in)");
  return model;
}

}  // namespace skel
