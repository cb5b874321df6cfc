#include "animator/load_character.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "libskel/animation/clip_library.h"
#include "libskel/classifier/weights_file.h"
#include "libskel/core/error.h"
#include "libskel/image/read_image.h"
#include "libskel/pipeline/rig_character.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

std::string endingOf(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return ending;
}

bool isDrawing(const std::string& path) {
  constexpr std::array<std::string_view, 8> kEndings = {".png", ".jpg", ".jpeg", ".webp",
                                                        ".bmp", ".tif", ".tiff", ".gif"};
  return std::find(kEndings.begin(), kEndings.end(), endingOf(path)) != kEndings.end();
}

CharacterFile rigDrawing(const std::string& path, const std::string& body_plan) {
  RigInput input;
  input.image = readImage(path);
  RigOptions rig;
  rig.mlp = defaultMlp();
  rig.body_plan = loadTemplate(body_plan);
  RiggedDrawing drawing = rigCharacter(std::move(input), rig);
  if (!drawing.found()) throw InputError(path, drawing.silhouette.reason);
  return {std::move(drawing.character), {}, fs::path(path).stem().string()};
}

bool hasClip(const std::vector<Clip>& clips, const std::string& name) {
  return std::any_of(clips.begin(), clips.end(), [&](const Clip& clip) { return clip.name == name; });
}

}  // namespace

CharacterFile loadCharacter(const std::string& path, const std::string& body_plan) {
  if (isDrawing(path)) return rigDrawing(path, body_plan);
  if (endingOf(path) != ".glb")
    throw InputError(path, "is neither a rigged character (.glb) nor a drawing (.png, .jpg, ...)");
  return readGlb(path);
}

CharacterFile loadCharacterWithClips(const std::string& path, const std::string& body_plan,
                                     const ClipSource& source) {
  CharacterFile file = loadCharacter(path, body_plan);
  for (Clip& clip : libraryFor(file.character, source))
    if (!hasClip(file.clips, clip.name)) file.clips.push_back(std::move(clip));
  return file;
}

std::vector<Clip> libraryFor(const RiggedCharacter& character, const ClipSource& source) {
  std::vector<Clip> clips = clipsFor(clipLibrary(source), character.skeleton);
  for (Clip& clip : clips) clip = fitted(clip, character);
  return clips;
}

Clip clipFor(const std::string& name_or_path, const CharacterFile& file, const ClipSource& source) {
  for (const Clip& clip : file.clips)
    if (clip.name == name_or_path) return clip;
  std::vector<Clip> fitting = clipsFor(clipLibrary(source), file.character.skeleton);
  if (hasClip(fitting, name_or_path)) return fitted(clipNamed(fitting, name_or_path), file.character);
  if (name_or_path.find_first_of("./") != std::string::npos)
    return loadClipFor(name_or_path, file.character, source);
  fitting.insert(fitting.begin(), file.clips.begin(), file.clips.end());
  return clipNamed(fitting, name_or_path);  // names those that there are
}

}  // namespace skel
