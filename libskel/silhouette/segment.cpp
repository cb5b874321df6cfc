#include "libskel/silhouette/segment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "libskel/silhouette/background.h"
#include "libskel/silhouette/chambers.h"
#include "libskel/silhouette/ground.h"
#include "libskel/silhouette/ink_edge.h"
#include "libskel/silhouette/loops.h"
#include "libskel/silhouette/outlined.h"
#include "libskel/silhouette/page.h"
#include "libskel/silhouette/page_net.h"
#include "libskel/silhouette/ruling.h"
#include "libskel/silhouette/settle.h"
#include "libskel/silhouette/sheet.h"
#include "libskel/silhouette/strokes.h"
#include "libskel/silhouette/trim.h"
#include "libskel/silhouette/working_colors.h"

namespace skel {
namespace {

// No sheet of paper in fair light.
bool isColored(const Background& background) {
  const double chroma = std::hypot(background.coefficients(0, 1) - 128, background.coefficients(0, 2) - 128);
  return chroma > 12 || background.coefficients(0, 0) < 160;
}

// Pencil leaves gaps, and so does what was taken off with the ruling. `lines` becomes `drawn` with its gaps
// closed, and wide ones, too, where little is enclosed without and much more with them.
constexpr int kPencilGap = 5;  // px
cv::Mat filledPencil(const cv::Mat& drawn, cv::Mat& lines) {
  cv::Mat filled;
  const int ink = cv::countNonZero(drawn);
  int area = 0;
  for (const int gap : {kPencilGap, 2 * kPencilGap - 1, 3 * kPencilGap}) {
    cv::Mat closed, wider;
    cv::morphologyEx(drawn, closed, cv::MORPH_CLOSE,
                     cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(gap, gap)));
    wider = closed.clone();
    fillChambers(wider);
    const int wider_area = cv::countNonZero(wider);
    constexpr double kMuchMore = 1.3, kFilled = 2.5;
    if (wider_area > kMuchMore * area) {
      lines = closed;
      filled = wider;
      area = wider_area;
    }
    if (area > kFilled * ink) break;
  }
  return filled;
}

// Makes `rgb`, the whole picture, the sheet alone. Returns the perspective from the picture to that.
cv::Mat straightened(const Image& image, cv::Mat& rgb, PageCorners corners) {
  const double image_px = static_cast<double>(image.width) / rgb.cols;  // in one of rgb
  for (Eigen::Vector2d& corner : corners) corner = ((corner.array() + 0.5) * image_px - 0.5).matrix();
  std::array<int, 2> size{};
  const cv::Mat page_from_image = pageFromPicture(corners, size);
  cv::Mat page;
  cv::warpPerspective(rgbaOf(image), page, page_from_image, cv::Size(size[0], size[1]), cv::INTER_LINEAR,
                      cv::BORDER_REPLICATE);
  // cvtColor() would bring along every colour space that OpenCV knows.
  rgb.create(page.size(), CV_8UC3);
  cv::mixChannels(page, rgb, {0, 0, 1, 1, 2, 2});
  const double half = (image_px - 1) / 2;
  const cv::Mat image_from_picture =
      (cv::Mat_<double>(3, 3) << image_px, 0, half, 0, image_px, half, 0, 0, 1);
  return page_from_image * image_from_picture;
}

// What a drawing lies on, straightened and without its ruling.
struct BarePage {
  cv::Mat rgb, lab;                    // of the sheet, else of the whole picture
  cv::Mat page_from_picture;           // of the working size; empty: there is no sheet
  std::vector<RuledLine> ruling = {};  // image px
};

// `steps`, if not null, keeps what was seen.
BarePage barePage(const Image& image, const cv::Mat& picture, SilhouetteSteps* steps) {
  BarePage page{picture.clone(), labOf(picture), {}};
  if (const std::optional<PageCorners> corners = findPage(page.lab)) {
    page.page_from_picture = straightened(image, page.rgb, *corners);
    page.lab = labOf(page.rgb);
    if (steps) steps->sheet = imageOfRgb(page.rgb);
  }
  page.ruling = eraseRuling(page.rgb);
  if (page.ruling.empty()) return page;
  page.lab = labOf(page.rgb);
  if (steps) steps->unruled = imageOfRgb(page.rgb);
  Eigen::Matrix3d picture_from_page = Eigen::Matrix3d::Identity();
  if (!page.page_from_picture.empty()) {
    const cv::Mat inverse = page.page_from_picture.inv();
    picture_from_page = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(inverse.ptr<double>());
  }
  const double image_px = static_cast<double>(image.width) / picture.cols;
  for (RuledLine& line : page.ruling)
    for (Eigen::Vector2d& p : line.points)
      p = (((picture_from_page * p.homogeneous()).hnormalized().array() + 0.5) * image_px - 0.5).matrix();
  return page;
}

Plane8 sharesOf(const cv::Mat& probability) {
  Plane8 shares(probability.rows, probability.cols);
  cv::Mat view(probability.rows, probability.cols, CV_8U, shares.data());
  probability.convertTo(view, CV_8U, 255);
  return shares;
}

// Pixels of the straightened sheet become those of the picture.
void toPicture(std::vector<Loop>& loops, const cv::Size& page, const cv::Mat& page_from_picture,
               const cv::Size& picture) {
  for (Loop& loop : loops) {
    cv::Mat region = cv::Mat::zeros(page, CV_8U);
    for (const int pixel : loop.pixels) region.data[pixel] = 255;
    cv::warpPerspective(region, region, page_from_picture, picture, cv::INTER_NEAREST | cv::WARP_INVERSE_MAP);
    loop.pixels.clear();
    for (int pixel = 0; pixel < picture.area(); ++pixel)
      if (region.data[pixel]) loop.pixels.push_back(pixel);
  }
}

// What lines and colours tell.
struct Drawn {
  cv::Mat figures;          // 8-bit, 255 on figures; empty if there are none
  std::string reason;       // why there are none
  cv::Mat ink, difference;  // on which something is drawn; 8-bit, of each colour from the ground's
  double different = 0;     // from which on a colour is not the ground's
  bool colored_ground = false;
  bool tidy = false;  // on an even ground that is no paper's grain, with nothing around
  bool soft = false;  // strokes on paper, of which the core is seen
};

Drawn figuresIn(const cv::Mat& rgb, const cv::Mat& lab) {
  Drawn out;
  double explained_border = 0;
  const std::vector<Background> backgrounds = fitBackgrounds(lab, explained_border);
  if (explained_border < 0.4) {
    out.reason = "no background can be told: the picture's border has no colour in common";
    return out;
  }
  const cv::Mat difference = colorDifference(lab, backgrounds);
  double sigma = 0;
  for (const Background& b : backgrounds) sigma = std::max(sigma, b.sigma);
  const double low_color = std::max(6.0, 3.5 * sigma);
  const double color_threshold = emptiestLevel(difference, low_color, low_color + 14);
  const cv::Mat far = difference > color_threshold;

  const bool dark_background = backgrounds.front().coefficients(0, 0) < 90;
  cv::Mat contrast = strokeContrast(rgb, dark_background, false);
  Noise noise = noiseOf(contrast, far);
  const bool textured = noise.level + noise.deviation > 2;
  if (textured) {
    contrast = strokeContrast(rgb, dark_background, true);
    noise = noiseOf(contrast, far);
  }
  const double low = std::max(12.0, noise.level + 4 * noise.deviation);
  const double high = std::max(30.0, noise.level + 7 * noise.deviation);
  const cv::Mat strokes = hysteresis(contrast, low, high);
  cv::Mat barrier, edges;
  if (textured) {
    barrier = drawnOnPaper(lab, strokes, far);
    edges = edgesOnPaper(lab) & ~barrier;
    barrier |= edges;
  } else {
    // A gap between bright fills on a dark ground looks like a stroke, but in the background's colour.
    barrier = (strokes & (difference > low_color)) | far;
  }
  if (cv::countNonZero(barrier) == 0) {
    out.reason = textured ? "nothing on the picture stands out from its ground" : "the picture is blank";
    return out;
  }

  const cv::Mat drawn = barrier.clone();
  cv::Mat lines = barrier;
  if (textured) {
    barrier = filledPencil(drawn, lines);
  } else {
    barrier = lines.clone();
    fillChambers(barrier);
  }
  dropGround(barrier, lines);
  if (textured) {
    dropOuterEdges(barrier, edges);
    for (int i = 0; i < kPencilGap / 2; ++i) dropOuterEdges(barrier, lines & ~drawn);
  } else {
    // Scenery shows at the border of the picture.
    cv::Mat outlined;
    out.tidy = backgrounds.size() == 1 && !touchesBorder(barrier);
    if (!out.tidy) outlined = outlinedFigure(lab, barrier);
    const bool scenery = !outlined.empty();
    if (scenery) barrier = outlined;
    if (!scenery) trimSoftEdge(barrier, drawn, cv::max(difference, contrast));
  }
  dropBorderStrips(barrier);
  if (cv::countNonZero(barrier) == 0) {
    out.reason = "nothing stands out from the background";
    return out;
  }
  out.soft = textured;
  out.figures = barrier;
  out.ink = drawn, out.difference = difference, out.different = color_threshold;
  // Paper in dim or warm light has a colour, too, and clothes have that of the paper.
  out.colored_ground = !textured && isColored(backgrounds.front());
  return out;
}

// What it encloses has the ground's colour and is figure all the same.
bool isLineArtOnColor(const Drawn& drawn) {
  constexpr double kFilled = 0.7;  // of a figure that is painted
  return drawn.colored_ground &&
         cv::countNonZero(drawn.ink & drawn.figures) < kFilled * cv::countNonZero(drawn.figures);
}

// Share of `figure` that is farther than `reach` px from all of `other`.
double shareApart(const cv::Mat& figure, const cv::Mat& other, int reach) {
  cv::Mat around;
  cv::dilate(other, around,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * reach + 1, 2 * reach + 1)));
  return static_cast<double>(cv::countNonZero(figure & ~around)) / std::max(1, cv::countNonZero(figure));
}

