// Stage 2: which pixels are the figure.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/silhouette/enclosed_ground.h"
#include "libskel/silhouette/mask_evidence.h"
#include "libskel/silhouette/ruling.h"

namespace skel {

// The working grid: the figure's bounding box, scaled so that its long side is kWorkingGridSize px.
// Grid and image points both have their origin at the centre of their own top left pixel.
struct WorkingGrid {
  int width = 0, height = 0;  // px, the longer is kWorkingGridSize
  double scale = 1;           // grid px per image px
  Eigen::Vector2d corner_px =
      Eigen::Vector2d::Zero();  // top left corner (not centre) of the box, image px + 0.5

  Eigen::Vector2d gridFromImage(const Eigen::Vector2d& p) const {
    return ((p.array() + 0.5 - corner_px.array()) * scale - 0.5).matrix();
  }
  Eigen::Vector2d imageFromGrid(const Eigen::Vector2d& p) const {
    return ((p.array() + 0.5) / scale + corner_px.array() - 0.5).matrix();
  }
};

inline constexpr int kWorkingGridSize = 128;

using Polygon = std::vector<Eigen::Vector2d>;  // closed; image px

enum class SilhouetteStatus {
  kFound,
  kNoFigure,  // blank, noise, or too small to be a figure; see reason
};

struct Silhouette {
  SilhouetteStatus status = SilhouetteStatus::kNoFigure;
  std::string reason;                 // why there is none, one clause
  std::vector<std::string> warnings;  // e.g. other figures in the picture, the figure cut by the border
  bool clear_around = false;  // the picture is clear beside the figure: its border cuts nothing, only crops
  std::string cut_sides;      // of the picture, by which the figure is cut: "left, bottom"
  bool is_sheet = false;      // the sheet itself was probably taken for the figure

  std::optional<MaskEvidence> evidence;    // of pages that are not tidy
  std::optional<EnclosedGround> enclosed;  // of pictures whose figure lines and colours tell
  // Of the paper, image px; nothing where it was not looked for: the mask was given, or alpha tells it.
  std::optional<std::vector<RuledLine>> ruling;

  Plane8 mask;     // size of the image; one 4-connected figure
  Plane8 bridges;  // where the mask joins pieces of the figure across gaps (pieces.h); empty if it joins none
  // Pixel boundary of mask, corners only: the outer contour first, then the holes. The figure lies at the
  // right of the way round, as seen on the screen.
  std::vector<Polygon> outline;
  Plane8 grid_mask;  // size of the grid; one 4-connected figure
  WorkingGrid grid;
  int figure_count = 0;  // in the picture; figure 1 is the largest

  bool found() const { return status == SilhouetteStatus::kFound; }
};

enum class SilhouetteMethod {
  kAutomatic,  // the picture's alpha where it has any, else its lines and colours (segment.h)
  kPaper,      // dark lines and a flood fill, as the paper does it (paper.h); alpha is laid on white
};

struct PageNet;

struct SilhouetteOptions {
  SilhouetteMethod method = SilhouetteMethod::kAutomatic;
  int figure = 1;    // 1 is the largest
  bool all = false;  // the others are taken, too: nothing is said of them
  // Of pictures with transparency: what is at least so opaque is the figure, 0…1; nothing: half as opaque as
  // the most opaque pixel, at most half.
  std::optional<double> alpha;
  bool fill_holes = false;                  // as in the paper, which keeps the outer contour alone
  std::shared_ptr<const PageNet> page_net;  // null: the built-in one (page_net.h)
};

// From the picture alone. An empty picture has no figure.
Silhouette extractSilhouette(const Image& image, const SilhouetteOptions& options = {});

// The same of several figures of one picture, which is looked at once.
class FigureFinder {
 public:
  explicit FigureFinder(SilhouetteOptions options);
  ~FigureFinder();

  // `image` is the same each time. `figure` stands for that of the options.
  Silhouette take(const Image& image, int figure);

 private:
  struct Found;
  SilhouetteOptions options_;
  std::unique_ptr<Found> found_;
};

// SHA-256 of the figure's outline, to tell whether a skeleton was found in this figure. `silhouette` must be
// found.
std::string outlineHash(const Silhouette& silhouette);

// From a mask given by hand (255 on the figure): cleaned, the chosen figure taken, scaled to the grid.
// `options.method` does not matter.
Silhouette silhouetteFromMask(const Plane8& mask, const SilhouetteOptions& options = {});

// The same of a mask of this picture, whose transparency tells whether its border can cut the figure.
Silhouette silhouetteFromMask(const Plane8& mask, const Image& image, const SilhouetteOptions& options = {});

}  // namespace skel
