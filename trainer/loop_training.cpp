#include "trainer/loop_training.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "libskel/core/files.h"
#include "libskel/core/text.h"
#include "libskel/silhouette/loops.h"
#include "libskel/silhouette/segment.h"
#include "libskel/silhouette/working_colors.h"

namespace skel {
namespace {

// Those of which nobody could say are left out: lines were missed there. What is large counts more, by the
// root of its share of the figure.
std::vector<Case> loopsOn(const HardPage& page) {
  const Image image = imageOfRgb(page.rgb);
  const std::vector<Loop> loops = segment(image, nullptr, true).loops;
  if (loops.empty()) return {};
  cv::Mat truth = cv::Mat::zeros(page.rgb.size(), CV_8U);
  for (const cv::Mat& figure : page.figures) truth |= figure;
  cv::resize(truth, truth, workingRgb(image).size(), 0, 0, cv::INTER_AREA);
  std::vector<Case> cases;
  for (const Loop& loop : loops) {
    double inside = 0;
    for (const int pixel : loop.pixels) inside += truth.data[pixel] / 255.;
    constexpr double kMixed = .2;
    const double share = inside / static_cast<double>(std::max<std::size_t>(1, loop.pixels.size()));
    if (share < kMixed || share > 1 - kMixed)
      cases.push_back({"", "", loop.inputs, share < .5, std::sqrt(std::exp(loop.inputs[0]))});
  }
  return cases;
}

void printOpened(const std::string& title, const std::vector<Forecast>& forecasts) {
  double opened = 0, ground = 0, both = 0;
  for (const Forecast& loop : forecasts) {
    const bool is_opened = loop.probability > kSurelyGround;
    opened += is_opened;
    ground += loop.came_true;
    both += is_opened && loop.came_true;
  }
  std::printf(
      "%-10s %5zu loops, %4.0f are ground: %3.0f %% of them opened, %3.0f %% of those opened are ground",
      title.c_str(), forecasts.size(), ground, 100 * both / std::max(1., ground),
      100 * both / std::max(1., opened));
  std::printf(ground > 0 && ground < double(forecasts.size())
                  ? "; area under ROC %.3f, calibration error %.3f\n"
                  : "\n",
              areaUnderRoc(forecasts), calibrationError(forecasts));
}

}  // namespace

ExitCode runLoopTraining(const PageCaseOptions& options) {
  LogisticFitOptions fit;
  fit.hidden = 16;
  fit.steps = 6000;
  const LearnedFromPages learned = learnFromPages(
      options, loopsOn, printOpened, "no figure encloses anything that nothing is drawn on", fit);
  writeFile(options.output, formatLoopNet({learned.net, "skel-train loops " + learned.provenance}));
  std::printf("wrote %s (used once it replaces weights/loop_net.json and skel is built anew)\n",
              printable(options.output).c_str());
  return ExitCode::kDone;
}

}  // namespace skel
