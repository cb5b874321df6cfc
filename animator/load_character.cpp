#include "animator/load_character.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <numbers>

#include "animator/rig_source.h"
#include "libskel/animation/clip_library.h"
#include "libskel/animation/joint_roles.h"
#include "libskel/cli/number.h"
#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/foreign_files.h"
#include "libskel/core/sha256.h"
#include "libskel/core/tool_command.h"
#include "libskel/image/read_image.h"
#include "libskel/image/sprite_sheet_file.h"
#include "libskel/mended/mend_places.h"
#include "libskel/mended/rig_mended.h"
#include "libskel/pipeline/drawing_notes.h"
#include "libskel/pipeline/rig_drawing.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {
namespace fs = std::filesystem;

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
      ->check([](const std::string& text) -> std::string {
        return text == "all" ? "takes one figure; `" + toolCommand("skel-infer") +
                                   " DRAWING --figure all` makes a .glb of each, which can be named instead"
                             : "";
      })
      ->check(numberIn(1, 9999))
      ->capture_default_str();
  app.add_flag("--upright", source.upright,
               "The figure of a drawing is not turned: try no other orientations");
  app.add_flag("--cut-limbs", source.cut_limbs,
               "Limbs drawn over the body are cut out: they move more, and tear what they lie on");
  addNamedNumbers(
      app, "--height", source.heights, zeroOrNumberIn(1e-3, 1e3),
      "Of a drawing's model as it is drawn, m; of several, NAME=METRES is of one alone, with commas "
      "in between: 1.7,dwarf=1.2 (default: 1.7, or 1.2 from end to end of an animal)");
  addNamedNumbers(app, "--facing", source.facing, numberIn(-180.0, 180.0),
                  "Which way the figure looks, degrees, where skel is wrong: 0 at you, 90 to the right of "
                  "the picture, -90 to the left, 45 and -45 between; NAME=DEGREES of one drawing of several");
  app.add_option("--skeleton", source.skeleton,
                 "The skeleton of a model (see skel-animate bind), or of a drawing: its .skeleton.json or "
                 ".labels.json, mended")
      ->type_name("FILE");
  app.add_option("--up", source.up, "The axis that points up in the skeleton's file")
      ->check(CLI::IsMember({"auto", "y", "z"}))
      ->capture_default_str();
  app.add_option("--results", source.results,
                 "Where skel-infer -o DIR wrote the results of a drawing: what was mended there is taken up, "
                 "before what lies beside the drawing and in out/")
      ->type_name("DIR");
  app.add_flag("--force", source.force, "Leave out what was mended by hand of a drawing");
}

bool isDrawing(const CharacterSource& source) {
  constexpr std::array<std::string_view, 8> kEndings = {".png", ".jpg", ".jpeg", ".webp",
                                                        ".bmp", ".tif", ".tiff", ".gif"};
  return std::find(kEndings.begin(), kEndings.end(), endingOf(source.path)) != kEndings.end();
}

DrawnCharacter rigDrawing(const CharacterSource& source, const ClipSource& clips) {
  if (const std::string atlas = atlasBeside(source.path); !atlas.empty())
    throw InputError(source.path, "is a sprite sheet of skel (" + fs::path(atlas).filename().string() +
                                      " beside it); name the drawing or the .glb that it was made of");
  RigOptions options = rigOptionsWithoutClips(source.body_plan);
  const std::vector<Clip> library = clipLibrary(clips);
  options.clips = clipsFor(library, options.body_plan);
  if (options.otherwise) options.otherwise->clips = clipsFor(library, options.otherwise->body_plan);
  options.into_picture = clips.into_picture;
  options.silhouette.alpha = source.alpha;
  options.upright = source.upright;
  options.cut_limbs = source.cut_limbs;
  options.height_m = source.heights(stemOf(source.path));
  if (const auto facing_deg = source.facing.given(stemOf(source.path)))
    options.facing_rad = *facing_deg * std::numbers::pi / 180;
  const std::optional<SkeletonFile> given = givenSkeleton(source.skeleton, options);
  const std::string bytes = readFile(source.path);
  MendRequest request;
  request.source = source.path;
  request.image_sha256 = sha256(bytes);
  request.figure = given ? figureOf(*given, source.skeleton, source.figure) : source.figure;
  request.results = resultsIn(source.results, source.path, request.figure);
  request.out_dir = source.results;
  request.former_names = source.former_names;
  request.skeleton = source.skeleton;
  request.takes_up = !source.force;
  RigInput input;
  input.image = decodeImage(bytes, source.path);
  MendedRig rig = rigMended(request, options, std::move(input), given);
  DrawnCharacter result{
      std::move(rig.drawing), withAdviceIfUpright(std::move(rig.warnings), "use --upright"), {}};
  if (const auto note = facingNote(result.drawing.character)) result.warnings.push_back(*note);
  result.mended = mendedNotes(rig, request, options);
  return result;
}

