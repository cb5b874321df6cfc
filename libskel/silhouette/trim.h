// What is taken off a figure once its regions are known.
#pragma once

namespace cv {
class Mat;
}

namespace skel {

// Takes off pixels of `edges` beside the outside: an edge lies half outside of its fill, and one that
// encloses nothing belongs to none.
void dropOuterEdges(cv::Mat& figure, const cv::Mat& edges);

// Takes off the outer pixels that are less than half as strong as their strongest neighbour: where a
// drawing's edge is soft, it lies at half its contrast. Never tears the figure.
void trimSoftEdge(cv::Mat& figure, const cv::Mat& drawn, const cv::Mat& strength);

bool touchesBorder(const cv::Mat& figure);

// Drops what lies along the border of the picture: the table, a finger, the next sheet.
void dropBorderStrips(cv::Mat& figure);

}  // namespace skel
