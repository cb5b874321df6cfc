// Weights files of the joint net.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
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

static_assert(std::endian::native == std::endian::little, "weights files are read and written as they lie");

constexpr std::string_view kFormat = "skel-joint-net";
constexpr int kVersion = 2;

// [inputs, outputs, kernel] of each convolution: what the bytes are laid out by.
std::vector<std::array<int, 3>> convolutions(const JointNet& net) {
  std::vector<std::array<int, 3>> list;
  for (const JointNetLayer& layer : net.layers) {
    if (layer.kind != JointNetLayer::Kind::kConvolution) continue;
    list.push_back({net.maps[layer.input].channels, layer.channels, layer.kernel});
  }
  return list;
}

// The output channel that weight i of a layer goes to: weightIndex(), read backwards.
std::size_t outputOf(const JointNet& net, const JointNetLayer& layer, std::size_t i) {
  const ConvShape shape = convShape(net, layer);
  const auto panel = static_cast<std::size_t>(shape.taps() * shape.in_channels) * 16;
  return i / panel * 16 + i % 16;
}

std::size_t weightCount(const JointNetLayer& layer) { return layer.biases - layer.weights; }

std::vector<float> outputScales(const JointNet& net, const JointNetLayer& layer) {
  std::vector<float> scales(layer.channels, 0.f);
  for (std::size_t i = 0; i < weightCount(layer); ++i) {
    float& s = scales[outputOf(net, layer, i)];
    s = std::max(s, std::abs(net.parameters[layer.weights + i]) / 127);
  }
  return scales;
}

std::int8_t rounded(float weight, float scale) {
  if (scale == 0) return 0;
  return static_cast<std::int8_t>(std::clamp(std::lround(weight / scale), -127l, 127l));
}

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

JointNet quantized(const JointNet& net) {
  JointNet out = net;
  for (const JointNetLayer& layer : net.layers) {
    if (layer.kind != JointNetLayer::Kind::kConvolution) continue;
    const std::vector<float> scales = outputScales(net, layer);
    for (std::size_t i = 0; i < weightCount(layer); ++i) {
      float& w = out.parameters[layer.weights + i];
      w = static_cast<float>(rounded(w, scales[outputOf(net, layer, i)])) * scales[outputOf(net, layer, i)];
    }
  }
  return out;
}

std::string formatJointNet(const JointNet& net) {
  std::string payload;
  const auto append = [&](const void* data, std::size_t size) {
    payload.append(static_cast<const char*>(data), size);
  };
  for (const JointNetLayer& layer : net.layers) {
    if (layer.kind != JointNetLayer::Kind::kConvolution) continue;
    const std::vector<float> scales = outputScales(net, layer);
    append(scales.data(), scales.size() * sizeof(float));
    append(net.parameters.data() + layer.biases, layer.channels * sizeof(float));
    for (std::size_t i = 0; i < weightCount(layer); ++i) {
      const std::int8_t w = rounded(net.parameters[layer.weights + i], scales[outputOf(net, layer, i)]);
      append(&w, 1);
    }
  }
  const nlohmann::ordered_json header = {
      {"format", kFormat},          {"version", kVersion},  {"provenance", net.provenance},
      {"body_plan", net.body_plan}, {"joints", net.joints}, {"convolutions", convolutions(net)},
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
  const auto expected = convolutions(net);
  bool same = given.size() == expected.size();
  for (std::size_t i = 0; same && i < given.size(); ++i) {
    const std::vector<double> sizes = given[i].asNumbers(3);
    same = std::equal(sizes.begin(), sizes.end(), expected[i].begin());
  }
  if (!same) root.at("convolutions").fail("not the layers of this program's net: train it anew");

  const std::string_view payload = bytes.substr(end + 1);
  std::size_t size = 0;
  for (const JointNetLayer& layer : net.layers) {
    if (layer.kind == JointNetLayer::Kind::kConvolution) {
      size += weightCount(layer) + 2 * sizeof(float) * static_cast<std::size_t>(layer.channels);
    }
  }
  if (payload.size() != size) {
    throw InputError(file, "has " + std::to_string(payload.size()) + " bytes of weights, expected " +
                               std::to_string(size) + ": the file is cut off or damaged");
  }
  if (sha256(payload) != root.at("sha256").asString()) {
    throw InputError(file, "its weights do not fit its sha256: the file is damaged");
  }
  const char* at = payload.data();
  const auto take = [&](void* to, std::size_t bytes_wanted) {
    std::memcpy(to, at, bytes_wanted);
    at += bytes_wanted;
  };
  for (const JointNetLayer& layer : net.layers) {
    if (layer.kind != JointNetLayer::Kind::kConvolution) continue;
    std::vector<float> scales(layer.channels);
    take(scales.data(), scales.size() * sizeof(float));
    take(net.parameters.data() + layer.biases, layer.channels * sizeof(float));
    std::vector<std::int8_t> weights(weightCount(layer));
    take(weights.data(), weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      net.parameters[layer.weights + i] = static_cast<float>(weights[i]) * scales[outputOf(net, layer, i)];
    }
  }
  for (const float p : net.parameters) {
    if (!std::isfinite(p)) throw InputError(file, "holds weights that are no numbers");
  }
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
