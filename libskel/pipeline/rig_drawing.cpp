#include "libskel/pipeline/rig_drawing.h"

#include <filesystem>

#include "libskel/animation/clip_library.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/image/check_image.h"
#include "libskel/image/read_image.h"
#include "libskel/skeleton/body_plans.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {

RigOptions rigOptionsWithoutClips(const std::string& body_plan) {
  RigOptions options;
  const BodyPlans plans = bodyPlans(body_plan);
  options.body_plan = plans.front();
  if (plans.size() > 1) options.otherwise = {plans[1], {}};
  return options;
}

RigOptions rigOptions(const std::string& body_plan) {
  RigOptions options = rigOptionsWithoutClips(body_plan);
  options.clips = clipsFor(builtinClips(), options.body_plan);
  if (options.otherwise) options.otherwise->clips = clipsFor(builtinClips(), options.otherwise->body_plan);
  return options;
}

const SkeletonTemplate& planOfSkeleton(std::string_view text, const std::string& path,
                                       const RigOptions& options) {
  return options.otherwise ? planNamed(templateOfSkeleton(text, path), options) : options.body_plan;
}

RiggedDrawing rigDrawing(const std::string& path, const RigOptions& options) {
  return throwingErrors(path, [&] {
    RigInput input;
    input.file = path;
    std::string source = path;  // of the figure's outline
    if (path.ends_with(".skeleton.json")) {
      const std::string text = readFile(path);
      const SkeletonFile file = parseSkeletonFile(text, path, planOfSkeleton(text, path, options));
      const std::filesystem::path folder = std::filesystem::path(path).parent_path();
      input.image = readImage((folder / file.image_file).string());
      input.skeleton = file.skeleton;
      if (file.mask) {
        input.mask = readMask(source = (folder / file.mask->file).string());
        if (input.mask->cols() != input.image.width || input.mask->rows() != input.image.height)
          throw InputError(source, "is a mask of " + sizeInPx(input.mask->cols(), input.mask->rows()) +
                                       " px, the image has " +
                                       sizeInPx(input.image.width, input.image.height));
      }
    } else {
      input.image = readImage(path);
    }
    RiggedDrawing drawing = rigCharacter(std::move(input), options);
    if (!drawing.found()) throw InputError(source, drawing.silhouette.reason);
    return drawing;
  });
}

}  // namespace skel
