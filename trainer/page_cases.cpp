#include "trainer/page_cases.h"

#include <cstdio>
#include <map>

#include "libskel/cli/outputs.h"
#include "libskel/core/error.h"
#include "libskel/core/parallel.h"
#include "libskel/core/rng.h"
#include "libskel/image/read_image.h"
#include "libskel/labels/annotated_image.h"
#include "trainer/confidence_samples.h"
#include "trainer/hands.h"
#include "trainer/writable_output.h"

namespace skel {
namespace {

std::vector<PageCase> casesOnPages(const std::vector<AnnotatedImage>& drawings,
                                   const PageCaseOptions& options, const CasesOfPage& cases) {
  const std::vector<Circumstance> all = circumstances();
  std::vector<std::vector<PageCase>> found(drawings.size());
  const auto artOf = [](const AnnotatedImage& drawing) {
    const Image image = readImage(drawing.image);
    return pageArt(image, readMaskOf(image, *drawing.mask));
  };
  parallelFor(drawings.size(), options.threads, [&](std::size_t i) {
    const PageArt art = artOf(drawings[i]), other = artOf(drawings[(i + 1) % drawings.size()]);
    for (std::size_t c = 0; c < all.size(); ++c) {
      Rng rng(static_cast<std::uint64_t>(options.seed) + i, c);
      for (PageCase& page_case : cases(all[c].compose(rng, art, other))) {
        page_case.circumstance = all[c].name;
        page_case.drawing = drawingName(drawings[i].image);
        found[i].push_back(std::move(page_case));
      }
    }
  });
  std::vector<PageCase> flat;
  for (std::vector<PageCase>& of_drawing : found)
    for (PageCase& page_case : of_drawing) flat.push_back(std::move(page_case));
  return flat;
}

LogisticNet learnFrom(const std::vector<const PageCase*>& cases, LogisticFitOptions fit, int seed) {
  const auto count = static_cast<Eigen::Index>(cases.size());
  Eigen::MatrixXd inputs(count, cases.front()->inputs.size());
  Eigen::VectorXd came_true(count), weights(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    inputs.row(i) = cases[static_cast<std::size_t>(i)]->inputs;
    came_true[i] = cases[static_cast<std::size_t>(i)]->came_true;
    weights[i] = cases[static_cast<std::size_t>(i)]->weight;
  }
  fit.seed = static_cast<std::uint64_t>(seed);
  return fitLogisticNet(inputs, came_true, weights, fit);
}

// Learns from all hands but a fold's, and measures on that.
void measureOnHandsLeftOut(const std::vector<PageCase>& cases, const Hands& hands,
                           const PageCaseOptions& options, const PrintForecasts& print,
                           const LogisticFitOptions& fit) {
  std::vector<std::string> drawings;
  for (const PageCase& page_case : cases) drawings.push_back(page_case.drawing);
  const std::map<std::string, int> fold_of = foldOfDrawing(drawings, hands, options.folds);
  std::map<std::string, std::vector<Forecast>> by_circumstance;
  std::vector<Forecast> all;
  for (int fold = 0; fold < options.folds; ++fold) {
    std::vector<const PageCase*> learned;
    for (const PageCase& page_case : cases)
      if (fold_of.at(page_case.drawing) != fold) learned.push_back(&page_case);
    if (learned.empty()) continue;
    const LogisticNet net = learnFrom(learned, fit, options.seed);
    for (const PageCase& page_case : cases) {
      if (fold_of.at(page_case.drawing) != fold) continue;
      all.push_back({net.probability(page_case.inputs), page_case.came_true});
      by_circumstance[page_case.circumstance].push_back(all.back());
    }
  }
  std::printf("on hands left out (%d folds):\n", options.folds);
  for (const auto& [name, forecasts] : by_circumstance) print(name, forecasts);
  print("all", all);
}

}  // namespace

void bindPageCaseOptions(CLI::App& command, PageCaseOptions& options) {
  command.add_option("drawings", options.drawings, "Drawings with masks, which are put on pages")
      ->type_name("DIR")
      ->required();
  command.add_option("-o,--output", options.output, "Weights file to write")
      ->capture_default_str()
      ->check(outputFile());
  bindLearningOptions(command, options);
}

LearnedFromPages learnFromPages(const PageCaseOptions& options, std::string_view format,
                                const CasesOfPage& cases, const PrintForecasts& print,
                                const std::string& none, const LogisticFitOptions& fit) {
  const Hands hands = readHands(options.hands);
  std::vector<AnnotatedImage> drawings;
  for (const std::string& folder : options.drawings) {
    const std::size_t before = drawings.size();
    for (AnnotatedImage& drawing : findAnnotatedImages(folder))
      if (drawing.mask) drawings.push_back(std::move(drawing));
    if (drawings.size() == before)
      throw InputError(folder, "has no drawing with a mask and joints (*.mask.png, *.joints.json)");
  }
  ensureWritableNet(options.output, format);
  const std::vector<PageCase> found = casesOnPages(drawings, options, cases);
  std::vector<const PageCase*> all;
  for (const PageCase& page_case : found) all.push_back(&page_case);
  if (all.empty()) throw UsageError(none);
  if (options.folds > 1) measureOnHandsLeftOut(found, hands, options, print, fit);
  return {learnFrom(all, fit, options.seed), "--seed " + std::to_string(options.seed) + ": " +
                                                 std::to_string(all.size()) + " cases with " +
                                                 std::to_string(drawings.size()) + " drawings"};
}

}  // namespace skel
