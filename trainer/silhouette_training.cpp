#include "trainer/silhouette_training.h"

#include <cstdio>
#include <filesystem>
#include <map>

#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/files.h"
#include "libskel/core/parallel.h"
#include "libskel/core/rng.h"
#include "libskel/core/text.h"
#include "libskel/image/read_image.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/recognition/calibration.h"
#include "libskel/recognition/silhouette_confidence.h"
#include "libskel/silhouette/working_colors.h"
#include "trainer/confidence_fit.h"
#include "trainer/confidence_samples.h"
#include "trainer/hands.h"
#include "trainer/pages/hard_pages.h"
#include "trainer/writable_output.h"

namespace skel {
namespace {

struct FoundOnPage {
  std::string circumstance, drawing;
  Eigen::VectorXd inputs;
  bool good = false;
};

// Each drawing in each circumstance, where there is evidence.
std::vector<FoundOnPage> findOnPages(const std::vector<AnnotatedImage>& drawings, std::uint64_t seed,
                                     int threads) {
  const std::vector<Circumstance> all = circumstances();
  std::vector<std::vector<FoundOnPage>> found(drawings.size());
  const auto artOf = [](const AnnotatedImage& drawing) {
    const Image image = readImage(drawing.image);
    return pageArt(image, readMaskOf(image, *drawing.mask));
  };
  parallelFor(drawings.size(), threads, [&](std::size_t i) {
    const PageArt art = artOf(drawings[i]), other = artOf(drawings[(i + 1) % drawings.size()]);
    for (std::size_t c = 0; c < all.size(); ++c) {
      Rng rng(seed + i, c);
      const HardPage page = all[c].compose(rng, art, other);
      const Silhouette silhouette = extractSilhouette(imageOfRgb(page.rgb));
      if (!silhouette.found() || !silhouette.evidence) continue;
      constexpr double kGood = .9;
      found[i].push_back({all[c].name, drawingName(drawings[i].image), silhouette.evidence->inputs,
                          overlapOnPage(page, silhouette.mask) >= kGood});
    }
  });
  std::vector<FoundOnPage> flat;
  for (std::vector<FoundOnPage>& of_drawing : found)
    for (FoundOnPage& page : of_drawing) flat.push_back(std::move(page));
  return flat;
}

ConfidenceNet learnFrom(const std::vector<const FoundOnPage*>& pages, int seed) {
  const auto count = static_cast<Eigen::Index>(pages.size());
  Eigen::MatrixXd inputs(count, static_cast<Eigen::Index>(kMaskInputs.size()));
  Eigen::VectorXd good(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    inputs.row(i) = pages[static_cast<std::size_t>(i)]->inputs;
    good[i] = pages[static_cast<std::size_t>(i)]->good;
  }
  ConfidenceFitOptions options;
  options.seed = static_cast<std::uint64_t>(seed);
  return fitConfidenceNet(inputs, good, Eigen::VectorXd::Ones(count), options);
}

void printForecasts(const std::string& title, const std::vector<Forecast>& forecasts) {
  double doubted = 0, bad = 0, named = 0;
  for (const Forecast& page : forecasts) {
    doubted += page.probability < .5;
    bad += !page.came_true;
    named += page.probability < .5 && !page.came_true;
  }
  std::printf("%-10s %5zu pages, %4.0f bad: %3.0f %% of them named, %3.0f %% of those named are bad",
              title.c_str(), forecasts.size(), bad, 100 * named / std::max(1., bad),
              100 * named / std::max(1., doubted));
  std::printf(
      bad > 0 && bad < double(forecasts.size()) ? "; area under ROC %.3f, calibration error %.3f\n" : "\n",
      areaUnderRoc(forecasts), calibrationError(forecasts));
}

// Learns from all hands but a fold's, and measures on that.
void measureOnHandsLeftOut(const std::vector<FoundOnPage>& pages, const Hands& hands, int folds, int seed) {
  std::vector<std::string> drawings;
  for (const FoundOnPage& page : pages) drawings.push_back(page.drawing);
  const std::map<std::string, int> fold_of = foldOfDrawing(drawings, hands, folds);
  std::map<std::string, std::vector<Forecast>> by_circumstance;
  std::vector<Forecast> all;
  for (int fold = 0; fold < folds; ++fold) {
    std::vector<const FoundOnPage*> learned;
    for (const FoundOnPage& page : pages)
      if (fold_of.at(page.drawing) != fold) learned.push_back(&page);
    if (learned.empty()) continue;
    const SilhouetteConfidence confidence{learnFrom(learned, seed), ""};
    for (const FoundOnPage& page : pages) {
      if (fold_of.at(page.drawing) != fold) continue;
      all.push_back({confidence.of({page.inputs, std::nullopt}), page.good});
      by_circumstance[page.circumstance].push_back(all.back());
    }
  }
  std::printf("on hands left out (%d folds):\n", folds);
  for (const auto& [name, forecasts] : by_circumstance) printForecasts(name, forecasts);
  printForecasts("all", all);
}

}  // namespace

void bindSilhouetteTrainingOptions(CLI::App& command, SilhouetteTrainingOptions& options) {
  command.add_option("drawings", options.drawings, "Drawings with masks, which are put on pages")
      ->type_name("DIR")
      ->required();
  command.add_option("--hands", options.hands, "Whose drawings are whose: a JSON object of lists of names")
      ->type_name("FILE");
  command.add_option("-o,--output", options.output, "Weights file to write")
      ->capture_default_str()
      ->check(outputFile());
  command.add_option("--folds", options.folds, "Groups of hands for cross-validation; 0: none")
      ->capture_default_str()
      ->check(numberIn(0, 1000));
  command.add_option("--seed", options.seed, "Same drawings, nets, seed and options: same bytes")
      ->capture_default_str()
      ->check(numberIn(0, 2'000'000'000));
  command.add_option("--threads", options.threads, "0: one a core")
      ->capture_default_str()
      ->check(numberIn(0, 1024));
}

ExitCode runSilhouetteTraining(const SilhouetteTrainingOptions& options) {
  const Hands hands = readHands(options.hands);
  std::vector<AnnotatedImage> drawings;
  for (const std::string& folder : options.drawings)
    for (AnnotatedImage& drawing : findAnnotatedImages(folder))
      if (drawing.mask) drawings.push_back(std::move(drawing));
  if (drawings.empty()) throw UsageError("there are no drawings with masks to learn from");
  ensureWritableFile(options.output);
  const std::vector<FoundOnPage> pages =
      findOnPages(drawings, static_cast<std::uint64_t>(options.seed), options.threads);
  std::vector<const FoundOnPage*> all;
  for (const FoundOnPage& page : pages) all.push_back(&page);
  if (all.empty()) throw UsageError("no page is so hard that the page net was asked");
  if (options.folds > 1) measureOnHandsLeftOut(pages, hands, options.folds, options.seed);
  const SilhouetteConfidence confidence{
      learnFrom(all, options.seed), "skel-train silhouettes --seed " + std::to_string(options.seed) + ": " +
                                        std::to_string(pages.size()) + " pages with " +
                                        std::to_string(drawings.size()) + " drawings"};
  writeFile(options.output, formatSilhouetteConfidence(confidence));
  std::printf("wrote %s\n", printable(options.output).c_str());
  return ExitCode::kDone;
}

}  // namespace skel
