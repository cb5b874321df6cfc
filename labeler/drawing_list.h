// The drawings that a folder holds.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace skel {

struct DrawingFiles {
  std::string name;   // below the folder
  std::string image;  // paths
  std::string labels;
  std::string mask;  // <stem>.mask.png: where a mended mask is saved
};

// Where a painted layer map is saved: <stem>.limbs.png, <stem>-2.limbs.png for the second figure, and so on.
std::string layersFile(const DrawingFiles& files, int figure);

// A mask that lies beside the drawing: <stem>.mask.png, or mask.png beside image.png and texture.png.
std::optional<std::string> givenMask(const DrawingFiles& files);

DrawingFiles drawingFiles(const std::string& image, const std::string& name);

// Pictures at any depth below `dir`, in natural order; not masks and what skel-infer writes (mask.png,
// <stem>.mask.png, .limbs.png, .layers.png, .silhouette.png, .overlay.png). Throws InputError: no folder, no
// picture in it, two pictures that would share a label file.
std::vector<DrawingFiles> findDrawings(const std::string& dir);

}  // namespace skel
