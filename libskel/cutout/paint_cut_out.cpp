#include "libskel/cutout/paint_cut_out.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "libskel/core/check.h"
#include "libskel/draw/canvas.h"

namespace skel {
namespace {

using Eigen::Vector2d;

constexpr int kSamples = 2;  // each way, a pixel

// Colours multiplied by their alpha, which is the last.
using Sample = std::array<std::uint8_t, 4>;

int divided255(int value) { return (value + 128 + ((value + 128) >> 8)) >> 8; }

// Samples of the part of a picture in which something is painted.
struct SampleBox {
  int x0 = 0, y0 = 0, width = 0, height = 0;
  std::vector<Sample> samples;
};

// What a square shows: where its texture lies, and, where other copies of the square have pixels in it, which
// pixels are its own.
struct SquareTexture {
  const Image& image;
  const Eigen::Array<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>* square_of;  // or null: all are
  int square;
  int x0, y0, x1, y1;  // the square, texels

  bool shows(int x, int y) const {
    if (!square_of || x < x0 || y < y0 || x >= x1 || y >= y1) return true;
    const int of = (*square_of)(y, x);
    return of < 0 || of == square;
  }

  // Between the four nearest texels; `x`, `y` in 256ths of a texel. Texels of other copies do not count, so
  // that there is no seam where two are cut apart.
  Sample at(int x, int y) const {
    const int left = x >> 8, top = y >> 8, tx = x & 255, ty = y & 255;
    int all = 256 * 256;
    std::array<int, 4> sum{0, 0, 0, 0};
    for (int k = 0; k < 4; ++k) {
      const int u = left + k % 2, v = top + k / 2;
      const int weight = (k % 2 ? tx : 256 - tx) * (k / 2 ? ty : 256 - ty);
      if (weight == 0 || u < 0 || v < 0 || u >= image.width || v >= image.height) continue;
      if (!shows(u, v)) {
        all -= weight;
        continue;
      }
      const std::uint8_t* p = image.pixel(u, v);
      for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * p[c];
    }
    Sample result{0, 0, 0, 0};
    if (all > 0)
      for (std::size_t c = 0; c < 4; ++c) result[c] = std::uint8_t((sum[c] + all / 2) / all);
    return result;
  }
};

// `p`: in samples, `q`: in texels.
void paintTriangle(const std::array<Vector2d, 3>& p, const std::array<Vector2d, 3>& q,
                   const SquareTexture& texture, SampleBox& box) {
  const Vector2d e1 = p[1] - p[0], e2 = p[2] - p[0];
  const double area = e1.x() * e2.y() - e1.y() * e2.x();
  if (!(std::abs(area) > 1e-9)) return;
  Eigen::Matrix2d shape;
  shape << e2.y(), -e2.x(), -e1.y(), e1.x();
  Eigen::Matrix2d sides;
  sides << q[1] - q[0], q[2] - q[0];
  const Eigen::Matrix2d texels = sides * shape / area;  // a sample further
  const double low = std::min({p[0].y(), p[1].y(), p[2].y()}),
               high = std::max({p[0].y(), p[1].y(), p[2].y()});
  const int y0 = std::max(box.y0, int(std::ceil(low))),
            y1 = std::min(box.y0 + box.height - 1, int(std::floor(high)));
  for (int y = y0; y <= y1; ++y) {
    double from = 1e300, to = -1e300;
    for (std::size_t k = 0; k < 3; ++k) {
      // The same way along a side for both triangles that have it.
      const bool down = p[k].y() < p[(k + 1) % 3].y();
      const Vector2d &a = p[down ? k : (k + 1) % 3], &b = p[down ? (k + 1) % 3 : k];
      if (a.y() > y || b.y() < y) continue;
      if (a.y() == b.y()) {
        from = std::min({from, a.x(), b.x()}), to = std::max({to, a.x(), b.x()});
        continue;
      }
      const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      from = std::min(from, x), to = std::max(to, x);
    }
    // A sample on a side between two triangles is one triangle's alone.
    const int x0 = std::max(box.x0, int(std::ceil(from))),
              x1 = std::min(box.x0 + box.width, int(std::ceil(to)));
    Sample* out = box.samples.data() + std::ptrdiff_t(y - box.y0) * box.width - box.x0;
    for (int x = x0; x < x1; ++x) {
      const Vector2d at = q[0] + texels * (Vector2d(x, y) - p[0]);
      const Sample color =
          texture.at(int(std::floor(at.x() * 256 + 0.5)), int(std::floor(at.y() * 256 + 0.5)));
      if (color[3] == 0) continue;
      const int through = 255 - color[3];
      for (std::size_t c = 0; c < 4; ++c)
        out[x][c] = std::uint8_t(color[c] + divided255(through * out[x][c]));
    }
  }
}

}  // namespace

CutOutPainter::CutOutPainter(const CutOut& cut_out, double px_per_m) : cut_out_(cut_out) {
  for (const CutOutSheet& sheet : cut_out.sheets) {
    Texture& texture = textures_.emplace_back();
    const Image& picture = sheet.picture;
    // As many texels as samples: a film smaller than the drawing shows means of its pixels.
    const double scale = std::min(1., kSamples * px_per_m * sheet.placed.scale.x());
    const int width = std::max(1, int(std::lround(scale * picture.width)));
    texture.scale = double(width) / picture.width;
    const int height = std::max(1, int(std::lround(texture.scale * picture.height)));
    texture.image = resized(picture, width, height);
    texture.square_of.setConstant(height, width, -1);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        std::uint8_t* p = texture.image.pixel(x, y);
        for (int c = 0; c < 3; ++c) p[c] = std::uint8_t(divided255(p[c] * p[3]));
        const int u = std::min(picture.width - 1, int((x + 0.5) / texture.scale)),
                  v = std::min(picture.height - 1, int((y + 0.5) / texture.scale));
        texture.square_of(y, x) = sheet.lattice.square_of(v, u);
      }
  }
}

