#include "animator/render_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "animator/flat_figure.h"
#include "animator/render_films.h"
#include "animator/render_sheet.h"
#include "animator/rig_source.h"
#include "libskel/animation/clip_library.h"
#include "libskel/animation/joint_roles.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/error.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/new_folders.h"
#include "libskel/core/text.h"
#include "libskel/image/named_drawings.h"
#include "libskel/mended/former_names.h"
#include "libskel/pipeline/drawing_notes.h"
#include "libskel/skeleton/mark_placed.h"
#include "libskel/video/video_writer.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

// What skel-infer says of it, too; and the look, where it was chosen.
void tell(const DrawnCharacter& drawn, const char* look, const std::string& path,
          const std::vector<Clip>& clips) {
  const RiggedDrawing& drawing = drawn.drawing;
  char sure[32];
  std::snprintf(sure, sizeof sure, "confidence %.2f", drawing.recognition.confidence);
  std::printf("%s: %s, %s%s\n", printable(path).c_str(), drawing.body_plan.name.c_str(),
              allPlaced(drawing.recognition.skeleton) ? "joints placed by hand" : sure, look);
  std::vector<Note> notes;
  for (const std::string& warning : drawn.warnings) notes.push_back({warning});
  for (Note& note : limbNotes(drawing, clips)) notes.push_back(std::move(note));
  notes.insert(notes.end(), drawn.mended.begin(), drawn.mended.end());
  for (const Note& note : notes)
    std::fprintf(stderr, "%s: note: %s\n", printable(path).c_str(), printable(noteText(note, path)).c_str());
}

void complain(const Error& error) { std::fprintf(stderr, "skel-animate: %s\n", error.what()); }

// Which of the user's own clips do not fit this character.
void noteUnfitting(const RenderCommandOptions& options, const RiggedCharacter& character,
                   const std::string& path) {
  if (options.library.clips_dir.empty()) return;
  const std::vector<Clip> library = clipLibrary(options.library), fitting = clipsFor(library, character);
  for (const Clip& clip : library)
    if (isOwn(clip) && std::find(fitting.begin(), fitting.end(), clip) == fitting.end()) {
      const std::string fault = whyUnfit(clip, character);
      std::fprintf(stderr, "%s: note: left out: the clip \"%s\" %s\n", printable(path).c_str(),
                   printable(clip.name).c_str(),
                   fault.empty() ? "does not fit its joints" : printable(fault).c_str());
    }
}

// What is said of characters, of several the same once, with their names behind it.
class Sayings {
 public:
  explicit Sayings(bool of_several) : of_several_(of_several) {}

  // `may_cut`: arms stay that --cut-limbs has move.
  void add(const ClipNotes& notes, bool may_cut, const std::string& path) {
    std::vector<std::string> clauses = notes.of_character;
    for (const std::string& arm : notes.of_arms)
      clauses.push_back(arm + (may_cut ? " (--cut-limbs has it move, and may tear)" : ""));
    for (const std::string& clause : clauses) {
      if (!of_several_) {
        std::fprintf(stderr, "%s: note: %s\n", printable(path).c_str(), printable(clause).c_str());
        continue;
      }
      auto same =
          std::find_if(said_.begin(), said_.end(), [&](const auto& it) { return it.first == clause; });
      if (same == said_.end()) same = said_.insert(said_.end(), {clause, {}});
      same->second.push_back(fs::path(path).filename().string());
    }
  }
  void tell() const {
    for (const auto& [clause, names] : said_) {
      std::string text = clause + ": ";
      for (const std::string& name : names) text += (&name == &names.front() ? "" : ", ") + name;
      std::fprintf(stderr, "note: %s\n", printable(text).c_str());
    }
  }

 private:
  bool of_several_;
  std::vector<std::pair<std::string, std::vector<std::string>>> said_;
};

// Of those clips that come from the library, not from the character's file (`filed`) or one of their own.
void noteWhatStays(const RenderCommandOptions& options, const RiggedCharacter& character,
                   const std::string& path, const std::vector<Clip>& clips, const std::vector<Clip>& filed,
                   bool may_cut, Sayings& sayings) {
  const auto isNamed = [&](const std::string& name) {
    return std::find(options.clips.begin(), options.clips.end(), name) != options.clips.end();
  };
  std::vector<Clip> of_library = clipsFor(clipLibrary(options.library), character);
  std::erase_if(of_library, [&](const Clip& clip) {
    return !hasClip(clips, clip.name) || hasClip(filed, clip.name) ||
           !(isNamed(clip.name) || isNamed(std::string(kAllClips)));
  });
  sayings.add(whatStays(of_library, character), may_cut, path);
}

