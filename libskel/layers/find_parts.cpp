#include "libskel/layers/find_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/core/check.h"
#include "libskel/core/segment.h"
#include "libskel/image/mask_parts.h"
#include "libskel/layers/plane_of.h"
#include "libskel/layers/spread_parts.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

constexpr int kLookSize = 400;  // px, the long side of the figure when borders are looked for
// Lengths as shares of the figure's long side.
constexpr double kLineWidth = .02;    // lines are no wider
constexpr double kInkReach = .0125;   // how far a limb takes the ink that it is drawn with
constexpr double kStub = .005;        // half of how wide a line is that ends at a limb without being of it
constexpr double kInkContrast = .15;  // of the range of brightness
constexpr float kCertain = .8f;       // probability of what borders do not move through
// Log-odds that the net's are corrected by: it was taught limbs with more weight than the rest, and seldom
// saw what hangs or is held, which must not become a limb.
constexpr std::array<float, kPartCount> kCorrection = {0, 0, 1, -.7f, -.7f, -.2f, -.2f, 1.5f, .7f, .5f};
// A limb is about its bones: log-odds less for each px of the net's beyond so many.
constexpr float kFartherLess = .15f, kReach = 14;
// A hand lies about the end of its arm's bones, before whatever it lies: log-odds more there, the less the
// farther, in lower arms.
constexpr float kHandMore = 1.5f;
constexpr double kHandReach = .3;
constexpr float kLeastSeen = .3f;  // probability somewhere, of a part that is there
constexpr float kPossible = .3f;   // probability of what may flood a px
constexpr double kIsland = .25;    // of a limb's area: smaller parts apart are not of it

// What becomes the PartPicture.
struct Sketch {
  PixelBox box;
  double scale = 1;
  cv::Mat rgb, mask, part, ink;  // ink: 255 where a line is drawn, darker than what is on both sides of it
  // Of each limb: probability that it lies before what it overlaps, mean probability of its pixels.
  std::array<double, 4> before{}, sure{};
  double range = 0;  // of brightness on the figure, at least 40

  cv::Mat of(Part which) const { return (part == static_cast<int>(which)) & mask; }
};

PartSkeleton scaled(const PartSkeleton& skeleton, const Vec& corner, double scale) {
  PartSkeleton out = skeleton;
  const auto move = [&](Vec& p) { p = (p - corner) * scale; };
  move(out.head), move(out.body), move(out.tail_root), move(out.tail);
  for (auto& limb : out.limbs)
    for (Vec& p : limb) move(p);
  return out;
}

double toLimb(const PartSkeleton& skeleton, std::size_t limb, const Vec& p) {
  const auto& [a, b, c] = skeleton.limbs[limb];
  return std::min(distanceToSegment<Vec>(p, a, b), distanceToSegment<Vec>(p, b, c));
}

// The box of the image, over white, where it is no figure white.
void cut(const Image& image, const Plane8& mask, Sketch& picture) {
  const PixelBox& box = picture.box;
  cv::Mat rgb(box.height(), box.width(), CV_8UC3), inside(box.height(), box.width(), CV_8U);
  for (int y = 0; y < box.height(); ++y) {
    const std::uint8_t *p = image.pixel(box.x0, y + box.y0), *own = &mask(y + box.y0, box.x0);
    auto *o = rgb.ptr<std::uint8_t>(y), *in = inside.ptr<std::uint8_t>(y);
    for (int x = 0; x < box.width(); ++x, p += 4, o += 3) {
      for (int c = 0; c < 3; ++c)
        o[c] = static_cast<std::uint8_t>((p[c] * p[3] + 255 * (255 - p[3]) + 127) / 255);
      in[x] = own[x] != 0 ? 255 : 0;
    }
  }
  const int long_side = std::max(box.width(), box.height());
  picture.scale = std::min(1., static_cast<double>(kLookSize) / long_side);
  const cv::Size size(std::max(1, cvRound(box.width() * picture.scale)),
                      std::max(1, cvRound(box.height() * picture.scale)));
  cv::resize(rgb, picture.rgb, size, 0, 0, cv::INTER_AREA);
  cv::resize(inside, picture.mask, size, 0, 0, cv::INTER_AREA);
  picture.mask = picture.mask > 127;
}

