// A drawing whose joints and silhouette are known, and how far a result is from them.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/recognition/recognition.h"
#include "libskel/skeleton/template.h"

namespace skel {

// image.png, and beside it joints.json where the figure is annotated, and mask.png; or <name>.png,
// <name>.joints.json and <name>.mask.png; what a person has placed in <name>.labels.json (image.labels.json)
// counts before those.
struct MeasuredDrawing {
  std::string id;  // folder or name relative to the set's; "": the set is the folder of one drawing
  Image image;
  std::string image_sha256;    // of its file's bytes
  std::optional<Plane8> mask;  // none: the silhouette is not measured
  bool side_view = false;
  std::map<std::string, std::optional<Eigen::Vector2d>>
      joints;               // image px; empty: not annotated; null: not visible
  std::string joints_file;  // which names them; a label file where there is no other
  std::string overruled;    // the label file that places joints elsewhere than the joints file; "": none
  std::string overruled_skeleton;  // without a joints file, the skeleton file that places them elsewhere
};

// All below `root`, sorted. Throws InputError if there are none.
std::vector<std::string> findDrawings(const std::string& root);
// picturesWithout() joints that a person has placed.
std::string unmeasuredAmong(const std::string& root);
// Notes all files that readMeasuredDrawing() may read (input_guard.h).
void noteMeasuredFiles(const std::string& root, const std::string& id);
MeasuredDrawing readMeasuredDrawing(const std::string& root, const std::string& id);
// What a drawing is called: its id, or the name of the set's folder.
std::string nameOfDrawing(const std::string& root, const std::string& id);
// The body plan whose joints these are, if it is not that one but another that skel brings along; else "".
std::string otherPlanOf(const MeasuredDrawing& drawing, const SkeletonTemplate& body_plan);
// A quarter turn clockwise, `quarters` times.
void turnClockwise(MeasuredDrawing& drawing, int quarters);
// Whether any pixel is less than half opaque.
bool isTransparent(const Image& image);

// Errors are relative to L, the long side of the bounding box of the true mask, or of the silhouette that was
// found where the true one is not known.
struct Score {
  double pck05 = 0, pck10 = 0;                  // share of annotated joints within 0.05 L, 0.10 L
  double error = 1;                             // mean
  double usable = 0;                            // 1: every annotated joint within 0.15 L
  std::optional<double> limbs;                  // share of the limbs' ends within 0.15 L; none annotated
  std::optional<double> inside;                 // share of found joints on the true mask, 2 px of slack
  std::optional<double> iou;                    // of the silhouette; neither without a true mask
  int annotated = 0, sure = 0, sure_right = 0;  // joints; of confidence >= 0.8; of those within 0.10 L
  int taken_over = 0;                           // joints that are annotated exactly where they are found
  double confidence = 0, likeness = 0;
  std::string worst_joint;  // "": none is off
};

// Of the joints that `body_plan` does not derive. `recognition` null: nothing was found.
Score score(const MeasuredDrawing& truth, const Recognition* recognition, const Plane8& silhouette_mask,
            const SkeletonTemplate& body_plan);

}  // namespace skel