void CutOutPainter::paint(const std::vector<Eigen::MatrixX2d>& places, Image& image) const {
  SKEL_CHECK_EQ(places.size(), cut_out_.sheets.size());
  if (image.empty()) return;
  Vector2d low = Vector2d::Constant(1e9), high = -low;
  for (const Eigen::MatrixX2d& sheet : places) {
    low = low.cwiseMin(sheet.colwise().minCoeff().transpose());
    high = high.cwiseMax(sheet.colwise().maxCoeff().transpose());
  }
  const auto inside = [](double at, int most) { return int(std::clamp(std::floor(at), 0., double(most))); };
  const int left = inside(low.x(), image.width), top = inside(low.y(), image.height),
            right = inside(high.x() + 2, image.width), bottom = inside(high.y() + 2, image.height);
  if (right <= left || bottom <= top) return;
  SampleBox box{kSamples * left, kSamples * top, kSamples * (right - left), kSamples * (bottom - top), {}};
  box.samples.assign(std::size_t(box.width) * std::size_t(box.height), Sample{0, 0, 0, 0});

  for (const CutOut::Patch& patch : cut_out_.patches) {
    const CutOutSheet& sheet = cut_out_.sheets[patch.sheet];
    const Texture& texture = textures_[patch.sheet];
    const Lattice& lattice = sheet.lattice;
    const std::array<int, 4>& square = lattice.squares[patch.square];
    const auto texel = [&](double px) { return (px + 0.5) * texture.scale - 0.5; };
    const Eigen::Vector2i corner = lattice.corners_px[patch.square];
    const SquareTexture shown{texture.image,
                              lattice.alone[patch.square] ? nullptr : &texture.square_of,
                              int(patch.square),
                              int(std::ceil(corner.x() * texture.scale)),
                              int(std::ceil(corner.y() * texture.scale)),
                              int(std::ceil((corner.x() + lattice.side_px) * texture.scale)),
                              int(std::ceil((corner.y() + lattice.side_px) * texture.scale))};
    std::array<Vector2d, 4> p, q;
    for (std::size_t k = 0; k < 4; ++k) {
      // Sample i lies at (i + ½) / kSamples − ½ px.
      const Vector2d at = places[patch.sheet].row(square[k]), rest = lattice.vertices.row(square[k]);
      p[k] = ((at.array() + 0.5) * kSamples - 0.5).matrix();
      q[k] = {texel(rest.x()), texel(rest.y())};
    }
    for (const auto& [a, b, c] : lattice.halves(patch.square))
      paintTriangle({p[a], p[b], p[c]}, {q[a], q[b], q[c]}, shown, box);
  }

  constexpr int kAll = kSamples * kSamples;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      std::array<int, 4> sum{};
      for (int k = 0; k < kAll; ++k) {
        const Sample& s =
            box.samples[std::size_t(kSamples * (y - top) + k / kSamples) * std::size_t(box.width) +
                        std::size_t(kSamples * (x - left) + k % kSamples)];
        for (std::size_t c = 0; c < 4; ++c) sum[c] += s[c];
      }
      if (sum[3] == 0) continue;
      // Over what is there, with straight alpha.
      std::uint8_t* out = image.pixel(x, y);
      const int under = out[3] * (255 * kAll - sum[3]), all = 255 * sum[3] + under;
      for (std::size_t c = 0; c < 3; ++c)
        out[c] = std::uint8_t((255 * 255 * sum[c] + out[c] * under + all / 2) / all);
      out[3] = std::uint8_t((all + 255 * kAll / 2) / (255 * kAll));
    }
}

}  // namespace skel