struct AskedClips {
  std::vector<Clip> clips;                   // each once
  ExitCode left_out_code = ExitCode::kDone;  // of the first that the character cannot do; each is named
};

// Whether a clip of this name is there for some body plan.
bool isKnown(const std::string& name, const ClipSource& library) {
  return hasClip(clipLibrary(library), name);
}

// What a character does in a film of several that do `name`: that, or what its body plan has in its place.
std::string clipAmongOthers(const std::string& name, const CharacterFile& file, const ClipSource& library,
                            const std::string& path) {
  const std::vector<Clip> fitting = clipsFor(clipLibrary(library), file.character);
  if (!isKnown(name, library) || hasClip(file.clips, name) || hasClip(fitting, name)) return name;
  std::string instead = meantClip(name, fitting);
  if (instead.empty()) instead = "walk";
  if (!hasClip(fitting, instead)) return name;
  std::fprintf(stderr, "%s: note: there is no clip \"%s\" for this body plan: \"%s\" instead\n",
               printable(path).c_str(), printable(name).c_str(), printable(instead).c_str());
  return instead;
}

AskedClips askedClips(const RenderCommandOptions& options, CharacterFile file, const std::string& path,
                      bool may_cut, Sayings& sayings) {
  AskedClips asked;
  std::map<std::string, std::string> words;  // that ask for a clip, by its name: films and frames have that
  const auto take = [&](const Clip& clip, const std::string& word) {
    if (std::find(asked.clips.begin(), asked.clips.end(), clip) != asked.clips.end()) return;
    if (const auto [other, is_new] = words.emplace(clip.name, word); !is_new)
      throw UsageError(other->second + " and " + word + " are both called \"" + clip.name +
                       "\"; give one of them another \"name\", or render them one at a time");
    asked.clips.push_back(clip);
  };
  const auto leaveOut = [&](const Error& error) {
    complain(error);
    if (asked.left_out_code == ExitCode::kDone) asked.left_out_code = error.exitCode();
  };
  std::optional<UsageError> unknown;
  for (const std::string& word : options.clips) {
    const std::string name = options.together ? clipAmongOthers(word, file, options.library, path) : word;
    if (name == kAllClips) {
      noteUnfitting(options, file.character, path);
      for (const Error& error : addLibrary(file, options.library)) leaveOut(InputError(path, error.what()));
      for (const Clip& clip : file.clips) take(clip, clip.name);
      continue;
    }
    ClipNotes notes;
    std::optional<Clip> found;
    try {
      found = clipFor(name, file, options.library, &notes);
    } catch (const UsageError& error) {  // others may have it
      const UsageError here(path + ": " + error.what());
      if (options.files.size() == 1) throw here;
      unknown = here;
      if (options.clips.size() == 1) break;
      if (isKnown(name, options.library)) {
        const std::string meant = meantClip(name, clipsFor(clipLibrary(options.library), file.character));
        if (std::find(options.clips.begin(), options.clips.end(), meant) != options.clips.end()) continue;
        std::fprintf(stderr, "%s: note: there is no clip \"%s\" for this body plan%s: left out\n",
                     printable(path).c_str(), printable(name).c_str(),
                     meant.empty() ? "" : (", but \"" + printable(meant) + '"').c_str());
      } else {
        leaveOut(here);
      }
    } catch (const OtherBodyPlan& error) {
      const bool walks =
          options.together && hasClip(clipsFor(clipLibrary(options.library), file.character), "walk");
      if (options.files.size() == 1 || (!walks && options.clips.size() == 1)) throw;
      std::fprintf(stderr, "%s: note: %s: %s\n", printable(path).c_str(), error.what(),
                   walks ? "\"walk\" instead" : "left out");
      if (walks) found = clipFor("walk", file, options.library);
    } catch (const InputError& error) {  // of the clip; it may be made for others
      if (options.files.size() == 1 || options.clips.size() == 1) throw;
      leaveOut(InputError(path, error.what()));
    }
    if (found) take(*found, name);
    if (!notes.of_file.empty()) std::fprintf(stderr, "%s\n", printable(notes.of_file).c_str());
    sayings.add(notes, may_cut, path);
  }
  if (asked.clips.empty() && unknown) throw *unknown;
  return asked;
}

