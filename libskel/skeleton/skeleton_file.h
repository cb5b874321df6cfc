// `<stem>.skeleton.json`: a skeleton that people may look at, mend by hand and hand back.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/skeleton/skeleton.h"
#include "libskel/skeleton/template.h"

namespace skel {

struct SkeletonFile {
  struct Mask {
    std::string file;
    std::string sha256;
  };

  std::string image_file;  // a path relative to the skeleton file
  int image_width = 0, image_height = 0;
  Skeleton skeleton;
  double confidence = 0;
  std::vector<std::string> missing;  // joints that were not found in the drawing
  std::vector<std::string> warnings;
  std::optional<Mask> mask;  // given or mended by hand
};

std::string formatSkeletonFile(const SkeletonFile& file);

// Throws InputError: joints that are not the template's (any order), outside the image, of another parent,
// NaN. Positions are read as they stand; the pipeline computes them anew from `image`.
SkeletonFile readSkeletonFile(const std::string& path, const SkeletonTemplate& body_plan);

// Whether a person has moved a joint in the skeleton file at `path`. False where there is no file.
bool hasEditedJoint(const std::string& path);

}  // namespace skel
