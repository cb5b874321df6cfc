// What is drawn on a photographed sheet of paper, whose light is uneven.
#pragma once

namespace cv {
class Mat;
}

namespace skel {

// Strokes, and fills that are surely none of the shadows on a sheet of paper: those change the lightness
// alone and leave more than half of it.
cv::Mat drawnOnPaper(const cv::Mat& lab, const cv::Mat& strokes, const cv::Mat& far);

// Edges of fills (Canny 1986), one pixel wide. Those of creases are among them, but enclose nothing; those of
// shadows are left out where they run to the border of the picture.
cv::Mat edgesOnPaper(const cv::Mat& lab);

}  // namespace skel