// Whether the net has seen a figure like this: where it sees next to nothing of what is drawn, or is sure of
// little, it does not know what that is.
bool knows(const cv::Mat& page, const cv::Mat& drawn) {
  constexpr float kSeen = 0.5f, kWithoutDoubt = 0.9f;
  constexpr double kLeastSeen = 0.2, kLeastClear = 0.5;  // of what is drawn; of what is seen
  const int seen = cv::countNonZero(page > kSeen);
  return seen > kLeastSeen * cv::countNonZero(drawn) &&
         cv::countNonZero(page > kWithoutDoubt) >= kLeastClear * seen;
}

// Lines and colours give the sharper edge, the page net knows what is a figure. Where they mean the same
// figure, it is `drawn`; else what the net is sure of decides, and lines and colours where it is not. `page`:
// how probably each pixel is figure, CV_32F.
cv::Mat agreed(const cv::Mat& drawn, const cv::Mat& page) {
  constexpr float kSurely = 0.7f, kPerhaps = 0.3f;
  constexpr double kReach = 0.02;  // of the long side
  constexpr double kMuch = 0.1;    // of what is drawn, or of what the net is sure of
  const int reach = std::max(1, cvRound(kReach * std::max(drawn.cols, drawn.rows)));
  if (shareApart(drawn, page > kPerhaps, reach) < kMuch && shareApart(page > kSurely, drawn, reach) < kMuch)
    return drawn;
  return (page > kSurely) | (drawn & (page > kPerhaps));
}

}  // namespace

