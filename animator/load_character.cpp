#include "animator/load_character.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "animator/rig_source.h"
#include "libskel/animation/clip_library.h"
#include "libskel/cli/number.h"
#include "libskel/core/error.h"
#include "libskel/core/foreign_files.h"
#include "libskel/pipeline/rig_drawing.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

std::string endingOf(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return ending;
}

}  // namespace

void bindCharacterSource(CLI::App& app, CharacterSource& source) {
  app.add_option(
         "file", source.path,
         "A rigged character (.glb), a drawing, which is rigged first, or a model (.obj) with --skeleton")
      ->required()
      ->type_name("FILE");
  bindCharacterOptions(app, source);
}

void bindCharacterOptions(CLI::App& app, CharacterSource& source) {
  app.add_option("--template", source.body_plan,
                 "Body plan of a drawing: a name, a file, or auto: the one that it fits")
      ->capture_default_str();
  app.add_option(
         "--alpha", source.alpha,
         "How opaque the figure of a drawing is that is seen through elsewhere: leaves a soft glow out "
         "(default: half of the most)")
      ->check(numberIn(0.01, 1.0));
  app.add_option("--figure", source.figure, "Which figure of a drawing: 1 is the largest")
      ->check(numberIn(1, 9999))
      ->capture_default_str();
  app.add_option("--skeleton", source.skeleton, "The skeleton of a model: see skel-animate bind")
      ->type_name("FILE");
  app.add_option("--up", source.up, "The axis that points up in the skeleton's file")
      ->check(CLI::IsMember({"auto", "y", "z"}))
      ->capture_default_str();
}

bool isDrawing(const CharacterSource& source) {
  constexpr std::array<std::string_view, 8> kEndings = {".png", ".jpg", ".jpeg", ".webp",
                                                        ".bmp", ".tif", ".tiff", ".gif"};
  return std::find(kEndings.begin(), kEndings.end(), endingOf(source.path)) != kEndings.end();
}

RiggedDrawing rigDrawing(const CharacterSource& source, const ClipSource& clips) {
  RigOptions options = rigOptionsWithoutClips(source.body_plan);
  const std::vector<Clip> library = clipLibrary(clips);
  options.clips = clipsFor(library, options.body_plan);
  if (options.otherwise) options.otherwise->clips = clipsFor(library, options.otherwise->body_plan);
  options.into_picture = clips.into_picture;
  options.silhouette.alpha = source.alpha;
  options.silhouette.figure = source.figure;
  return rigDrawing(source.path, options);
}

CharacterFile loadCharacter(const CharacterSource& source, const ClipSource& clips) {
  if (isDrawing(source)) {
    RiggedDrawing drawing = rigDrawing(source, clips);
    return {std::move(drawing.character), std::move(drawing.clips), stemOf(source.path)};
  }
  if (const std::string remedy = howToConvert(source.path); !remedy.empty())
    throw InputError(source.path, remedy);
  const bool rigged = endingOf(source.path) == ".glb";
  if (rigged && source.skeleton.empty()) return readGlb(source.path);
  if (!rigged && source.skeleton.empty())
    throw InputError(source.path,
                     "is neither a rigged character (.glb) nor a drawing (.png, .jpg, ...); a model needs "
                     "--skeleton FILE");
  CharacterFile file = readRigModel({source.path, source.skeleton, source.up}).file;
  RiggedCharacter& character = file.character;
  SkinOptions skin;
  skin.file = source.path;
  character.weights = computeSkinWeights(character.mesh, character.skeleton, SkinMethod::kGeodesic, skin);
  return file;
}

std::vector<Error> addLibrary(CharacterFile& file, const ClipSource& clips) {
  std::vector<Error> left_out;
  for (const Clip& clip : clipsFor(clipLibrary(clips), file.character)) {
    if (hasClip(file.clips, clip.name)) continue;
    try {
      file.clips.push_back(fitted(clip, file.character, clips));
    } catch (const Error& error) {
      if (error.exitCode() != ExitCode::kInput) throw;
      left_out.push_back(error);
    }
  }
  return left_out;
}

CharacterFile loadCharacterWithClips(const CharacterSource& source, const ClipSource& clips) {
  CharacterFile file = loadCharacter(source, clips);
  addLibrary(file, clips);
  return file;
}

std::vector<Clip> libraryFor(const RiggedCharacter& character, const ClipSource& source) {
  std::vector<Clip> clips = clipsFor(clipLibrary(source), character);
  for (Clip& clip : clips) clip = fitted(clip, character, source);
  return clips;
}

Clip clipFor(const std::string& name_or_path, const CharacterFile& file, const ClipSource& source,
             std::string* note) {
  for (const Clip& clip : file.clips)
    if (clip.name == name_or_path) return clip;
  const std::vector<Clip> library = clipLibrary(source);
  std::vector<Clip> fitting = clipsFor(library, file.character);
  if (hasClip(fitting, name_or_path)) return fitted(clipNamed(fitting, name_or_path), file.character, source);
  if (name_or_path.find_first_of("./") != std::string::npos)
    return loadClipFor(name_or_path, file.character, source, note);
  for (const Clip& clip : library)
    if (const std::string problem = unknownTemplate(clip); clip.name == name_or_path && !problem.empty())
      throw UsageError("the clip \"" + clip.name + "\" " + problem);
  std::erase_if(fitting, [&](const Clip& clip) { return hasClip(file.clips, clip.name); });
  fitting.insert(fitting.begin(), file.clips.begin(), file.clips.end());
  return clipNamed(fitting, name_or_path);  // names those that there are
}

}  // namespace skel
