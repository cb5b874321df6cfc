#include "libskel/recognition/facing_net.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "embedded/facing_net_weights.h"
#include "libskel/core/json.h"
#include "libskel/core/net_format.h"

namespace skel {
namespace {

constexpr const char* kFacingFormat = "skel-facing-net";
constexpr int kFacingVersion = 1;

std::vector<std::string> sidedNames() { return {kSidedInputs.begin(), kSidedInputs.end()}; }

std::vector<std::string> turnNames() {
  std::vector<std::string> names;
  for (const std::string_view name : kSidedInputs) names.push_back("|" + std::string(name) + "|");
  names.insert(names.end(), kUnsidedInputs.begin(), kUnsidedInputs.end());
  return names;
}

}  // namespace

Eigen::VectorXd turnInputs(const FacingEvidence& evidence) {
  Eigen::VectorXd inputs(evidence.sided.size() + evidence.unsided.size());
  inputs << evidence.sided.cwiseAbs(), evidence.unsided;
  return inputs;
}

Facing FacingNet::of(const FacingEvidence& evidence) const {
  const double odds = (right.logOdds(evidence.sided) - right.logOdds(-evidence.sided)) / 2,
               looks = odds >= 0 ? 1 : -1, sure = 1 / (1 + std::exp(-std::abs(odds)));
  const Eigen::VectorXd turn = turnInputs(evidence);
  const double quarter = side.probability(turn) >= .5 ? 1 : turned.probability(turn) >= .5 ? .5 : 0;
  return {looks * quarter * std::numbers::pi / 2, looks, sure};
}

FacingNet parseFacingNet(std::string_view text, const std::string& file) {
  checkNetFormat(text, file, kFacingFormat);
  const JsonDocument document = JsonDocument::parse(text, file);
  const JsonValue root = document.root();
  root.checkFormat(kFacingFormat, kFacingVersion);
  root.allowOnly({"format", "version", "provenance", "right", "turned", "side"});
  return {logisticNetAt(root.at("right"), sidedNames()), logisticNetAt(root.at("turned"), turnNames()),
          logisticNetAt(root.at("side"), turnNames()), root.at("provenance").asString()};
}

std::string formatFacingNet(const FacingNet& net) {
  return "{\n  \"format\": \"" + std::string(kFacingFormat) +
         "\",\n  \"version\": " + std::to_string(kFacingVersion) +
         ",\n  \"provenance\": " + nlohmann::json(net.provenance).dump() +
         ",\n  \"right\": " + formatLogisticNet(net.right, sidedNames()) +
         ",\n  \"turned\": " + formatLogisticNet(net.turned, turnNames()) +
         ",\n  \"side\": " + formatLogisticNet(net.side, turnNames()) + "\n}\n";
}

const FacingNet& builtInFacingNet() {
  static const FacingNet net =
      parseFacingNet(embedded::facing_net_weights, "weights/facing_net.json (built in)");
  return net;
}

}  // namespace skel
