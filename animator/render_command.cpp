#include "animator/render_command.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

#include "animator/render_films.h"
#include "animator/render_sheet.h"
#include "animator/rig_source.h"
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

// Those that are asked for, each once.
std::vector<Clip> askedClips(const RenderCommandOptions& options, CharacterFile file) {
  std::vector<Clip> clips;
  const auto take = [&](const Clip& clip) {
    if (std::find(clips.begin(), clips.end(), clip) == clips.end()) clips.push_back(clip);
  };
  for (const std::string& name : options.clips) {
    if (name != kAllClips) {
      std::string note;
      take(clipFor(name, file, options.library, &note));
      if (!note.empty()) std::fprintf(stderr, "%s\n", printable(note).c_str());
      continue;
    }
    addLibrary(file, options.library);
    std::for_each(file.clips.begin(), file.clips.end(), take);
  }
  return clips;
}

// Files are named after characters.
void checkNames(const std::vector<std::string>& files) {
  std::map<std::string, std::string> file_of_name;
  for (const std::string& file : files)
    if (const auto [other, is_new] = file_of_name.emplace(stemOf(file), file); !is_new)
      throw UsageError(other->second + " and " + file + " would both write files called " + other->first +
                       "; rename one");
}

void render(const RenderCommandOptions& options, const std::string& path, const RenderCharacter& render) {
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
  const std::vector<Clip> clips = [&] {
    try {
      return askedClips(options, file);
    } catch (const UsageError& error) {  // others may have it
      throw UsageError(path + ": " + error.what());
    }
  }();
  if (clips.empty())
    throw InputError(path, "can do no clip: it has none, and none that come with skel fit its joints");
  if (drawing) tell(*drawing, path, clips);
  render(std::move(file), drawing ? &*drawing : nullptr, clips);
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
    try {
      render(options, path, rendered);
    } catch (...) {
      const Error error = caughtError(path);
      std::fprintf(stderr, "skel-animate: %s\n", error.what());
      if (code == ExitCode::kDone) code = error.exitCode();
    }
  }
  return code;
}

}  // namespace skel
