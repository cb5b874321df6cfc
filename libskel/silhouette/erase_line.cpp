#include "libskel/silhouette/erase_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "libskel/core/check.h"
#include "libskel/silhouette/levels.h"

namespace skel {
namespace {

class LineEraser {
 public:
  LineEraser(const RuledLine& line, const cv::Rect& box, double line_px, Image& image)
      : line_(line), image_(image), half_(cvCeil(2 * line_px)), beside_(2 + cvCeil(line_px)) {
    SKEL_CHECK(line.points.size() >= 2);
    begin_ = line.upright ? box.y : box.x;
    end_ = line.upright ? box.br().y : box.br().x;
    low_ = line.upright ? box.x : box.y;
    high_ = line.upright ? box.br().x : box.br().y;
  }

  bool erase(const Plane8& figure) {
    const std::optional<Eigen::Array3f> darkened = darkening(figure);
    if (!darkened) return false;
    for (int along = begin_; along < end_; ++along) {
      const int middle = middleAt(along);
      const std::optional<Eigen::Array3f> side = sideAt(along, middle);
      if (!side) continue;
      for (int across = middle - half_; across <= middle + half_; ++across) {
        std::uint8_t* p = pixel(along, across);
        constexpr float kInk = 0.75f;  // of what the line leaves of the paper
        if (Eigen::Array3f(p[0], p[1], p[2]).mean() < kInk * (*side * *darkened).mean()) continue;
        for (int c = 0; c < 3; ++c)
          p[c] = toByte(std::min(std::max<float>(p[c], (*side)[c]), p[c] / (*darkened)[c]));
      }
    }
    return true;
  }

 private:
  std::uint8_t* pixel(int along, int across) {
    return line_.upright ? image_.pixel(across, along) : image_.pixel(along, across);
  }

  int middleAt(int along) const {
    const int l = line_.upright ? 1 : 0, c = 1 - l;
    std::size_t next = 1;
    while (next + 1 < line_.points.size() && line_.points[next][l] < along) ++next;
    const Eigen::Vector2d &a = line_.points[next - 1], &b = line_.points[next];
    return cvRound(a[c] + (b[c] - a[c]) * (along - a[l]) / (b[l] - a[l]));
  }

  // The darker of what is lightest on either side.
  std::optional<Eigen::Array3f> sideAt(int along, int middle) {
    if (middle - half_ - beside_ < low_ || middle + half_ + beside_ >= high_) return {};
    Eigen::Array3f sides[2] = {Eigen::Array3f::Zero(), Eigen::Array3f::Zero()};
    for (int i = half_ + 1; i <= half_ + beside_; ++i)
      for (int s = 0; s < 2; ++s) {
        const std::uint8_t* p = pixel(along, middle + (s == 0 ? -i : i));
        sides[s] = sides[s].max(Eigen::Array3f(p[0], p[1], p[2]));
      }
    return sides[0].min(sides[1]);
  }

  // What the line leaves of bare paper, of 1, where it is rather dark; nothing where it is hardly seen.
  std::optional<Eigen::Array3f> darkening(const Plane8& figure) {
    std::array<std::vector<float>, 3> left;
    for (int along = begin_; along < end_; ++along) {
      const int middle = middleAt(along);
      const std::optional<Eigen::Array3f> side = sideAt(along, middle);
      if (!side || side->minCoeff() < 1) continue;
      Eigen::Array3f darkest = Eigen::Array3f::Ones();
      bool bare = true;
      for (int across = middle - half_; across <= middle + half_; ++across) {
        bare = bare && (line_.upright ? figure(along, across) : figure(across, along)) == 0;
        const std::uint8_t* p = pixel(along, across);
        darkest = darkest.min(Eigen::Array3f(p[0], p[1], p[2]) / *side);
      }
      if (!bare) continue;
      for (std::size_t c = 0; c < 3; ++c) left[c].push_back(darkest[Eigen::Index(c)]);
    }
    constexpr std::size_t kFew = 20;
    constexpr float kHardlySeen = 0.97f, kDarkestLine = 0.4f;
    if (left[0].size() < kFew) return {};
    Eigen::Array3f result;
    float seen = 1;
    for (std::size_t c = 0; c < 3; ++c) {
      seen = std::min(seen, static_cast<float>(median(left[c])));
      const auto dark = left[c].begin() + static_cast<std::ptrdiff_t>(left[c].size() / 5);
      std::nth_element(left[c].begin(), dark, left[c].end());
      result[Eigen::Index(c)] = std::max(kDarkestLine, *dark);
    }
    if (seen > kHardlySeen) return {};
    return result;
  }

  const RuledLine& line_;
  Image& image_;
  int half_, beside_;             // px across
  int begin_, end_, low_, high_;  // of the box, along and across
};

}  // namespace

bool eraseLine(const RuledLine& line, const Plane8& figure, const Eigen::Array4i& box, double line_px,
               Image& image) {
  return LineEraser(line, {box[0], box[1], box[2], box[3]}, line_px, image).erase(figure);
}

}  // namespace skel
