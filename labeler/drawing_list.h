// The drawings that a folder holds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/image/image.h"

namespace skel {

struct Progress {
  int parts = 0, done = 0;  // 0 parts: not looked at yet

  bool isWhole() const { return parts > 0 && done == parts; }
};

struct DrawingFiles {
  std::string name;   // below the folder
  std::string image;  // paths
  std::string labels;
  std::string mask;  // where a mended mask is saved: <stem>.mask.png, <stem>-2.mask.png of the second figure
};

// Where a painted layer map is saved: <stem>.limbs.png, <stem>-2.limbs.png for the second figure, and so on.
std::string layersFile(const DrawingFiles& files, int figure);

// A mask that lies beside the drawing: <stem>.mask.png, or mask.png beside image.png and texture.png.
std::optional<std::string> givenMask(const DrawingFiles& files);

// <stem>.skeleton.json beside the drawing, whether it is there or not.
std::string skeletonBeside(const DrawingFiles& files);
// The body plan of <stem>.skeleton.json beside the drawing, if that was found in this picture; else "".
std::string planOfSkeletonBeside(const DrawingFiles& files, const std::string& image_sha256);

// The path of what a file names beside itself.
std::string besideFile(const std::string& file, const std::string& name);
// A file that says where joints are in a picture of that size must mean this picture; throws InputError, with
// the place in the file, if it does not.
void checkMeansPicture(const Image& image, const std::string& image_path, int width, int height,
                       const std::string& file, const std::string& place);

DrawingFiles drawingFiles(const std::string& image, const std::string& name, int figure = 1);

// Pictures at any depth below `dir`, in natural order; not masks and what skel-infer writes (mask.png,
// <stem>.mask.png, .limbs.png, .layers.png, .silhouette.png, .overlay.png) and not those that lie beside
// what they were converted to. Throws InputError: no folder, no picture in it, two pictures that would share
// a label file.
std::vector<DrawingFiles> findDrawings(const std::string& dir);

}  // namespace skel
