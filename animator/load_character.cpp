#include "animator/load_character.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "libskel/animation/retarget.h"
#include "libskel/classifier/weights_file.h"
#include "libskel/core/error.h"
#include "libskel/image/read_image.h"
#include "libskel/pipeline/rig_character.h"

namespace skel {
namespace {

std::string endingOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return ending;
}

CharacterFile rigDrawing(const std::string& path, const LoadOptions& options) {
  RigInput input;
  input.image = readImage(path);
  RigOptions rig;
  rig.mlp = defaultMlp();
  rig.body_plan = loadTemplate(options.body_plan);
  rig.clips = options.clips;
  RiggedDrawing drawing = rigCharacter(std::move(input), rig);
  if (!drawing.found()) throw InputError(path, drawing.silhouette.reason);
  return {std::move(drawing.character), std::move(drawing.clips),
          std::filesystem::path(path).stem().string()};
}

}  // namespace

bool isDrawing(const std::string& path) {
  constexpr std::array<std::string_view, 8> kEndings = {".png", ".jpg", ".jpeg", ".webp",
                                                        ".bmp", ".tif", ".tiff", ".gif"};
  return std::find(kEndings.begin(), kEndings.end(), endingOf(path)) != kEndings.end();
}

CharacterFile loadCharacter(const std::string& path, const LoadOptions& options) {
  if (isDrawing(path)) return rigDrawing(path, options);
  if (endingOf(path) != ".glb")
    throw InputError(path, "is neither a rigged character (.glb) nor a drawing (.png, .jpg, ...)");
  CharacterFile file = readGlb(path);
  for (const Clip& clip : options.clips) file.clips.push_back(retargetToRest(clip, file.character.skeleton));
  return file;
}

}  // namespace skel
