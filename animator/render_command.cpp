#include "animator/render_command.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

#include "animator/render_films.h"
#include "animator/render_sheet.h"
#include "animator/rig_source.h"
#include "libskel/animation/clip_library.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/error.h"
#include "libskel/core/text.h"
#include "libskel/pipeline/drawing_notes.h"

namespace skel {
namespace {

// What skel-infer says of it, too.
void tell(const RiggedDrawing& drawing, const std::string& path, const std::vector<Clip>& clips) {
  std::printf("%s: %s, confidence %.2f\n", printable(path).c_str(), drawing.body_plan.name.c_str(),
              drawing.recognition.confidence);
  std::vector<Note> notes;
  for (const std::string& note : figureNotes(drawing)) notes.push_back({note});
  for (Note& note : limbNotes(drawing, clips)) notes.push_back(std::move(note));
  for (const Note& note : notes)
    std::fprintf(stderr, "%s: note: %s\n", printable(path).c_str(), printable(noteText(note, path)).c_str());
}

void complain(const Error& error) { std::fprintf(stderr, "skel-animate: %s\n", error.what()); }

// Which of the user's own clips this character lacks the joints for.
void noteUnfitting(const RenderCommandOptions& options, const RiggedCharacter& character,
                   const std::string& path) {
  if (options.library.clips_dir.empty()) return;
  const auto isIn = [](const std::vector<Clip>& clips, const Clip& clip) {
    return std::find(clips.begin(), clips.end(), clip) != clips.end();
  };
  const std::vector<Clip> library = clipLibrary(options.library), fitting = clipsFor(library, character);
  for (const Clip& clip : library)
    if (!isIn(builtinClips(), clip) && !isIn(fitting, clip))
      std::fprintf(stderr, "%s: note: the clip \"%s\" does not fit its joints and is left out\n",
                   printable(path).c_str(), printable(clip.name).c_str());
}

struct AskedClips {
  std::vector<Clip> clips;                   // each once
  ExitCode left_out_code = ExitCode::kDone;  // of the first that the character cannot do; each is named
};

AskedClips askedClips(const RenderCommandOptions& options, CharacterFile file, const std::string& path) {
  AskedClips asked;
  const auto take = [&](const Clip& clip) {
    if (std::find(asked.clips.begin(), asked.clips.end(), clip) == asked.clips.end())
      asked.clips.push_back(clip);
  };
  for (const std::string& name : options.clips) {
    if (name != kAllClips) {
      std::string note;
      take(clipFor(name, file, options.library, &note));
      if (!note.empty()) std::fprintf(stderr, "%s\n", printable(note).c_str());
      continue;
    }
    noteUnfitting(options, file.character, path);
    for (const Error& error : addLibrary(file, options.library)) {
      complain(InputError(path, error.what()));
      if (asked.left_out_code == ExitCode::kDone) asked.left_out_code = error.exitCode();
    }
    std::for_each(file.clips.begin(), file.clips.end(), take);
  }
  return asked;
}

// Files are named after characters.
void checkNames(const std::vector<std::string>& files) {
  std::map<std::string, std::string> file_of_name;
  for (const std::string& file : files)
    if (const auto [other, is_new] = file_of_name.emplace(stemOf(file), file); !is_new)
      throw UsageError(other->second + " and " + file + " would both write files called " + other->first +
                       "; rename one");
}

ExitCode render(const RenderCommandOptions& options, const std::string& path, const RenderCharacter& render) {
  CharacterSource source = options.source;
  source.path = path;
  std::optional<RiggedDrawing> drawing;
  if (isDrawing(source)) drawing = rigDrawing(source, options.library);
  const bool flat = options.look == "flat";
  if (flat && !drawing)
    throw UsageError(path + " is no drawing (.png, .jpg, ...), which alone can move as it was drawn");
  CharacterFile file = drawing ? CharacterFile{drawing->character, {}, {}} : loadCharacter(source);
  if (drawing && !flat) file.clips = drawing->clips;
  file.name = stemOf(path);
  const auto [clips, left_out_code] = [&] {
    try {
      return askedClips(options, file, path);
    } catch (const UsageError& error) {  // others may have it
      throw UsageError(path + ": " + error.what());
    }
  }();
  if (clips.empty())
    throw InputError(path, "can do no clip: it has none, and none that come with skel fit its joints");
  if (drawing) tell(*drawing, path, clips);
  render(std::move(file), drawing ? &*drawing : nullptr, clips);
  return left_out_code;
}

}  // namespace

ExitCode runRender(const RenderCommandOptions& asked) {
  RenderCommandOptions options = asked;
  options.library.flat = options.look == "flat";
  if (options.library.flat && !options.sheet.output.empty())
    throw UsageError("--look flat makes films; of sprite sheets, --pixels");
  checkNames(options.files);
  const RenderCharacter rendered =
      options.sheet.output.empty() ? filmRenderer(options) : sheetRenderer(options);
  ExitCode code = ExitCode::kDone;
  for (const std::string& path : options.files) {
    ExitCode of_file = ExitCode::kDone;
    try {
      of_file = render(options, path, rendered);
    } catch (...) {
      const Error error = caughtError(path);
      complain(error);
      of_file = error.exitCode();
    }
    if (code == ExitCode::kDone) code = of_file;
  }
  return code;
}

}  // namespace skel
