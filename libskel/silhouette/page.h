// A sheet of paper that lies on something else, and how it looks from straight above.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace cv {
class Mat;
}

namespace skel {

// Corners clockwise from the top left, px of the picture (origin at the centre of the top left pixel).
using PageCorners = std::array<Eigen::Vector2d, 4>;

// The quadrilateral whose four sides have paper within and something darker or more coloured without along
// most of their length, whatever pattern that has. `lab`: 8-bit (working_colors.h). Nothing where the paper
// fills the picture, or where less than half of the picture's width or height is paper.
//
// Lines come from the Hough transform of edges (Duda, Hart 1972), each with the side on which it has paper;
// of all quadrilaterals of the strongest lines the one with the fullest sides is taken.
std::optional<PageCorners> findPage(const cv::Mat& lab);

// Long side of the sheet straightened, px.
inline constexpr int kPageSize = 640;

// 3×3, CV_64F: the perspective that takes the picture to the sheet seen from straight above, a little of its
// rim cut off. `size` becomes {width, height} of that in px.
cv::Mat pageFromPicture(const PageCorners& corners, std::array<int, 2>& size);

}  // namespace skel
