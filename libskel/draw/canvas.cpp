#include "libskel/draw/canvas.h"

#include <algorithm>
#include <cmath>

#include "libskel/core/check.h"
#include "libskel/core/segment.h"

namespace skel {

namespace {

using Eigen::Vector2d;

void blend(std::uint8_t* pixel, Color color, double coverage) {
  const double source = color.a / 255.0 * coverage;
  if (source <= 0) return;
  const double below = pixel[3] / 255.0 * (1 - source), alpha = source + below;
  const double channels[3] = {double(color.r), double(color.g), double(color.b)};
  for (int c = 0; c < 3; ++c)
    pixel[c] = std::uint8_t(std::lround((channels[c] * source + pixel[c] * below) / alpha));
  pixel[3] = std::uint8_t(std::lround(alpha * 255));
}

// Pixels of the image whose centres lie within a box of image points, or next to it.
struct PixelBox {
  int x0, y0, x1, y1;  // x1, y1 excluded

  PixelBox(const Image& image, const Vector2d& low, const Vector2d& high) {
    const auto clamped = [](double value, int size) { return int(std::clamp(value, 0.0, double(size))); };
    x0 = clamped(std::floor(low.x()), image.width);
    y0 = clamped(std::floor(low.y()), image.height);
    x1 = clamped(std::ceil(high.x()) + 1, image.width);
    y1 = clamped(std::ceil(high.y()) + 1, image.height);
  }
  bool empty() const { return x1 <= x0 || y1 <= y0; }
};

}  // namespace

Image blankImage(int width, int height, Color color) {
  Image image(width, height);
  if (color.r == color.g && color.r == color.b && color.r == color.a) {  // many times faster
    image.rgba.setConstant(color.r);
  } else {
    image.rgba.rowwise() = Eigen::Array<std::uint8_t, 1, 4>(color.r, color.g, color.b, color.a);
  }
  return image;
}

void drawLine(Image& image, const Vector2d& a, const Vector2d& b, double width_px, Color color) {
  drawPolyline(image, {a, b}, width_px, color);
}

void drawPolyline(Image& image, const Points& points, double width_px, Color color, bool closed) {
  if (points.empty()) return;
  // A line thinner than a pixel is a fainter line of one pixel.
  const double radius = std::max(width_px, 1.0) / 2, strength = std::min(width_px, 1.0);
  const Vector2d reach = Vector2d::Constant(radius + 1);
  Vector2d low = points[0], high = points[0];
  for (const Vector2d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const PixelBox box(image, low - reach, high + reach);
  if (box.empty()) return;

  Eigen::ArrayXXf coverage = Eigen::ArrayXXf::Zero(box.x1 - box.x0, box.y1 - box.y0);
  const std::size_t segments = points.size() - (closed || points.size() == 1 ? 0 : 1);
  for (std::size_t i = 0; i < segments; ++i) {
    const Vector2d &a = points[i], &b = points[(i + 1) % points.size()];
    const PixelBox part(image, a.cwiseMin(b) - reach, a.cwiseMax(b) + reach);
    for (int y = part.y0; y < part.y1; ++y)
      for (int x = part.x0; x < part.x1; ++x) {
        const double inside = radius + 0.5 - distanceToSegment(Vector2d(x, y), a, b);
        float& cell = coverage(x - box.x0, y - box.y0);
        cell = std::max(cell, float(std::clamp(inside, 0.0, 1.0)));
      }
  }
  for (int y = box.y0; y < box.y1; ++y)
    for (int x = box.x0; x < box.x1; ++x)
      blend(image.pixel(x, y), color, strength * coverage(x - box.x0, y - box.y0));
}

void drawDisc(Image& image, const Vector2d& center, double radius_px, Color color) {
  drawPolyline(image, {center}, 2 * radius_px, color);
}

void drawCircle(Image& image, const Vector2d& center, double radius_px, double width_px, Color color) {
  const double half = std::max(width_px, 1.0) / 2, strength = std::min(width_px, 1.0);
  const Vector2d reach = Vector2d::Constant(radius_px + half + 1);
  const PixelBox box(image, center - reach, center + reach);
  for (int y = box.y0; y < box.y1; ++y)
    for (int x = box.x0; x < box.x1; ++x) {
      const double off = std::abs((Vector2d(x, y) - center).norm() - radius_px);
      blend(image.pixel(x, y), color, strength * std::clamp(half + 0.5 - off, 0.0, 1.0));
    }
}

void fillPolygons(Image& image, const std::vector<Points>& polygons, Color color) {
  constexpr int kLines = 5;  // scan lines a row of pixels; along a line the coverage is exact
  Vector2d low = Vector2d::Constant(1e18), high = -low;
  for (const Points& polygon : polygons)
    for (const Vector2d& p : polygon) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if (low.x() > high.x()) return;
  const PixelBox box(image, low - Vector2d::Ones(), high + Vector2d::Ones());
  if (box.empty()) return;

  struct Edge {
    Vector2d top, bottom;
  };
  std::vector<std::vector<Edge>> rows(std::size_t(box.y1 - box.y0));  // the edges that reach into each row
  for (const Points& polygon : polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      Vector2d a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      if (a.y() > b.y()) std::swap(a, b);
      const int first = int(std::floor(std::clamp(a.y(), double(box.y0), double(box.y1))));
      const int last = int(std::ceil(std::clamp(b.y(), double(box.y0), double(box.y1))));
      for (int y = first; y <= std::min(last, box.y1 - 1); ++y)
        rows[std::size_t(y - box.y0)].push_back({a, b});
    }

  std::vector<double> crossings, coverage(std::size_t(box.x1 - box.x0));
  for (int y = box.y0; y < box.y1; ++y) {
    std::fill(coverage.begin(), coverage.end(), 0.0);
    for (int line = 0; line < kLines; ++line) {
      const double at = y - 0.5 + (line + 0.5) / kLines;
      crossings.clear();
      for (const Edge& edge : rows[std::size_t(y - box.y0)])
        if (edge.top.y() <= at && at < edge.bottom.y())
          crossings.push_back(edge.top.x() + (at - edge.top.y()) / (edge.bottom.y() - edge.top.y()) *
                                                 (edge.bottom.x() - edge.top.x()));
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const double from = std::max(crossings[i], box.x0 - 0.5);
        const double to = std::min(crossings[i + 1], box.x1 - 0.5);
        for (int x = int(std::floor(from + 0.5)); x < box.x1 && x - 0.5 < to; ++x)
          coverage[std::size_t(x - box.x0)] += std::min(to, x + 0.5) - std::max(from, x - 0.5);
      }
    }
    for (int x = box.x0; x < box.x1; ++x)
      blend(image.pixel(x, y), color, std::clamp(coverage[std::size_t(x - box.x0)] / kLines, 0.0, 1.0));
  }
}

void drawMask(Image& image, const Plane8& mask, Color color) {
  SKEL_CHECK_EQ(mask.rows(), image.height);
  SKEL_CHECK_EQ(mask.cols(), image.width);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (mask(y, x) >= 128) blend(image.pixel(x, y), color, 1);
}

void blit(Image& image, const Image& other, int x, int y) {
  const int x0 = std::max(0, -x), x1 = std::min(other.width, image.width - x);
  const int y0 = std::max(0, -y), y1 = std::min(other.height, image.height - y);
  for (int j = y0; j < y1; ++j)
    for (int i = x0; i < x1; ++i) {
      const std::uint8_t* p = other.pixel(i, j);
      blend(image.pixel(x + i, y + j), {p[0], p[1], p[2], p[3]}, 1);
    }
}

Image heatMap(const Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& field) {
  Image image = blankImage(int(field.cols()), int(field.rows()), kClear);
  if (image.empty()) return image;
  const float top = field.maxCoeff();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (field(y, x) > 0) blend(image.pixel(x, y), heatColor(field(y, x) / top), 1);
  return image;
}

Image montage(const std::vector<Panel>& panels, const MontageOptions& options) {
  if (panels.empty()) return blankImage(1, 1, options.background);
  const int count = int(panels.size());
  const int columns = options.columns > 0 ? std::min(options.columns, count) : count;
  const int rows = (count + columns - 1) / columns;
  int cell_width = 1, cell_height = 1;
  bool labelled = false;
  for (const Panel& panel : panels) {
    const int label_width = int(std::ceil(textWidth(panel.label, options.label_height_px)));
    cell_width = std::max({cell_width, panel.image.width, label_width});
    cell_height = std::max(cell_height, panel.image.height);
    labelled |= !panel.label.empty();
  }
  const int label_space = labelled ? int(std::ceil(options.label_height_px * 2)) : 0;
  const int step_x = cell_width + options.gap_px, step_y = cell_height + label_space + options.gap_px;
  Image image =
      blankImage(columns * step_x + options.gap_px, rows * step_y + options.gap_px, options.background);
  for (int i = 0; i < count; ++i) {
    const auto& [picture, label] = panels[std::size_t(i)];
    const int x = options.gap_px + i % columns * step_x, y = options.gap_px + i / columns * step_y;
    blit(image, picture, x + (cell_width - picture.width) / 2, y + (cell_height - picture.height) / 2);
    drawText(image,
             {x + (cell_width - textWidth(label, options.label_height_px)) / 2,
              y + cell_height + options.label_height_px * 1.6},
             label, options.label_height_px);
  }
  return image;
}

}  // namespace skel