// How much more likely what lies here is this arm for being near its hand.
float nearHand(const std::array<Vec, 3>& arm, const Vec& p) {
  const double reach2 = kHandReach * kHandReach * (arm[2] - arm[1]).squaredNorm();
  return kHandMore * static_cast<float>(std::exp(-(p - arm[2]).squaredNorm() / std::max(1e-9, 2 * reach2)));
}

// The net's probabilities, one plane a part, of its px, empty for parts that are not there; also fills
// `before` and `sure`.
std::vector<cv::Mat> ask(const PartNet& net, const PartSkeleton& skeleton, Sketch& picture) {
  const cv::Size full = picture.rgb.size();
  const double scale = static_cast<double>(kPartNetSize) / std::max(full.width, full.height);
  const cv::Size size(std::clamp(cvRound(full.width * scale), 1, kPartNetSize),
                      std::clamp(cvRound(full.height * scale), 1, kPartNetSize));
  cv::Mat rgb, mask;
  cv::resize(picture.rgb, rgb, size, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  cv::resize(picture.mask, mask, size, 0, 0, cv::INTER_AREA);
  mask = mask > 127;
  cv::Mat near;  // what the interpolation at the outline asks for
  cv::dilate(mask, near, cv::Mat::ones(3, 3, CV_8U));
  ConvNetMaps maps(net);
  const PartSkeleton bones = scaled(skeleton, Vec::Zero(), scale);
  encodeParts(rgb, mask, bones, maps.maps[0]);
  forward(net, bestInstructionSet(), maps);
  const std::vector<float>& logits = maps.maps.back();
  std::vector<cv::Mat> planes(kPartCount);
  for (cv::Mat& plane : planes) plane = cv::Mat::zeros(size, CV_32F);
  std::array<double, 4> weight{};
  std::array<float, kPartCount> highest{};
  for (int y = 0; y < size.height; ++y) {
    std::array<float*, kPartCount> rows;
    for (std::size_t k = 0; k < kPartCount; ++k) rows[k] = planes[k].ptr<float>(y);
    for (int x = 0; x < size.width; ++x) {
      if (near.at<std::uint8_t>(y, x) == 0) continue;
      std::array<float, kPartCount + 1> z;
      std::copy_n(logits.data() + partLogitIndex(y, x, 0), z.size(), z.begin());
      for (std::size_t k = 0; k < kPartCount; ++k) z[k] += kCorrection[k];
      for (std::size_t k = 0; k < 4; ++k)
        z[static_cast<std::size_t>(limbPart(static_cast<int>(k)))] -=
            kFartherLess * std::max(0.f, static_cast<float>(toLimb(bones, k, Vec(x + .5, y + .5))) - kReach);
      if (!bones.animal)
        for (const std::size_t k : {0, 1})
          z[static_cast<std::size_t>(limbPart(static_cast<int>(k)))] +=
              nearHand(bones.limbs[k], Vec(x + .5, y + .5));
      const float most = *std::max_element(z.begin(), z.begin() + kPartCount);
      std::array<float, kPartCount> p;
      float sum = 0;
      for (std::size_t k = 0; k < kPartCount; ++k) sum += p[k] = std::exp(z[k] - most);
      for (std::size_t k = 0; k < kPartCount; ++k) {
        rows[k][x] = p[k] /= sum;
        highest[k] = std::max(highest[k], p[k]);
      }
      if (mask.at<std::uint8_t>(y, x) == 0) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        const double mine = p[static_cast<std::size_t>(limbPart(static_cast<int>(k)))];
        if (mine < .5) continue;
        weight[k] += 1;
        picture.sure[k] += mine;
        picture.before[k] += 1 / (1 + std::exp(-static_cast<double>(z[kPartCount])));
      }
    }
  }
  for (std::size_t k = 0; k < 4; ++k)
    if (weight[k] > 0) picture.sure[k] /= weight[k], picture.before[k] /= weight[k];
  for (std::size_t k = 0; k < kPartCount; ++k)
    if (highest[k] < kLeastSeen) planes[k].release();
  return planes;
}

cv::Mat disc(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * radius + 1, 2 * radius + 1));
}

int px(const Sketch& picture, double share) {
  return std::max(1, cvRound(share * std::max(picture.rgb.cols, picture.rgb.rows)));
}

