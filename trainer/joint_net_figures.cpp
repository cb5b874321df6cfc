#include "trainer/joint_net_figures.h"

#include <algorithm>
#include <cmath>

#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/files.h"
#include "libskel/image/write_image.h"
#include "trainer/figures/figure.h"
#include "trainer/posable_drawing.h"

namespace skel {

void bindFigureSheetOptions(CLI::App& command, FigureSheetOptions& options) {
  command.add_option("--template", options.body_plan, "Body plan, by the name of its template")
      ->capture_default_str();
  command.add_option("-o,--output", options.output, "Picture to write (PNG)")
      ->capture_default_str()
      ->check(outputFile());
  command.add_option("--seed", options.seed, "Of the random numbers")
      ->check(seedNumber())
      ->capture_default_str();
  command.add_option("--columns", options.columns)->check(numberIn(1, 100))->capture_default_str();
  command.add_option("--rows", options.rows)->check(numberIn(1, 100))->capture_default_str();
  command.add_option("--others", options.other_share, "Share of figures that are not whole")
      ->check(numberIn(0., 1.))
      ->capture_default_str();
  command.add_option("--drawings", options.drawings, "Instead: warped ones of these annotated drawings")
      ->type_name("DIR");
  command.add_flag("--plain", options.plain, "Without joints");
}

ExitCode runFigureSheet(const FigureSheetOptions& options) {
  constexpr int kCell = 140, kGrey = 160;
  Image sheet(options.columns * kCell, options.rows * kCell);
  sheet.rgba.col(0) = 40;
  sheet.rgba.col(1) = 32;
  sheet.rgba.col(2) = 32;
  sheet.rgba.col(3) = 255;
  const std::vector<std::string> names = jointNames(figurePlan(options.body_plan));
  Rng rng(options.seed);
  FigureOptions figure_options;
  figure_options.body_plan = options.body_plan;
  figure_options.other_share = options.other_share;
  if (!options.drawings.empty()) {
    Rng poses(options.seed, 1);
    const SkeletonTemplate body_plan = loadTemplate(options.body_plan);
    const std::vector<PosableDrawing> drawings =
        posableDrawings(findJointedDrawings({options.drawings}, body_plan), names, body_plan, 0);
    for (const PosableDrawing& drawing : drawings) {
      const PosableDrawing& donor = drawings[poses.below(static_cast<std::uint32_t>(drawings.size()))];
      figure_options.drawings.push_back(asDrawn(drawing));
      figure_options.drawings.push_back(posed(poses, drawing));
      figure_options.drawings.push_back(withLimbsOf(poses, drawing, donor));
    }
    figure_options.drawn_share = 1;
  }
  for (int cell = 0; cell < options.columns * options.rows; ++cell) {
    const Figure figure = generateFigure(rng, figure_options);
    const int left = cell % options.columns * kCell + 6, top = cell / options.columns * kCell + 6;
    for (int y = 0; y < figure.mask.rows(); ++y) {
      for (int x = 0; x < figure.mask.cols(); ++x) {
        if (figure.mask(y, x) == 0) continue;
        std::uint8_t* p = sheet.pixel(left + x, top + y);
        const auto tone = [&](std::size_t k) { return figure.look.tones[k](y, x) - kMeanTone; };
        // As far as the tones tell: mean, red less green, blue less the mean of both.
        const int yellow = kGrey + tone(0) - 2 * tone(2) / 3, half = tone(1);
        const int rgb[] = {yellow + half, yellow - half, yellow + 2 * tone(2)};
        for (int c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>(std::clamp(rgb[c], 0, 255));
      }
    }
    if (options.plain || !figure.whole) continue;
    for (std::size_t j = 0; j < figure.joints.size(); ++j) {
      const bool of_left = names[j].starts_with("left_"), of_right = names[j].starts_with("right_");
      const int x = left + static_cast<int>(std::lround(figure.joints[j].x()));
      const int y = top + static_cast<int>(std::lround(figure.joints[j].y()));
      for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
          if (dx * dx + dy * dy > 5 || x + dx < 0 || y + dy < 0 || x + dx >= sheet.width ||
              y + dy >= sheet.height) {
            continue;
          }
          std::uint8_t* p = sheet.pixel(x + dx, y + dy);
          p[0] = of_right ? 255 : 0;
          p[1] = !of_left && !of_right ? 200 : figure.visible[j] ? 0 : 150;
          p[2] = of_left ? 255 : 0;
        }
      }
    }
  }
  writeFile(options.output, encodePng(sheet));
  return ExitCode::kDone;
}

}  // namespace skel
