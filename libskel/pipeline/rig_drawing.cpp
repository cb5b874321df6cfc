#include "libskel/pipeline/rig_drawing.h"

#include <filesystem>

#include "libskel/classifier/weights_file.h"
#include "libskel/core/error.h"
#include "libskel/image/read_image.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {

RiggedDrawing rigDrawing(const std::string& path, const std::string& body_plan) {
  RigInput input;
  RigOptions rig;
  rig.mlp = defaultMlp();
  rig.body_plan = loadTemplate(body_plan);
  if (path.ends_with(".skeleton.json")) {
    const SkeletonFile file = readSkeletonFile(path, rig.body_plan);
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    input.image = readImage((folder / file.image_file).string());
    input.skeleton = file.skeleton;
    if (file.mask) input.mask = readMask((folder / file.mask->file).string());
  } else {
    input.image = readImage(path);
  }
  RiggedDrawing drawing = rigCharacter(std::move(input), rig);
  if (!drawing.found()) throw InputError(path, drawing.silhouette.reason);
  return drawing;
}

}  // namespace skel
