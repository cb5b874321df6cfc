// Weights files of the joint net.
#include <algorithm>
#include <array>
#include <mutex>
#include <nlohmann/json.hpp>

#include "embedded/joint_net_weights.h"
#include "embedded/quadruped_joint_net_weights.h"
#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/json.h"
#include "libskel/core/sha256.h"
#include "libskel/jointnet/joint_net.h"

namespace skel {
namespace {

constexpr std::string_view kFormat = "skel-joint-net";
constexpr int kVersion = 2;

std::vector<std::string> jointsAt(const JsonValue& list) {
  std::vector<std::string> joints;
  for (const JsonValue& item : list.items()) {
    joints.push_back(item.asString());
    if (std::count(joints.begin(), joints.end(), joints.back()) > 1)
      item.fail("is the second joint named \"" + joints.back() + "\"");
  }
  if (joints.empty() || joints.size() > kMaxNetJoints)
    list.fail("has " + std::to_string(joints.size()) + " joints, must have 1 to " +
              std::to_string(kMaxNetJoints));
  return joints;
}

}  // namespace

std::string formatJointNet(const JointNet& net) {
  const std::string payload = formatWeights(net);
  const nlohmann::ordered_json header = {
      {"format", kFormat},          {"version", kVersion},  {"provenance", net.provenance},
      {"body_plan", net.body_plan}, {"joints", net.joints}, {"convolutions", convolutionSizes(net)},
      {"sha256", sha256(payload)}};
  return header.dump() + "\n" + payload;
}

JointNet parseJointNet(std::string_view bytes, const std::string& file) {
  const std::size_t end = bytes.find('\n');
  if (end == std::string_view::npos) throw InputError(file, "not a joint net: it has no header line");
  const JsonDocument document = JsonDocument::parse(bytes.substr(0, end), file);
  const JsonValue root = document.root();
  const bool names_plan = root.checkFormat(kFormat, kVersion) > 1;
  if (names_plan)
    root.allowOnly({"format", "version", "provenance", "body_plan", "joints", "convolutions", "sha256"});
  else
    root.allowOnly({"format", "version", "provenance", "joints", "convolutions", "sha256"});

  const std::vector<JsonValue> given = root.at("convolutions").items();
  int inputs = kNetInputChannels;
  for (const int former : {kCoarseInputChannels, kColourlessInputChannels})
    if (!given.empty() && given[0].asNumbers(3)[0] == former) inputs = former;
  JointNet net = makeJointNet(names_plan ? root.at("body_plan").asString() : "biped",
                              jointsAt(root.at("joints")), inputs);
  net.provenance = root.at("provenance").asString();
  parseWeights(bytes.substr(end + 1), root, file, net);
  return net;
}

namespace {

// What is compiled in, of each body plan.
constexpr std::string_view kBodyPlans[] = {"biped", "quadruped"};
const std::string_view* const kWeights[] = {&embedded::joint_net_weights,
                                            &embedded::quadruped_joint_net_weights};
static_assert(std::size(kBodyPlans) == std::size(kWeights));

}  // namespace

std::span<const std::string_view> builtInJointNets() { return kBodyPlans; }

const JointNet& builtInJointNet(std::string_view body_plan) {
  const auto at = static_cast<std::size_t>(
      std::find(std::begin(kBodyPlans), std::end(kBodyPlans), body_plan) - kBodyPlans);
  SKEL_CHECK(at < std::size(kBodyPlans));
  // Each is read when it is first asked for, since that takes time.
  static std::array<std::once_flag, std::size(kBodyPlans)> once;
  static std::array<JointNet, std::size(kBodyPlans)> nets;
  std::call_once(once[at], [at] {
    nets[at] = parseJointNet(*kWeights[at], "built-in joint net of the " + std::string(kBodyPlans[at]));
  });
  return nets[at];
}

}  // namespace skel