// Fills `range` and `ink`.
void findInk(Sketch& picture) {
  cv::Mat grey, closed;
  cv::transform(picture.rgb, grey, cv::Matx13f(.299f, .587f, .114f));
  double low = 0, high = 0;
  cv::minMaxLoc(grey, &low, &high, nullptr, nullptr, picture.mask);
  picture.range = std::max(40., high - low);
  // What is not the figure lets no line of it end.
  grey.setTo(255, picture.mask == 0);
  cv::morphologyEx(grey, closed, cv::MORPH_CLOSE, disc(px(picture, kLineWidth / 2)));
  picture.ink = ((closed - grey) > kInkContrast * picture.range) & picture.mask;
}

// What probabilities say of each px.
struct Said {
  static constexpr std::uint16_t kSure = 1 << 15;
  static_assert(kPartCount < 15);
  cv::Mat best;   // CV_8U: the most probable part
  cv::Mat parts;  // CV_16U, bits: those that are possible here; kSure: the best is certain
};

// Of the planes' size, then of that one.
Said whatIsSaid(const std::vector<cv::Mat>& probabilities, const cv::Size& size) {
  const auto there = std::find_if(probabilities.begin(), probabilities.end(),
                                  [](const cv::Mat& plane) { return !plane.empty(); });
  const cv::Size said_size = there == probabilities.end() ? size : there->size();
  Said said{cv::Mat(said_size, CV_8U, cv::Scalar(0)), cv::Mat(said_size, CV_16U, cv::Scalar(0))};
  for (int y = 0; y < said_size.height; ++y) {
    std::array<const float*, kPartCount> rows{};
    for (std::size_t k = 0; k < kPartCount; ++k)
      if (!probabilities[k].empty()) rows[k] = probabilities[k].ptr<float>(y);
    auto* best = said.best.ptr<std::uint8_t>(y);
    auto* parts = said.parts.ptr<std::uint16_t>(y);
    for (int x = 0; x < said_size.width; ++x) {
      float most = -1;
      for (std::size_t k = 0; k < kPartCount; ++k) {
        if (rows[k] == nullptr) continue;
        const float p = rows[k][x];
        if (p > most) most = p, best[x] = static_cast<std::uint8_t>(k);
        if (p >= kPossible) parts[x] = static_cast<std::uint16_t>(parts[x] | 1 << k);
      }
      if (most >= kCertain) parts[x] |= Said::kSure;
    }
  }
  cv::resize(said.best, said.best, size, 0, 0, cv::INTER_NEAREST);
  cv::resize(said.parts, said.parts, size, 0, 0, cv::INTER_NEAREST);
  return said;
}

// Borders move onto the drawing's edges where the net is not certain: parts flood what lies between them,
// flat colours first (F. Meyer, "Color image segmentation", 1992).
void snap(const std::vector<cv::Mat>& probabilities, Sketch& picture) {
  const cv::Size size = picture.rgb.size();
  const Said said = whatIsSaid(probabilities, size);
  cv::Mat markers(size, CV_32S);
  for (int y = 0; y < size.height; ++y) {
    const auto* inside = picture.mask.ptr<std::uint8_t>(y);
    const auto* best = said.best.ptr<std::uint8_t>(y);
    const auto* parts = said.parts.ptr<std::uint16_t>(y);
    auto* marker = markers.ptr<int>(y);
    for (int x = 0; x < size.width; ++x)
      marker[x] = inside[x] == 0 ? kPartCount + 1 : (parts[x] & Said::kSure) != 0 ? best[x] + 1 : 0;
  }
  cv::Mat smooth;
  cv::GaussianBlur(picture.rgb, smooth, cv::Size(3, 3), 0);
  cv::watershed(smooth, markers);
  picture.part = cv::Mat(size, CV_8U, cv::Scalar(0));
  for (int y = 0; y < size.height; ++y) {
    const auto* best = said.best.ptr<std::uint8_t>(y);
    const auto* parts = said.parts.ptr<std::uint16_t>(y);
    const auto* marker = markers.ptr<int>(y);
    auto* out = picture.part.ptr<std::uint8_t>(y);
    for (int x = 0; x < size.width; ++x) {
      const int part = marker[x] - 1;
      // Not along a line to where the net sees nothing of it.
      const bool possible = part >= 0 && part < kPartCount && (parts[x] >> part & 1) != 0;
      out[x] = possible ? static_cast<std::uint8_t>(part) : best[x];
    }
  }
}