CharacterFile loadCharacter(const CharacterSource& source, const ClipSource& clips, std::string* note) {
  if (isDrawing(source)) {
    DrawnCharacter drawn = rigDrawing(source, clips);
    std::vector<Note> notes;
    for (const std::string& warning : drawn.warnings) notes.push_back({warning});
    notes.insert(notes.end(), drawn.mended.begin(), drawn.mended.end());
    for (const Note& one : notes)
      if (note) *note += (note->empty() ? source.path + ": note: " : "; ") + noteText(one, source.path);
    return {std::move(drawn.drawing.character), std::move(drawn.drawing.clips), stemOf(source.path)};
  }
  if (const std::string remedy = howToConvert(source.path); !remedy.empty())
    throw InputError(source.path, remedy);
  if (source.heights(stemOf(source.path)) != 0)
    throw UsageError("--height is of drawings; " + source.path + " has its own height: leave --height out");
  if (source.facing.given(stemOf(source.path)))
    throw UsageError("--facing is of drawings; " + source.path +
                     " knows which way it looks: make it anew with --facing");
  const bool rigged = endingOf(source.path) == ".glb";
  if (rigged && source.skeleton.empty()) return readGlb(source.path);
  if (!rigged && !fs::exists(source.path)) throw InputError(source.path, "does not exist");
  if (!rigged && source.skeleton.empty())
    throw InputError(source.path,
                     "is neither a rigged character (.glb) nor a drawing (.png, .jpg, ...); a model needs "
                     "--skeleton FILE");
  RigModel model = readRigModel({source.path, source.skeleton, source.up});
  if (note) *note = model.warning;
  CharacterFile file = std::move(model.file);
  RiggedCharacter& character = file.character;
  SkinOptions skin;
  skin.file = source.path;
  character.weights = computeSkinWeights(character.mesh, character.skeleton, SkinMethod::kGeodesic, skin);
  return file;
}

CharacterFile loadModel(const std::string& path) {
  if (isDrawing({.path = path}))
    throw InputError(path, "is a drawing; `skel-infer " + shellWord(path) + "` makes " +
                               shellWord("out/" + stemOf(path) + ".glb") + " of it: name that");
  return readGlb(path);
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

CharacterFile loadCharacterWithClips(const CharacterSource& source, const ClipSource& clips,
                                     std::string* note) {
  CharacterFile file = loadCharacter(source, clips, note);
  std::vector<std::string> left_out;
  clipLibrary(clips, &left_out);
  if (note)
    for (const std::string& problem : left_out)
      *note += (note->empty() ? "note: left out: " : "; left out: ") + problem;
  addLibrary(file, clips);
  return file;
}

std::vector<Clip> libraryFor(const RiggedCharacter& character, const ClipSource& source) {
  std::vector<Clip> clips = clipsFor(clipLibrary(source), character);
  for (Clip& clip : clips) clip = fitted(clip, character, source);
  return clips;
}

Clip clipFor(const std::string& name_or_path, const CharacterFile& file, const ClipSource& source,
             ClipNotes* notes) {
  return clipFor(name_or_path, file.character, file.clips, source, notes);
}

Clip clipFor(const std::string& name_or_path, const RiggedCharacter& character,
             const std::vector<Clip>& own_clips, const ClipSource& source, ClipNotes* notes) {
  for (const Clip& clip : own_clips)
    if (clip.name == name_or_path) return clip;
  const std::vector<Clip> library = clipLibrary(source);
  std::vector<Clip> fitting = clipsFor(library, character);
  if (hasClip(fitting, name_or_path)) return fitted(clipNamed(fitting, name_or_path), character, source);
  if (name_or_path.find_first_of("./") != std::string::npos)
    return loadClipFor(name_or_path, character, source, notes);
  for (const Clip& clip : library)
    if (const std::string fault =
            clip.name == name_or_path && isOwn(clip) ? whyUnfit(clip, character) : std::string();
        !fault.empty())
      throw UsageError("the clip \"" + clip.name + "\" " + fault);
  if (!hasClip(library, name_or_path))
    if (const std::string file = clipFileNamed(name_or_path, source); !file.empty())
      throw UsageError("there is no clip \"" + name_or_path + "\"; that of " + file + " is called \"" +
                       readClipFile(file).name + "\": ask for that, or change its \"name\"");
  std::string why = fitting.empty() ? "; no clip of skel fits it: " + whyNoRoles(character.skeleton) : "";
  if (!source.clips_dir.empty() && !hasClip(library, name_or_path))
    why += "; no clip file in " + source.clips_dir + " is called so";
  std::erase_if(fitting, [&](const Clip& clip) { return hasClip(own_clips, clip.name); });
  fitting.insert(fitting.begin(), own_clips.begin(), own_clips.end());
  try {
    return clipNamed(fitting, name_or_path);  // names those that there are
  } catch (const UsageError& error) {
    throw UsageError(error.what() + why);
  }
}

}  // namespace skel
