#include "libskel/pipeline/rig_drawing.h"

#include <filesystem>

#include "libskel/animation/clip_library.h"
#include "libskel/core/error.h"
#include "libskel/image/read_image.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {

RigOptions rigOptions(const std::string& body_plan) {
  RigOptions options;
  options.body_plan = loadTemplate(body_plan);
  options.clips = clipsFor(builtinClips(), options.body_plan);
  return options;
}

RiggedDrawing rigDrawing(const std::string& path, const RigOptions& options) {
  RigInput input;
  std::string source = path;  // of the figure's outline
  if (path.ends_with(".skeleton.json")) {
    const SkeletonFile file = readSkeletonFile(path, options.body_plan);
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    input.image = readImage((folder / file.image_file).string());
    input.skeleton = file.skeleton;
    if (file.mask) input.mask = readMask(source = (folder / file.mask->file).string());
  } else {
    input.image = readImage(path);
  }
  RiggedDrawing drawing = rigCharacter(std::move(input), options);
  if (!drawing.found()) throw InputError(source, drawing.silhouette.reason);
  return drawing;
}

}  // namespace skel