// Files are named after characters.
void checkNames(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (const std::string& file : files) names.push_back(stemOf(file));
  if (const auto clash = nameClash(files, names))
    throw UsageError(clash->first + " and " + clash->second + " would both write files called " +
                     clash->name + clash->more + "; rename one");
}

struct Cast {
  std::string path;
  Performer performer;
  ExitCode code = ExitCode::kDone;  // of what it cannot do
  bool rigged = false;              // in this run
  bool unsure = false;              // something about that figure is unusual, or had to be guessed
};

// Whether the look of a drawing's film is left to skel: nothing is asked for that the flat look refuses or
// takes no notice of.
bool choosesLook(const RenderCommandOptions& options, const std::string& path) {
  const RenderCommandOptions otherwise;
  return options.look == "auto" && options.sheet.output.empty() &&
         !needsModel(options, options.angles(stemOf(path)) != 0) &&
         options.pitch_deg == otherwise.pitch_deg && options.blend == otherwise.blend;
}

// `among_drawings`: the run has any.
Cast cast(const RenderCommandOptions& asked, const std::string& path, bool among_drawings, Sayings& sayings) {
  RenderCommandOptions options = asked;
  CharacterSource& source = options.source;
  source.path = path;
  if (among_drawings && !isDrawing(source)) {  // they are of drawings alone
    source.heights.of_others = 0;
    source.facing.of_others = std::nan("");
  }
  std::optional<DrawnCharacter> drawn;
  if (isDrawing(source)) drawn = rigDrawing(source, options.library);
  const bool chooses = drawn && choosesLook(options, path);
  const bool flat = chooses ? looksBetterFlat(drawn->drawing) : options.look == "flat";
  options.library.flat = flat;
  if (flat && !drawn)
    throw UsageError(path + " is no drawing (.png, .jpg, ...), which alone can move as it was drawn");
  std::string note;
  CharacterFile file =
      drawn ? CharacterFile{drawn->drawing.character, {}, {}} : loadCharacter(source, options.library, &note);
  if (!note.empty()) std::fprintf(stderr, "%s\n", note.c_str());
  if (drawn && !flat) file.clips = drawn->drawing.clips;
  file.name = stemOf(path);
  const bool may_cut = drawn && !drawn->drawing.layers.at_rest.empty();
  const auto [clips, left_out_code] = askedClips(options, file, path, may_cut, sayings);
  if (clips.empty())
    throw InputError(path, "can do no clip: it has none, and none that come with skel fit its joints: " +
                               whyNoRoles(file.character.skeleton));
  if (drawn) tell(*drawn, !chooses ? "" : flat ? ", look flat" : ", look solid", path, clips);
  bool unseen = false;
  for (const Clip& clip : clips)
    if (flat && !hasClip(builtinClips(), clip.name))
      if (const auto turn = unseenTurn(drawn->drawing, clip)) {
        std::fprintf(stderr, "%s: note: %s\n", printable(path).c_str(), printable(*turn).c_str());
        unseen = true;
      }
  noteWhatStays(options, file.character, path, clips, drawn ? std::vector<Clip>{} : file.clips, may_cut,
                sayings);
  const bool rigged = drawn.has_value(), unsure = unseen || (rigged && !drawn->warnings.empty());
  std::optional<RiggedDrawing> shown;
  if (flat) shown = std::move(drawn->drawing);
  return {path, {std::move(file), std::move(shown), clips}, left_out_code, rigged, unsure};
}

// ", 2 to look at (a.png, b.png)"; nothing of none.
std::string counted(const std::vector<std::string>& paths, const std::string& what) {
  constexpr std::size_t kMostNamed = 30;  // a class
  if (paths.empty()) return "";
  return ", " + std::to_string(paths.size()) + " " + what + " (" + firstFew(paths, kMostNamed) + ")";
}

struct Verdicts {
  std::size_t fine = 0, loaded = 0;  // nothing is known of models that are only loaded
  std::vector<std::string> unsure, failed;
};

// "4 characters: 1 fine, 1 to look at (a.png), 2 models"
std::string summary(std::size_t all, const Verdicts& verdicts, const char* failed) {
  std::string text = std::to_string(all) + " characters";
  if (verdicts.loaded + verdicts.failed.size() < all)
    text += ": " + std::to_string(verdicts.fine) + " fine" + counted(verdicts.unsure, "to look at") +
            (verdicts.loaded == 0
                 ? ""
                 : ", " + std::to_string(verdicts.loaded) + (verdicts.loaded == 1 ? " model" : " models"));
  return text + counted(verdicts.failed, failed);
}

