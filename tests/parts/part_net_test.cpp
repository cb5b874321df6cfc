#include "libskel/layers/part_net.h"

#include <cmath>
#include <opencv2/core.hpp>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "tests/support/catch.h"
#include "trainer/conv_net_trainer.h"
#include "trainer/part_loss.h"
#include "trainer/part_truth.h"

namespace skel {
namespace {

PartNet randomNet() {
  PartNet net = makePartNet();
  Rng rng(1);
  initialise(net, rng);
  net.provenance = "random";
  return net;
}

std::string complaint(const std::string& bytes) {
  try {
    parsePartNet(bytes, "part.bin");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

PartSkeleton someSkeleton() {
  PartSkeleton s;
  s.head = {50, 15}, s.body = {50, 60};
  s.limbs = {{{{{35, 35}, {25, 55}, {20, 80}}},
              {{{65, 35}, {75, 55}, {80, 80}}},
              {{{42, 85}, {40, 115}, {38, 145}}},
              {{{58, 85}, {60, 115}, {62, 145}}}}};
  return s;
}

TEST_CASE("A part net's file gives back the rounded net, and damaged ones are refused with a reason") {
  using Catch::Matchers::Contains;
  PartNet net = randomNet();
  const std::string bytes = formatPartNet(net);
  const PartNet read = parsePartNet(bytes, "part.bin");
  quantize(net);
  CHECK(read.parameters == net.parameters);
  CHECK(read.provenance == "random");
  CHECK(formatPartNet(read) == bytes);
  CHECK_THAT(complaint(""), Contains("part.bin") && Contains("no header"));
  CHECK_THAT(complaint("{}\n"), Contains("format"));
  CHECK_THAT(complaint(bytes.substr(0, bytes.size() - 1)), Contains("cut off or damaged"));
  std::string flipped = bytes;
  flipped.back() = static_cast<char>(flipped.back() ^ 1);
  CHECK_THAT(complaint(flipped), Contains("sha256"));
}

TEST_CASE("The part net of weights/ fits its hash") {
  const std::string path = SKEL_SOURCE_DIR "/weights/part_net.bin";
  CHECK(parsePartNet(readFile(path), path).provenance.starts_with("skel-train average"));
}

TEST_CASE("The part net is shown nothing outside of the mask") {
  cv::Mat rgb(150, 100, CV_8UC3, cv::Scalar(10, 200, 90)), mask(150, 100, CV_8U, cv::Scalar(255));
  mask(cv::Rect(0, 0, 40, 150)).setTo(0);
  std::vector<float> input, other;
  encodeParts(rgb, mask, someSkeleton(), input);
  rgb(cv::Rect(0, 0, 40, 150)).setTo(cv::Scalar::all(255));
  encodeParts(rgb, mask, someSkeleton(), other);
  CHECK(input == other);
  CHECK(std::any_of(input.begin(), input.end(), [](float v) { return v != 0; }));
}

TEST_CASE(
    "The part loss has the derivative that its differences show, and px of no known part cost nothing") {
  Rng rng(2);
  cv::Mat part(60, 90, CV_8U);
  for (int y = 0; y < part.rows; ++y)
    for (int x = 0; x < part.cols; ++x)
      part.at<std::uint8_t>(y, x) = x > 30 ? static_cast<std::uint8_t>(rng.below(kPartCount)) : kNoPart;
  std::vector<float> logits(MapShape{kPartMapSize, kPartMapSize, kPartOutputChannels}.paddedSize());
  for (float& v : logits) v = static_cast<float>(rng.normal());
  const std::array<int, 4> before = {1, 0, -1, 1};
  std::vector<float> gradient(logits.size(), 0.f);
  CHECK(partLoss(logits, part, before, 1, &gradient) > 0);
  double squared = 0;
  for (const float g : gradient) squared += static_cast<double>(g) * g;
  const double h = 1e-2 / std::sqrt(squared);
  const auto at = [&](double step) {
    std::vector<float> moved = logits;
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += static_cast<float>(step * gradient[i]);
    return partLoss(moved, part, before, 0, nullptr);
  };
  CHECK((at(h) - at(-h)) / (2 * h) == Approx(squared).epsilon(1e-3));
  for (int k = 0; k <= kPartCount; ++k) CHECK(gradient[partLogitIndex(7, 11, k)] == 0);
  part.setTo(kNoPart);
  CHECK(partLoss(logits, part, before, 0, nullptr) == 0);
}

}  // namespace
}  // namespace skel
