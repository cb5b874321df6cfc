// Weights files of the joint net.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/json.h"
#include "libskel/core/net_format.h"
#include "libskel/core/sha256.h"
#include "libskel/jointnet/joint_net.h"

namespace skel {
namespace {

constexpr std::string_view kFormat = "skel-joint-net";
constexpr int kVersion = 3;

std::vector<std::string> jointsAt(const JsonValue& list) {
  const std::vector<JsonValue> items = list.items();
  if (items.empty() || items.size() > kMaxNetJoints)
    list.fail("has " + std::to_string(items.size()) + " joints, must have 1 to " +
              std::to_string(kMaxNetJoints));
  std::vector<std::string> joints;
  for (const JsonValue& item : items) {
    joints.push_back(item.asString());
    if (std::count(joints.begin(), joints.end(), joints.back()) > 1)
      item.fail("is the second joint named \"" + joints.back() + "\"");
  }
  return joints;
}

std::vector<BoneLength> bonesAt(const JsonValue& list, std::size_t joints) {
  std::vector<BoneLength> bones;
  for (const JsonValue& item : list.items()) {
    const std::vector<double> n = item.asNumbers(4);
    if (n[1] < 0 || n[3] < 0) item.fail("has a deviation below 0");
    bones.push_back({n[0], n[1], n[2], n[3]});
  }
  if (!bones.empty() && bones.size() != joints)
    list.fail("has " + std::to_string(bones.size()) + " entries for " + std::to_string(joints) + " joints");
  return bones;
}

}  // namespace

std::string formatJointNet(const JointNet& net) {
  const std::string payload = formatWeights(net);
  auto bones = nlohmann::json::array();
  for (const BoneLength& b : net.bones)
    bones.push_back({b.mean, b.deviation, b.ratio_mean, b.ratio_deviation});
  const nlohmann::ordered_json header = {{"format", kFormat},
                                         {"version", kVersion},
                                         {"provenance", net.provenance},
                                         {"body_plan", net.body_plan},
                                         {"joints", net.joints},
                                         {"bones", bones},
                                         {"hourglasses", net.hourglasses},
                                         {"convolutions", convolutionSizes(net)},
                                         {"sha256", sha256(payload)}};
  return header.dump() + "\n" + payload;
}

JointNet parseJointNet(std::string_view bytes, const std::string& file, bool check_hash) {
  checkNetFormat(bytes, file, kFormat);
  const std::size_t end = bytes.find('\n');
  if (end == std::string_view::npos) throw InputError(file, "not a joint net: it has no header line");
  const JsonDocument document = JsonDocument::parse(bytes.substr(0, end), file);
  const JsonValue root = document.root();
  const int version = root.checkFormat(kFormat, kVersion);
  if (version == 1)
    root.allowOnly({"format", "version", "provenance", "joints", "convolutions", "sha256"});
  else if (version == 2)
    root.allowOnly({"format", "version", "provenance", "body_plan", "joints", "convolutions", "sha256"});
  else
    root.allowOnly({"format", "version", "provenance", "body_plan", "joints", "bones", "hourglasses",
                    "convolutions", "sha256"});

  const std::vector<JsonValue> given = root.at("convolutions").items();
  int inputs = kNetInputChannels;
  for (const int former : {kCoarseInputChannels, kColourlessInputChannels})
    if (!given.empty() && given[0].asNumbers(3)[0] == former) inputs = former;
  JointNet net =
      makeJointNet(version > 1 ? root.at("body_plan").asString() : "biped", jointsAt(root.at("joints")),
                   version > 2 ? root.at("hourglasses").asInt(1, kMaxHourglasses) : 1, inputs);
  net.provenance = root.at("provenance").asString();
  if (version > 2) net.bones = bonesAt(root.at("bones"), net.joints.size());
  parseWeights(bytes.substr(end + 1), root, file, net, check_hash);
  return net;
}

JointNets::JointNets(std::vector<File> files) {
  for (File& file : files) {
    entries_.push_back(std::make_unique<Entry>());
    entries_.back()->file = std::move(file);
  }
}

std::vector<std::string_view> JointNets::bodyPlans() const {
  std::vector<std::string_view> names;
  for (const auto& entry : entries_) names.push_back(entry->file.body_plan);
  return names;
}

JointNets::Entry* JointNets::find(std::string_view body_plan) const {
  const auto at = std::find_if(entries_.begin(), entries_.end(),
                               [&](const auto& entry) { return entry->file.body_plan == body_plan; });
  return at == entries_.end() ? nullptr : at->get();
}

bool JointNets::has(std::string_view body_plan) const { return find(body_plan); }

const JointNet& JointNets::of(std::string_view body_plan) const {
  Entry* entry = find(body_plan);
  SKEL_CHECK(entry);
  std::call_once(entry->once, [&] {
    entry->net = readyToRun(parseJointNet(entry->file.bytes, entry->file.name, entry->file.check_hash));
  });
  return entry->net;
}

}  // namespace skel
