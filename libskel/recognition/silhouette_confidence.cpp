#include "libskel/recognition/silhouette_confidence.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "embedded/silhouette_confidence_weights.h"
#include "libskel/core/json.h"
#include "libskel/core/logistic_net.h"
#include "libskel/core/net_format.h"

namespace skel {
namespace {

constexpr const char* kMaskFormat = "skel-silhouette-confidence";
constexpr int kMaskVersion = 1;

std::vector<std::string> maskInputs() { return {kMaskInputs.begin(), kMaskInputs.end()}; }

// In which ninth of the figure's box the middle of `box` lies: "upper left", "right", "middle".
std::string placeIn(const WorkingGrid& grid, const Eigen::Array4d& box) {
  const Eigen::Array2d size = Eigen::Array2d(grid.width, grid.height) / grid.scale;
  const Eigen::Array2d at = (box.head<2>() + box.tail<2>() / 2 - grid.corner_px.array()) / size;
  const auto third = [](double share) { return std::clamp(static_cast<int>(3 * share), 0, 2); };
  const int column = third(at.x()), row = third(at.y());
  std::string text = row == 0 ? "upper" : row == 2 ? "lower" : "";
  if (column != 1) text += (text.empty() ? "" : " ") + std::string(column == 0 ? "left" : "right");
  if (text.empty()) return "middle";
  return column == 1 ? text + " part" : text;
}

}  // namespace

double SilhouetteConfidence::of(const MaskEvidence& evidence) const {
  return net.probability(evidence.inputs);
}

std::optional<std::string> silhouetteDoubt(const Silhouette& silhouette,
                                           const SilhouetteConfidence& confidence) {
  if (!silhouette.evidence || silhouette.is_sheet || confidence.of(*silhouette.evidence) >= .5)
    return std::nullopt;
  const MaskEvidence& evidence = *silhouette.evidence;
  const auto input = [&](std::string_view name) {
    return evidence.inputs[std::find(kMaskInputs.begin(), kMaskInputs.end(), name) - kMaskInputs.begin()];
  };
  if (evidence.doubtful && input("largest not seen") >= input("largest not taken"))
    return "something may be stuck to the figure (" + placeIn(silhouette.grid, *evidence.doubtful) + ")";
  if (input("largest not taken") > input("largest not seen")) return "a part of the figure may be missing";
  return "the outline of the figure may be wrong";
}

SilhouetteConfidence parseSilhouetteConfidence(std::string_view text, const std::string& file) {
  checkNetFormat(text, file, kMaskFormat);
  const JsonDocument document = JsonDocument::parse(text, file);
  const JsonValue root = document.root();
  root.checkFormat(kMaskFormat, kMaskVersion);
  root.allowOnly({"format", "version", "provenance", "net"});
  return {logisticNetAt(root.at("net"), maskInputs()), root.at("provenance").asString()};
}

std::string formatSilhouetteConfidence(const SilhouetteConfidence& confidence) {
  return "{\n  \"format\": \"" + std::string(kMaskFormat) +
         "\",\n  \"version\": " + std::to_string(kMaskVersion) +
         ",\n  \"provenance\": " + nlohmann::json(confidence.provenance).dump() +
         ",\n  \"net\": " + formatLogisticNet(confidence.net, maskInputs()) + "\n}\n";
}

const SilhouetteConfidence& builtInSilhouetteConfidence() {
  static const SilhouetteConfidence confidence = parseSilhouetteConfidence(
      embedded::silhouette_confidence_weights, "weights/silhouette_confidence.json (built in)");
  return confidence;
}

}  // namespace skel