// The part takes the lines of `from` that it is drawn with.
void takeInk(Sketch& picture, Part part, const cv::Mat& from) {
  cv::Mat own = picture.of(part);
  for (int step = px(picture, kInkReach); step > 0; --step) {
    cv::Mat grown;
    cv::dilate(own, grown, cv::Mat::ones(3, 3, CV_8U));
    own |= grown & picture.ink & from;
  }
  // Lines that only end at the part are not of it.
  cv::Mat broad;
  cv::morphologyEx(own, broad, cv::MORPH_OPEN, disc(px(picture, kStub)));
  own &= broad | picture.of(part);
  picture.part.setTo(static_cast<int>(part), own);
}

// Limbs in front take their lines from all that is behind them, the trunk its own from limbs behind it.
void shareInk(Sketch& picture) {
  cv::Mat behind = cv::Mat::zeros(picture.part.size(), CV_8U);
  for (int k = 0; k < 4; ++k) {
    const double before = picture.before[static_cast<std::size_t>(k)];
    if (before < .5) {
      behind |= picture.of(limbPart(k));
      continue;
    }
    cv::Mat others = cv::Mat::zeros(picture.part.size(), CV_8U);
    for (int j = 0; j < 4; ++j)
      if (j != k && picture.before[static_cast<std::size_t>(j)] >= before) others |= picture.of(limbPart(j));
    takeInk(picture, limbPart(k), ~others);
  }
  takeInk(picture, Part::kTrunk, behind);
}

// Small pieces of a part apart from its largest go to what surrounds them. What is outside of the figure,
// too, so that at any scale its rim has the parts that end there.
void removeIslands(Sketch& picture) {
  cv::Mat moved = cv::Mat::zeros(picture.part.size(), CV_8U);
  for (int part = 0; part < kPartCount; ++part) {
    const cv::Mat own = picture.of(static_cast<Part>(part));
    const cv::Rect box = cv::boundingRect(own);
    if (box.empty()) continue;
    const MaskParts pieces = maskParts(planeOf(own(box)));
    const auto sizeOf = [&](int piece) {
      return static_cast<double>(pieces.size[static_cast<std::size_t>(piece)]);
    };
    const double least = kIsland * sizeOf(pieces.largest());
    for (const MaskParts::Run& run : pieces.runs)
      if (sizeOf(run.part) < least) moved(box).row(run.y).colRange(run.x0, run.x1).setTo(255);
  }
  cv::Mat distance, labels;
  const cv::Mat open = moved | ~picture.mask;
  cv::distanceTransform(open, distance, labels, cv::DIST_L2, 3, cv::DIST_LABEL_PIXEL);
  double last = 0;
  cv::minMaxLoc(labels, nullptr, &last);
  std::vector<std::uint8_t> of(static_cast<std::size_t>(last) + 1, 0);
  for (int y = 0; y < open.rows; ++y)
    for (int x = 0; x < open.cols; ++x)
      if (open.at<std::uint8_t>(y, x) == 0)
        of[static_cast<std::size_t>(labels.at<int>(y, x))] = picture.part.at<std::uint8_t>(y, x);
  for (int y = 0; y < open.rows; ++y)
    for (int x = 0; x < open.cols; ++x)
      if (open.at<std::uint8_t>(y, x) != 0)
        picture.part.at<std::uint8_t>(y, x) = of[static_cast<std::size_t>(labels.at<int>(y, x))];
}

}  // namespace

PartPicture findParts(const Image& image, const Plane8& mask, const PartSkeleton& skeleton,
                      const PartNet& net) {
  Sketch sketch;
  sketch.box = figureBox(mask);
  SKEL_CHECK(sketch.box.width() > 0);
  cut(image, mask, sketch);
  std::vector<cv::Mat> probabilities =
      ask(net, scaled(skeleton, Vec(sketch.box.x0, sketch.box.y0), sketch.scale), sketch);
  findInk(sketch);
  spreadParts(sketch.rgb, sketch.mask, sketch.range, probabilities);
  snap(probabilities, sketch);
  shareInk(sketch);
  removeIslands(sketch);
  PartPicture picture{sketch.box, sketch.scale, {}, {}, {}, sketch.sure, sketch.before, sketch.range};
  picture.mask = planeOf(sketch.mask), picture.part = planeOf(sketch.part);
  picture.rgb.assign(sketch.rgb.ptr<std::uint8_t>(), sketch.rgb.ptr<std::uint8_t>() + 3 * sketch.rgb.total());
  return picture;
}

}  // namespace skel
