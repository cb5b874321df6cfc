#include "labeler/drawing_list.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/foreign_files.h"
#include "libskel/core/natural_order.h"
#include "libskel/image/check_image.h"
#include "libskel/image/result_picture.h"
#include "libskel/labels/label_file.h"
#include "libskel/mended/mend_places.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {
namespace fs = std::filesystem;

DrawingFiles drawingFiles(const std::string& image, const std::string& name, int figure) {
  return {name, image, labelFileFor(image),
          stemOfFigure(fs::path(image).replace_extension().string(), figure) + ".mask.png"};
}

std::string layersFile(const DrawingFiles& files, int figure) {
  return stemOfFigure(fs::path(files.image).replace_extension().string(), figure) + ".limbs.png";
}

std::optional<std::string> givenMask(const DrawingFiles& files) {
  if (const auto mask = maskBeside(files.image)) return mask;
  const fs::path image = files.image, beside = image.parent_path() / "mask.png";
  if (image.stem() == "texture" && fs::is_regular_file(beside)) return beside.string();
  return std::nullopt;
}

std::vector<DrawingFiles> findDrawings(const std::string& dir) {
  std::vector<DrawingFiles> drawings;
  std::vector<std::string> pictures = filesBelow(dir);
  std::erase_if(pictures,
                [](const std::string& file) { return !isDrawingName(fs::path(file).filename().string()); });
  passOverConverted(pictures);
  for (const std::string& file : pictures)
    drawings.push_back(drawingFiles(file, fs::path(file).lexically_relative(dir).generic_string()));
  if (drawings.empty()) throw InputError(dir, "holds no picture (" + std::string(kPictureEndings) + ")");
  std::sort(drawings.begin(), drawings.end(),
            [](const DrawingFiles& a, const DrawingFiles& b) { return comesBefore(a.name, b.name); });
  std::map<std::string, std::string> image_of;  // by label file
  for (const DrawingFiles& drawing : drawings)
    if (const auto [other, is_new] = image_of.emplace(drawing.labels, drawing.image); !is_new)
      throw InputError(drawing.image,
                       "would share its label file with " + other->second + "; rename one of them");
  return drawings;
}

std::string skeletonBeside(const DrawingFiles& files) {
  return fs::path(files.image).replace_extension().string() + kSkeletonFileEnding;
}

std::string planOfSkeletonBeside(const DrawingFiles& files, const std::string& image_sha256) {
  const std::string path = skeletonBeside(files);
  const std::optional<SkeletonSource> source = sourceOfSkeleton(path);
  return source && source->image_sha256 == image_sha256 ? templateOfSkeleton(readFile(path), path) : "";
}

std::string besideFile(const std::string& file, const std::string& name) {
  return (fs::path(file).parent_path() / name).lexically_normal().string();
}

void checkMeansPicture(const Image& image, const std::string& image_path, int width, int height,
                       const std::string& file, const std::string& place) {
  if (width != image.width || height != image.height)
    throw InputError(file, place + ": has " + sizeInPx(width, height) + " px, " + image_path + " has " +
                               sizeInPx(image.width, image.height) + "; find the joints anew");
}

}  // namespace skel
