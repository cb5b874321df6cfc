#include "trainer/conv_net_trainer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "libskel/core/error.h"
#include "libskel/core/json.h"
#include "libskel/core/parallel.h"

namespace skel {
namespace {

// Gradients of a batch are summed in so many lanes, image b in lane b modulo kLanes, then lane by lane: a
// fixed order, so that the bytes of the result do not depend on the number of threads.
constexpr int kLanes = 4;
constexpr double kGradientNorm = 1;  // longer ones are shortened
constexpr double kWarmUp = .03;      // share of the steps

constexpr const char* kCheckpointFormat = "skel-checkpoint";
constexpr int kCheckpointVersion = 1;

// What follows the line of JSON that says format and version; all of it where there is no such line, as
// before there were versions.
std::string_view stateIn(std::string_view bytes, const std::string& file) {
  if (!bytes.starts_with("{\"format\"")) return bytes;
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  const JsonDocument document = JsonDocument::parse(bytes.substr(0, end), file);
  document.root().checkFormat(kCheckpointFormat, kCheckpointVersion);
  document.root().allowOnly({"format", "version"});
  return bytes.substr(std::min(end + 1, bytes.size()));
}

}  // namespace

void initialise(ConvNet& net, Rng& rng) {
  for (std::size_t i = 0; i < net.layers.size(); ++i) {
    const ConvLayer& layer = net.layers[i];
    if (layer.kind != ConvLayer::Kind::kConvolution) continue;
    const ConvShape shape = convShape(net, layer);
    const bool last = i + 1 == net.layers.size();
    const double size =
        std::sqrt(2. / (shape.taps() * shape.in_channels)) * (layer.skip >= 0 ? .5 : 1) * (last ? .3 : 1);
    for (std::size_t k = layer.weights; k < layer.biases; ++k) {
      net.parameters[k] = static_cast<float>(size * rng.normal());
    }
  }
}

ConvNetTrainer::ConvNetTrainer(ConvNet first, const ConvNetSchedule& schedule)
    : net_(std::move(first)), schedule_(schedule), set_(bestInstructionSet()) {
  const std::size_t n = net_.parameters.size();
  state_.parameters = net_.parameters;
  state_.average = net_.parameters;
  state_.first_moment.assign(n, 0.f);
  state_.second_moment.assign(n, 0.f);
  for (int i = 0; i < kLanes; ++i) {
    maps_.emplace_back(net_);
    gradients_.emplace_back(net_);
  }
}

double ConvNetTrainer::step(const Lesson& lesson) {
  net_.parameters = state_.parameters;
  const std::vector<float> transposed = transposedWeights(net_);
  std::array<double, kLanes> losses{};
  parallelFor(kLanes, schedule_.threads, [&](std::size_t lane) {
    ConvNetMaps& maps = maps_[lane];
    ConvNetGradient& gradient = gradients_[lane];
    std::fill(gradient.parameters.begin(), gradient.parameters.end(), 0.f);
    for (int image = static_cast<int>(lane); image < schedule_.batch; image += kLanes) {
      lesson.show(image, maps.maps[0]);
      forward(net_, set_, maps);
      for (auto& map : gradient.maps) std::fill(map.begin(), map.end(), 0.f);
      losses[lane] += lesson.judge(image, maps.maps.back(), gradient.maps.back());
      backward(net_, set_, transposed, maps, gradient);
    }
  });
  adam();
  ++state_.step;
  double loss = 0;
  for (const double l : losses) loss += l / schedule_.batch;
  return loss;
}

double ConvNetTrainer::rate() const {
  const double t = static_cast<double>(state_.step) / schedule_.steps;
  if (t < kWarmUp) return schedule_.peak_rate * (t / kWarmUp + 1e-3);
  return schedule_.peak_rate * (.5 + .5 * std::cos(std::numbers::pi * (t - kWarmUp) / (1 - kWarmUp)) + 1e-3);
}

// Kingma & Ba, "Adam" (2015), with decoupled weight decay; and a running mean of the weights.
void ConvNetTrainer::adam() {
  std::vector<float>& sum = gradients_[0].parameters;
  double norm = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    for (int lane = 1; lane < kLanes; ++lane) sum[i] += gradients_[lane].parameters[i];
    norm += static_cast<double>(sum[i]) * sum[i];
  }
  norm = std::sqrt(norm);
  const auto shorten = static_cast<float>(norm > kGradientNorm ? kGradientNorm / norm : 1);
  constexpr float kBeta1 = .9f, kBeta2 = .99f;
  const double t = static_cast<double>(state_.step + 1);
  const auto unbias1 = static_cast<float>(1 / (1 - std::pow(kBeta1, t)));
  const auto unbias2 = static_cast<float>(1 / (1 - std::pow(kBeta2, t)));
  const auto r = static_cast<float>(rate()), decay = static_cast<float>(schedule_.weight_decay);
  // A young mean follows closely.
  const auto keep = static_cast<float>(std::min(schedule_.averaging, (1 + t) / (10 + t)));
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const float g = sum[i] * shorten;
    float& w = state_.parameters[i];
    float& m = state_.first_moment[i];
    float& v = state_.second_moment[i];
    m = kBeta1 * m + (1 - kBeta1) * g;
    v = kBeta2 * v + (1 - kBeta2) * g * g;
    w -= r * (m * unbias1 / (std::sqrt(v * unbias2) + 1e-8f) + decay * w);
    state_.average[i] = keep * state_.average[i] + (1 - keep) * w;
  }
}

std::string ConvNetTrainer::checkpoint() const {
  std::string out = std::string("{\"format\":\"") + kCheckpointFormat +
                    "\",\"version\":" + std::to_string(kCheckpointVersion) + "}\n";
  out.append(reinterpret_cast<const char*>(&state_.step), sizeof state_.step);
  for (const auto* v : {&state_.parameters, &state_.first_moment, &state_.second_moment, &state_.average}) {
    out.append(reinterpret_cast<const char*>(v->data()), v->size() * sizeof(float));
  }
  return out;
}

void ConvNetTrainer::restore(const std::string& file_bytes, const std::string& file) {
  const std::string_view bytes = stateIn(file_bytes, file);
  if (bytes.size() != sizeof state_.step + 4 * state_.parameters.size() * sizeof(float)) {
    throw InputError(file, "is no checkpoint of this net");
  }
  const char* at = bytes.data();
  std::memcpy(&state_.step, at, sizeof state_.step);
  at += sizeof state_.step;
  bool sound = state_.step >= 0;
  for (auto* v : {&state_.parameters, &state_.first_moment, &state_.second_moment, &state_.average}) {
    std::memcpy(v->data(), at, v->size() * sizeof(float));
    at += v->size() * sizeof(float);
    sound = sound && std::all_of(v->begin(), v->end(), [](float number) { return std::isfinite(number); });
  }
  const std::vector<float>& squares = state_.second_moment;
  sound = sound && std::none_of(squares.begin(), squares.end(), [](float square) { return square < 0; });
  if (!sound) throw InputError(file, "is a damaged checkpoint: remove it to start anew");
}

}  // namespace skel
