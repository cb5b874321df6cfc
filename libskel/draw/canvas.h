// Drawing on pictures, anti-aliased. Points are image px (origin at the centre of the top left pixel),
// whatever lies outside is cut off, colours are blended over what is there.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/draw/color.h"
#include "libskel/image/image.h"

namespace skel {

using Points = std::vector<Eigen::Vector2d>;

Image blankImage(int width, int height, Color color = kWhite);

void drawLine(Image& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width_px, Color color);
// One stroke: overlaps of a translucent line are not blended twice.
void drawPolyline(Image& image, const Points& points, double width_px, Color color, bool closed = false);
void drawDisc(Image& image, const Eigen::Vector2d& center, double radius_px, Color color);
// The line's middle is at the radius.
void drawCircle(Image& image, const Eigen::Vector2d& center, double radius_px, double width_px, Color color);
// Even-odd: a polygon inside another is a hole.
void fillPolygons(Image& image, const std::vector<Points>& polygons, Color color);
// Tints where the mask is 128 or more. The mask has the image's size.
void drawMask(Image& image, const Plane8& mask, Color color);

// The other picture over this one, its top left pixel at (x, y).
void blit(Image& image, const Image& other, int x, int y);
// Mean of the area when shrinking, bilinear when growing. width, height >= 1.
Image resized(const Image& image, int width, int height);
// The largest size of the same proportions within the box.
Image fitted(const Image& image, int max_width, int max_height);
// Scaled and cut to cover the size, its middle in the middle.
Image covering(const Image& picture, int width, int height);
// Pixels as squares, factor >= 1: to look at the working grid. A point p of the grid is then at
// (p + 0.5) · factor − 0.5.
Image magnified(const Image& image, int factor);

// Heat colours, 0 darkest and the largest value lightest; cells <= 0 are clear.
Image heatMap(const Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& field);

// Latin letters, with their marks, in a stroke font of our own (UTF-8); what it does not have shows as a box.
// `height_px`: of capitals, which stand on origin.y and start at origin.x.
void drawText(Image& image, const Eigen::Vector2d& origin, std::string_view text, double height_px,
              Color color = kInk);
double textWidth(std::string_view text, double height_px);

struct Panel {
  Image image;
  std::string label;
};
struct MontageOptions {
  int columns = 0;  // 0: all in one row
  int gap_px = 12;
  double label_height_px = 11;  // of capitals
  Color background = kWhite;
};
// Panels side by side in cells of equal size, each centred over its label.
Image montage(const std::vector<Panel>& panels, const MontageOptions& options = {});

}  // namespace skel
