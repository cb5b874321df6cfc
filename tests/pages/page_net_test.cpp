#include "libskel/silhouette/page_net.h"

#include <opencv2/core.hpp>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "tests/support/catch.h"
#include "trainer/conv_net_trainer.h"
#include "trainer/page_loss.h"

namespace skel {
namespace {

PageNet randomNet() {
  PageNet net = makePageNet();
  Rng rng(1);
  initialise(net, rng);
  net.provenance = "random";
  return net;
}

std::string complaint(const std::string& bytes) {
  try {
    parsePageNet(bytes, "page.bin");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST_CASE("A page net's file gives back the rounded net, and damaged ones are refused with a reason") {
  using Catch::Matchers::Contains;
  PageNet net = randomNet();
  const std::string bytes = formatPageNet(net);
  const PageNet read = parsePageNet(bytes, "page.bin");
  quantize(net);
  CHECK(read.parameters == net.parameters);
  CHECK(read.provenance == "random");
  CHECK(formatPageNet(read) == bytes);
  CHECK_THAT(complaint(""), Contains("page.bin") && Contains("no header"));
  CHECK_THAT(complaint("{}\n"), Contains("format"));
  CHECK_THAT(complaint(bytes.substr(0, bytes.size() - 1)), Contains("cut off or damaged"));
  std::string flipped = bytes;
  flipped.back() = static_cast<char>(flipped.back() ^ 1);
  CHECK_THAT(complaint(flipped), Contains("sha256"));
}

TEST_CASE("The page net that is compiled in is the file of weights/, which fits its hash") {
  const std::string path = SKEL_SOURCE_DIR "/weights/page_net.bin";
  CHECK(parsePageNet(readFile(path), path).parameters == builtInPageNet().parameters);
}

TEST_CASE("The page loss has the derivative that its differences show") {
  Rng rng(2);
  cv::Mat figure(60, 90, CV_8U);
  for (int y = 0; y < figure.rows; ++y)
    for (int x = 0; x < figure.cols; ++x)
      figure.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(x > 30 && y > 20 ? rng.below(256) : 0);
  std::vector<float> logits(MapShape{kPageMapSize, kPageMapSize, kPageOutputChannels}.paddedSize());
  for (float& v : logits) v = static_cast<float>(rng.normal());
  std::vector<float> gradient(logits.size(), 0.f);
  const double loss = pageLoss(logits, figure, 1, &gradient);
  CHECK(loss > 0);
  // Along the gradient, so that the difference stands out of the floats' rounding.
  double squared = 0;
  for (const float g : gradient) squared += static_cast<double>(g) * g;
  const double h = 1e-2 / std::sqrt(squared);
  const auto at = [&](double step) {
    std::vector<float> moved = logits;
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += static_cast<float>(step * gradient[i]);
    return pageLoss(moved, figure, 0, nullptr);
  };
  CHECK((at(h) - at(-h)) / (2 * h) == Approx(squared).epsilon(1e-3));
  // Nothing seen where nothing is costs nothing.
  std::fill(logits.begin(), logits.end(), -30.f);
  CHECK(pageLoss(logits, cv::Mat::zeros(60, 90, CV_8U), 0, nullptr) < 1e-6);
}

TEST_CASE("Pictures of any shape have a probability for each pixel") {
  const PageNet net = randomNet();
  for (const cv::Size size :
       {cv::Size(1, 1), cv::Size(3, 500), cv::Size(512, 2), cv::Size(191, 192), cv::Size(700, 300)}) {
    const cv::Mat p = figureProbability(net, cv::Mat(size, CV_8UC3, cv::Scalar(200, 180, 90)));
    CHECK(p.size() == size);
    double low = 0, high = 0;
    cv::minMaxLoc(p, &low, &high);
    CHECK(low >= 0);
    CHECK(high <= 1);
  }
}

TEST_CASE("A step on one page makes the net better at that page, whatever the number of threads") {
  cv::Mat rgb(100, 192, CV_8UC3, cv::Scalar::all(240)), figure = cv::Mat::zeros(rgb.size(), CV_8U);
  rgb(cv::Rect(60, 20, 40, 60)).setTo(cv::Scalar(40, 60, 200));
  figure(cv::Rect(60, 20, 40, 60)).setTo(255);
  std::vector<std::vector<float>> results;
  for (const int threads : {1, 3}) {
    ConvNetSchedule schedule;
    schedule.steps = 6;
    schedule.batch = 5;
    schedule.threads = threads;
    ConvNetTrainer trainer(randomNet(), schedule);
    const ConvNetTrainer::Lesson lesson = {
        [&](int, std::vector<float>& input) { encodePage(rgb, input); },
        [&](int, const std::vector<float>& output, std::vector<float>& gradient) {
          return pageLoss(output, figure, .2, &gradient);
        }};
    const double first = trainer.step(lesson);
    double last = first;
    while (!trainer.done()) last = trainer.step(lesson);
    CHECK(last < .9 * first);
    results.push_back(trainer.averaged());
  }
  CHECK(results[0] == results[1]);
}

}  // namespace
}  // namespace skel