Segmentation segment(const Image& image, const PageNet* page_net, bool keep_steps) {
  Segmentation out;
  const cv::Mat picture = workingRgb(image);
  BarePage page = barePage(image, picture, keep_steps ? &out.steps : nullptr);
  const cv::Mat &rgb = page.rgb, &page_from_picture = page.page_from_picture;
  const bool sheet = !page_from_picture.empty(), ruled = !page.ruling.empty();
  out.ruling = std::move(page.ruling);
  const Drawn drawn = figuresIn(rgb, page.lab);
  const PageNet* net = page_net || !hasBuiltInPageNet() ? page_net : &builtInPageNet();
  cv::Mat probability;  // of the picture
  const auto look = [&] {
    if (probability.empty()) probability = figureProbability(net ? *net : builtInPageNet(), picture);
  };

  cv::Mat figures = drawn.figures.empty() ? cv::Mat::zeros(rgb.size(), CV_8U) : drawn.figures.clone();
  std::vector<Loop> loops;
  if (net && !drawn.figures.empty() && !isLineArtOnColor(drawn))
    loops = findLoops(
        {drawn.figures, drawn.ink, drawn.difference, drawn.different, drawn.colored_ground, drawn.soft});
  if (!loops.empty()) {
    look();
    cv::Mat seen = probability;
    if (sheet) cv::warpPerspective(probability, seen, page_from_picture, rgb.size(), cv::INTER_LINEAR);
    lookInto(loops, drawn.figures, seen);
    openLoops(loops, builtInLoopNet(), figures);
    if (cv::Mat chance = chanceOfGround(loops, builtInLoopNet(), figures); !chance.empty()) {
      if (sheet)
        cv::warpPerspective(chance, chance, page_from_picture, picture.size(),
                            cv::INTER_NEAREST | cv::WARP_INVERSE_MAP);
      out.enclosed = Eigen::Map<Plane8>(chance.data, chance.rows, chance.cols);
    }
  }
  if (sheet) {
    cv::warpPerspective(figures, figures, page_from_picture, picture.size(),
                        cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    figures = figures >= 128;
  }
  bool settles = false;
  if (sheet || ruled || !drawn.tidy) {
    look();
    out.seen = {sharesOf(probability), sheet, ruled, drawn.soft};
    if (keep_steps) out.steps.figure_share = out.seen->share;
    const bool known = knows(probability, figures);
    // Something of a sheet or of ruling is left on what is drawn, and something of that was taken off with
    // them.
    settles = known && (sheet || ruled);
    if (known)
      figures = settles ? settled(figures, probability, labOf(picture)) > 0.5 : agreed(figures, probability);
  }
  if (keep_steps) {
    if (sheet) toPicture(loops, rgb.size(), page_from_picture, picture.size());
    out.loops = std::move(loops);
  }
  if (cv::countNonZero(figures) == 0) {
    out.reason = drawn.reason.empty() ? "nothing on the page looks like a figure" : drawn.reason;
    return out;
  }
  cv::Mat full = figures;
  if (const cv::Size full_size(image.width, image.height); figures.size() != full_size) {
    cv::Mat shares;
    cv::resize(figures, shares, full_size, 0, 0, cv::INTER_LINEAR);
    full = shares >= 128;
  }
  // The edges of strokes on paper are soft: what is seen as a stroke is its core.
  if (drawn.soft && !settles) cv::dilate(full, full, cv::Mat::ones(3, 3, CV_8U));
  constexpr double kReach = 2;  // px of the smaller picture
  trimToInk(image, cvCeil(kReach * std::max(1., static_cast<double>(full.cols) / figures.cols)), full);
  out.foreground = Eigen::Map<Plane8>(full.data, full.rows, full.cols);
  return out;
}

std::vector<RuledLine> rulingOf(const Image& image) {
  return barePage(image, workingRgb(image), nullptr).ruling;
}

}  // namespace skel
