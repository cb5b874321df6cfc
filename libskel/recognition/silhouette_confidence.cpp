#include "libskel/recognition/silhouette_confidence.h"

#include <algorithm>
#include <utility>

#include "embedded/silhouette_confidence_weights.h"

namespace skel {
namespace {

constexpr const char* kMaskFormat = "skel-silhouette-confidence";

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

std::optional<std::string> enclosedDoubt(const Silhouette& silhouette) {
  constexpr double kMuch = .04;  // of the figure
  if (!silhouette.enclosed || silhouette.enclosed->share <= kMuch) return std::nullopt;
  return "what its lines enclose may be ground (" + placeIn(silhouette.grid, silhouette.enclosed->box) + ")";
}

}  // namespace

double SilhouetteConfidence::of(const MaskEvidence& evidence) const {
  return net.probability(evidence.inputs);
}

std::optional<std::string> silhouetteDoubt(const Silhouette& silhouette,
                                           const SilhouetteConfidence& confidence) {
  if (silhouette.is_sheet) return std::nullopt;
  if (!silhouette.evidence || confidence.of(*silhouette.evidence) >= kSureMask)
    return enclosedDoubt(silhouette);
  const MaskEvidence& evidence = *silhouette.evidence;
  const auto input = [&](std::string_view name) {
    return evidence.inputs[std::find(kMaskInputs.begin(), kMaskInputs.end(), name) - kMaskInputs.begin()];
  };
  if (evidence.doubtful && input("largest not seen") >= input("largest not taken"))
    return "something may be stuck to the figure (" + placeIn(silhouette.grid, *evidence.doubtful) + ")";
  if (evidence.missing && input("largest not taken") > input("largest not seen"))
    return "a part of the figure may be missing (" + placeIn(silhouette.grid, *evidence.missing) + ")";
  return "the outline of the figure may be wrong";
}

SilhouetteConfidence parseSilhouetteConfidence(std::string_view text, const std::string& file) {
  LogisticNetFile parsed = parseLogisticNetFile(text, file, kMaskFormat, maskInputs());
  return {std::move(parsed.net), std::move(parsed.provenance)};
}

std::string formatSilhouetteConfidence(const SilhouetteConfidence& confidence) {
  return formatLogisticNetFile({confidence.net, confidence.provenance}, kMaskFormat, maskInputs());
}

const SilhouetteConfidence& builtInSilhouetteConfidence() {
  static const SilhouetteConfidence confidence = parseSilhouetteConfidence(
      embedded::silhouette_confidence_weights, "weights/silhouette_confidence.json (built in)");
  return confidence;
}

}  // namespace skel
