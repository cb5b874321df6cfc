#include "trainer/silhouette_training.h"

#include <cstdio>

#include "libskel/core/files.h"
#include "libskel/core/text.h"
#include "libskel/recognition/silhouette_confidence.h"
#include "libskel/silhouette/working_colors.h"

namespace skel {
namespace {

// Where there is evidence.
std::vector<Case> maskOn(const HardPage& page) {
  const Silhouette silhouette = extractSilhouette(imageOfRgb(page.rgb));
  if (!silhouette.found() || !silhouette.evidence) return {};
  constexpr double kGood = .9;
  return {{"", "", silhouette.evidence->inputs, overlapOnPage(page, silhouette.mask) >= kGood}};
}

void printNamed(const std::string& title, const std::vector<Forecast>& forecasts) {
  double doubted = 0, bad = 0, named = 0;
  for (const Forecast& page : forecasts) {
    doubted += page.probability < kSureMask;
    bad += !page.came_true;
    named += page.probability < kSureMask && !page.came_true;
  }
  std::printf("%-10s %5zu pages, %4.0f bad: %3.0f %% of them named, %3.0f %% of those named are bad",
              title.c_str(), forecasts.size(), bad, 100 * named / std::max(1., bad),
              100 * named / std::max(1., doubted));
  std::printf(
      bad > 0 && bad < double(forecasts.size()) ? "; area under ROC %.3f, calibration error %.3f\n" : "\n",
      areaUnderRoc(forecasts), calibrationError(forecasts));
}

}  // namespace

ExitCode runSilhouetteTraining(const PageCaseOptions& options) {
  const LearnedFromPages learned =
      learnFromPages(options, maskOn, printNamed, "no page is so hard that the page net was asked");
  writeFile(options.output,
            formatSilhouetteConfidence({learned.net, "skel-train silhouettes " + learned.provenance}));
  std::printf("wrote %s\n", printable(options.output).c_str());
  return ExitCode::kDone;
}

}  // namespace skel
