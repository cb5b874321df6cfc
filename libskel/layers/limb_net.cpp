#include "libskel/layers/limb_net.h"

#include <utility>
#include <vector>

#include "embedded/limb_net_weights.h"

namespace skel {
namespace {

constexpr const char* kLimbFormat = "skel-limb-net";

std::vector<std::string> limbInputs() { return {kLimbInputs.begin(), kLimbInputs.end()}; }

}  // namespace

double LimbNet::isLimb(const LimbEvidence& evidence) const {
  return evidence.area == 0 ? 0 : net.probability(evidence.inputs);
}

LimbNet parseLimbNet(std::string_view text, const std::string& file) {
  LogisticNetFile parsed = parseLogisticNetFile(text, file, kLimbFormat, limbInputs());
  return {std::move(parsed.net), std::move(parsed.provenance)};
}

std::string formatLimbNet(const LimbNet& net) {
  return formatLogisticNetFile({net.net, net.provenance}, kLimbFormat, limbInputs());
}

const LimbNet& builtInLimbNet() {
  static const LimbNet net = parseLimbNet(embedded::limb_net_weights, "weights/limb_net.json (built in)");
  return net;
}

}  // namespace skel
