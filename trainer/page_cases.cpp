#include "trainer/page_cases.h"

#include "libskel/cli/outputs.h"
#include "libskel/core/error.h"
#include "libskel/core/parallel.h"
#include "libskel/core/rng.h"
#include "libskel/image/read_image.h"
#include "libskel/labels/annotated_image.h"
#include "trainer/confidence_samples.h"
#include "trainer/twin_hands.h"
#include "trainer/writable_output.h"

namespace skel {
namespace {

std::vector<Case> casesOnPages(const std::vector<AnnotatedImage>& drawings, const PageCaseOptions& options,
                               const CasesOfPage& cases) {
  const std::vector<Circumstance> all = circumstances();
  std::vector<std::vector<Case>> found(drawings.size());
  const auto artOf = [](const AnnotatedImage& drawing) {
    const Image image = readImage(drawing.image);
    return pageArt(image, readMaskOf(image, *drawing.mask));
  };
  parallelFor(drawings.size(), options.threads, [&](std::size_t i) {
    const PageArt art = artOf(drawings[i]), other = artOf(drawings[(i + 1) % drawings.size()]);
    for (std::size_t c = 0; c < all.size(); ++c) {
      Rng rng(static_cast<std::uint64_t>(options.seed) + i, c);
      for (Case& page_case : cases(all[c].compose(rng, art, other))) {
        page_case.group = all[c].name;
        page_case.drawing = drawingName(drawings[i].image);
        found[i].push_back(std::move(page_case));
      }
    }
  });
  std::vector<Case> flat;
  for (std::vector<Case>& of_drawing : found)
    for (Case& page_case : of_drawing) flat.push_back(std::move(page_case));
  return flat;
}

}  // namespace

void bindPageCaseOptions(CLI::App& command, PageCaseOptions& options, const std::string& format) {
  command.add_option("drawings", options.drawings, "Drawings with masks, which are put on pages")
      ->type_name("DIR")
      ->required();
  command.add_option("-o,--output", options.output, "Weights file to write")
      ->capture_default_str()
      ->check(outputFile(format));
  bindLearningOptions(command, options);
}

LearnedFromPages learnFromPages(const PageCaseOptions& options, const CasesOfPage& cases,
                                const PrintForecasts& print, const std::string& none,
                                const LogisticFitOptions& fit) {
  std::vector<AnnotatedImage> drawings;
  for (const std::string& folder : options.drawings) {
    const std::size_t before = drawings.size();
    for (AnnotatedImage& drawing : findAnnotatedImages(folder))
      if (drawing.mask) drawings.push_back(std::move(drawing));
    if (drawings.size() == before)
      throw InputError(folder, "has no drawing with a mask and joints (*.mask.png, *.joints.json)");
  }
  Hands hands = readHands(options.hands);
  std::vector<std::string> images;
  for (const AnnotatedImage& drawing : drawings) images.push_back(drawing.image);
  uniteTwins(images, options.folds, hands);
  ensureWritableFile(options.output);
  const std::vector<Case> found = casesOnPages(drawings, options, cases);
  if (found.empty()) throw UsageError(none);
  return {learnFromCases(found, hands, options, print, fit),
          "--seed " + std::to_string(options.seed) + ": " + std::to_string(found.size()) + " cases with " +
              std::to_string(drawings.size()) + " drawings"};
}

}  // namespace skel