// Whether `name` is that of a clip, after which no comma was written.
bool isClipAmongFiles(const RenderCommandOptions& options, const std::string& name) {
  std::error_code not_there;
  return !fs::exists(name, not_there) && isKnown(name, options.library);
}

// Folders become the drawings in them, and what was made of drawings is left out.
void findDrawings(RenderCommandOptions& options) {
  for (const std::string& path : options.files)
    if (isClipAmongFiles(options, path)) {
      std::string clips;
      for (const std::string& clip : options.clips) clips += clip + ",";
      throw UsageError("there is no file \"" + path + "\"; several clips have commas in between: --clips " +
                       clips + path);
    }
  NamedDrawings named = drawingsOf(options.files);
  for (const std::string& note : notesOf(named))
    std::fprintf(stderr, "skel-animate: note: %s\n", printable(note).c_str());
  options.files = std::move(named.drawings);
}

void checkFiles(const RenderCommandOptions& options) {
  for (const std::string& path : options.files)
    if (options.files.size() > 1 && !options.source.skeleton.empty() && isDrawing({.path = path}))
      throw UsageError("--skeleton FILE is of one drawing, " + std::to_string(options.files.size()) +
                       " characters are named; give them one at a time");
  if (!options.together) checkNames(options.files);
  requireNamed(options.angles, "--angle", options.files);
  requireNamed(options.source.heights, "--height", options.files);
  requireNamed(options.source.facing, "--facing", options.files);
}

}  // namespace

ExitCode runRender(const RenderCommandOptions& asked) {
  RenderCommandOptions options = asked;
  if (options.look == "flat" && !options.sheet.output.empty())
    throw UsageError(
        "--look flat is a look of films; leave it out beside --sheet, whose frames show the model (--pixels "
        "gives them hard edges)");
  if (std::find(options.clips.begin(), options.clips.end(), kAllClips) == options.clips.end())
    options.library.names = options.clips;
  options.source.former_names = std::make_shared<FormerNames>();
  toldClipLibrary(options.library);
  findDrawings(options);
  if (options.files.size() > 1 && options.sheet.output.empty() && !options.output.empty() &&
      !isFrameFolder(options.output))
    options.together = true;
  if (options.names && !options.together)
    throw UsageError("--names is of one film of several drawings: -o NAME.mp4, or --together");
  checkFiles(options);
  const NewFolders folders(options.sheet.output.empty() ? options.output : options.sheet.output);
  const CharacterRenderer renderer =
      options.sheet.output.empty() ? filmRenderer(options) : sheetRenderer(options);
  ExitCode code = ExitCode::kDone;
  Verdicts verdicts;
  // `work` returns the exit code of what it leaves out.
  const auto attempt = [&](const std::string& path, const auto& work) {
    ExitCode here = ExitCode::kDone;
    try {
      here = work();
    } catch (const OverwriteError&) {
      throw;
    } catch (...) {
      const Error error = caughtError(path);
      complain(error);
      here = error.exitCode();
      verdicts.failed.push_back(path);
    }
    if (code == ExitCode::kDone) code = here;
  };
  const auto render = [&](Cast one) {
    const bool torn = renderer.render(std::move(one.performer));
    if (one.unsure || torn)
      verdicts.unsure.push_back(one.path);
    else
      ++(one.rigged ? verdicts.fine : verdicts.loaded);
    return one.code;
  };
  const bool any_drawing = std::any_of(options.files.begin(), options.files.end(),
                                       [](const std::string& file) { return isDrawing({.path = file}); });
  std::vector<Cast> measured;
  Sayings sayings(options.files.size() > 1);
  for (const std::string& path : options.files)
    attempt(path, [&] {
      Cast one = cast(options, path, any_drawing, sayings);
      if (!renderer.measure) return render(std::move(one));
      renderer.measure(one.performer);
      measured.push_back(std::move(one));
      return ExitCode::kDone;
    });
  for (Cast& one : measured) attempt(one.path, [&] { return render(std::move(one)); });
  if (renderer.finish) renderer.finish();
  sayings.tell();
  if (const std::size_t all = options.files.size(); all > 1)
    std::printf(
        "%s\n",
        summary(all, verdicts, options.sheet.output.empty() ? "without a film" : "without a sheet").c_str());
  return code;
}

}  // namespace skel
