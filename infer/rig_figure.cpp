#include "infer/rig_figure.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "infer/advice.h"
#include "infer/earlier_picture.h"
#include "infer/mended.h"
#include "infer/outputs.h"
#include "libskel/animation/clip_library.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/sha256.h"
#include "libskel/image/read_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/mesh/read_mesh.h"
#include "libskel/pipeline/rig_drawing.h"
#include "libskel/pipeline/trace.h"
#include "libskel/recognition/tree_recognition.h"
#include "libskel/skeleton/mark_placed.h"
#include "libskel/skeleton/outside_figure.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

std::string sizeText(long width, long height) { return std::to_string(width) + "x" + std::to_string(height); }

// Reads the mask that is used and returns its path and hash, "": none. A skeleton that was handed in brings
// its own.
SkeletonFile::Mask useMask(const InferOptions& options, const MendedFiles& mended,
                           const std::optional<SkeletonFile>& given, RigInput& input) {
  std::optional<LookAtOutputs> look;
  if (mended.painted_silhouette) look.emplace();
  std::string path = mended.mask;
  if (path.empty() && given && given->mask) {
    path = (fs::path(options.skeleton_file).parent_path() / given->mask->file).string();
    if (sha256(readFile(path)) != given->mask->sha256)
      throw InputError(path, "has changed since " + options.skeleton_file +
                                 " was made with it; name it by --mask if that is meant");
  }
  if (path.empty()) return {};
  input.mask = readMask(path);
  if (input.mask->cols() != input.image.width || input.mask->rows() != input.image.height)
    throw InputError(path, "is a mask of " + sizeText(input.mask->cols(), input.mask->rows()) +
                               " px, the image has " + sizeText(input.image.width, input.image.height));
  return {path, sha256(readFile(path))};
}

// The skeleton says which figure it belongs to; a number that was asked for must be that one.
int figureOf(const InferOptions& options, const SkeletonFile& given, int asked) {
  if (asked != 1 && asked != given.figure.number)
    throw InputError(options.skeleton_file, "belongs to figure " + std::to_string(given.figure.number) +
                                                " of the drawing, --figure asks for " +
                                                std::to_string(asked));
  return given.figure.number;
}

// The joints must be this figure's. `file`: where they are from.
void checkJoints(const Skeleton& skeleton, const std::string& file, int figure, const Plane8& mask) {
  const Joint* stray = jointFarOutside(skeleton, mask);
  if (!stray) return;
  throw InputError(file, "joint \"" + stray->name + "\" lies far outside figure " + std::to_string(figure) +
                             " of the drawing; place it on the figure, or take the skeleton of this one");
}

constexpr const char* kOutlineChanged =
    "the figure is not outlined as it was when the joints were found: look at them";

bool wasEdited(const Skeleton& skeleton) {
  return std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                     [](const Joint& joint) { return joint.origin == JointOrigin::kEdited; });
}

// What to say of a figure whose joints were given.
std::vector<std::string> warningsOf(const SkeletonFile& given, const RiggedDrawing& drawing, bool own_mask) {
  std::vector<std::string> warnings = drawing.silhouette.warnings;
  // What was said of joints before somebody moved them is stale, but for what is still missing.
  std::vector<std::string> of_joints = given.warnings;
  if (wasEdited(given.skeleton)) of_joints = {missingNote(given.missing)};
  for (const std::string& warning : of_joints)
    if (!warning.empty() && std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
      warnings.push_back(warning);
  if (!own_mask && !given.figure.sha256.empty() && given.figure.sha256 != outlineHash(drawing.silhouette))
    warnings.push_back(kOutlineChanged);
  return warnings;
}

bool looksForJoints(const RigOptions& rig) { return rig.last >= LastStage::kJoints; }

Verdict verdictOf(const RigOptions& rig, const RiggedDrawing& drawing, const SkeletonFile& file) {
  constexpr double kRecognized = .5;
  const Silhouette& silhouette = drawing.silhouette;
  const bool guessed =
      looksForJoints(rig) && drawing.recognition.likeness < kRecognized && !wasEdited(file.skeleton);
  if (guessed || silhouette.is_sheet || !silhouette.cut_sides.empty()) return Verdict::kRetake;
  return file.warnings.empty() ? Verdict::kFine : Verdict::kLookAt;
}

// Of clips that were asked for, and of limbs.
std::vector<Note> notesOf(const InferOptions& options, const RigOptions& rig, const RiggedDrawing& drawing) {
  std::vector<Note> notes;
  for (const std::string& name : options.clips)
    if (name != "none" && rig.last == LastStage::kClips && !hasClip(drawing.clips, name))
      notes.push_back({"there is no clip \"" + name + "\" for a " + drawing.body_plan.name + ": left out"});
  if (std::string note = namingNote(drawing.character.skeleton, options.joints);
      rig.last >= LastStage::kModel && !note.empty())
    notes.push_back({std::move(note)});
  if (rig.last == LastStage::kClips) {
    const bool other = rig.otherwise && drawing.body_plan.name == rig.otherwise->body_plan.name;
    std::vector<Clip> own = other ? rig.otherwise->clips : rig.clips;
    std::erase_if(own, [](const Clip& clip) { return !isOwn(clip); });
    for (Note& note : armNotes(drawing.character, own)) notes.push_back(std::move(note));
  }
  if (options.model_file.empty() && rig.layers)
    for (Note& note : limbNotes(drawing, drawing.clips)) notes.push_back(std::move(note));
  return notes;
}

// A drawing whose figures are rigged one after the other.
struct OpenDrawing {
  OpenDrawing(const RigJob& job, const SilhouetteOptions& silhouette) : figures(silhouette) {
    const std::string bytes = job.read ? "" : readFile(job.source);
    image = decodeImage(job.read ? job.read->bytes : bytes, job.source);
    image_sha256 = job.read ? job.read->sha256 : sha256(bytes);
  }

  Image image;
  std::string image_sha256;
  FigureFinder figures;
};

// Rigs one figure, writes its files and adds what became of it. Returns how many figures there are in the
// drawing, which is opened by the first of them.
int rigFigure(const InferOptions& options, const RigOptions& rig, const RigJob& job, int figure,
              std::unique_ptr<OpenDrawing>& open, std::vector<FigureResult>& results) {
  const std::string& handed_in = options.skeleton_file;
  std::optional<SkeletonFile> given;
  if (!handed_in.empty() && !handed_in.ends_with(kLabelFileEnding)) {
    const std::string text = readFile(handed_in);
    given = parseSkeletonFile(text, handed_in, planOfSkeleton(text, handed_in, rig));
    figure = figureOf(options, *given, figure);
  }
  const std::string stem = stemOf(options, job, figure);
  const std::string skeleton_path = options.out_dir + "/" + stem + ".skeleton.json";
  std::error_code no_file;
  if (!handed_in.empty() && !options.force && !fs::equivalent(skeleton_path, handed_in, no_file) &&
      writes(options, "json") && hasEditedJoint(skeleton_path))
    throw InputError(
        skeleton_path,
        "holds joints that were edited by hand; go on from it by --skeleton, or give --force to lose them");

  RigInput input;
  std::string image_sha256;
  if (!isModelAlone(options)) {
    SilhouetteOptions silhouette = rig.silhouette;
    silhouette.all = options.figure == "all";
    if (!open) open = std::make_unique<OpenDrawing>(job, silhouette);
    image_sha256 = open->image_sha256;
    if (silhouette.all) {
      input.image = open->image;
      input.figures = &open->figures;
    } else {
      input.image = std::move(open->image);
    }
  }
  if (!options.model_file.empty()) input.model = readMesh(options.model_file);
  if (given) {
    if (given->image_width != input.image.width || given->image_height != input.image.height)
      throw InputError(handed_in, "belongs to an image of " +
                                      sizeText(given->image_width, given->image_height) + " px, " +
                                      job.source + " has " + sizeText(input.image.width, input.image.height));
    input.skeleton = given->skeleton;
    input.turned_deg = given->figure.turned_deg;
  }
  MendedFiles mended = mendedFiles(options, job.source, stem, figure, image_sha256);
  leaveOutOtherSizes(mended, input.image);
  const PlacedJoints placed =
      placedJoints(mended, options, rig, job.source, input.image, image_sha256, figure);
  if (placed.skeleton) {
    input.skeleton = placed.skeleton->skeleton;
    input.turned_deg = placed.skeleton->figure.turned_deg;
  } else {
    input.placed = placed.joints;
  }
  const SkeletonFile::Mask used_mask = useMask(options, mended, given, input);
  const std::string& mask = used_mask.file;
  if (!mended.limbs.empty()) input.layers = {readImage(mended.limbs), mended.limbs};
  if (!mended.back.empty()) input.back = {readImage(mended.back), mended.back};

  RigOptions figure_rig = forBodyPlan(rig, placed.body_plan);
  figure_rig.silhouette.figure = std::max(figure, 1);
  figure_rig.silhouette.all = options.figure == "all";
  if (given || !placed.joints.empty()) figure_rig.last = std::max(figure_rig.last, LastStage::kJoints);
  RiggedDrawing drawing = rigCharacter(std::move(input), figure_rig);
  if (!drawing.found()) throw InputError(mask.empty() ? job.source : mask, drawing.silhouette.reason);
  std::vector<std::string> warnings;
  if (given) checkJoints(given->skeleton, handed_in, figure, drawing.silhouette.mask);
  if (const auto& as_it_stands = given ? given : placed.skeleton) {
    drawing.recognition.confidence = as_it_stands->confidence;
    drawing.recognition.missing = as_it_stands->missing;
    warnings = warningsOf(*as_it_stands, drawing, !mask.empty());
  } else {
    warnings = figureNotes(drawing);
  }
  const std::string outline = outlineHash(drawing.silhouette);
  if (!placed.joints.empty()) {
    checkJoints(drawing.recognition.skeleton, mended.skeleton.empty() ? mended.labels : mended.skeleton,
                figure, drawing.silhouette.mask);
    if (!placed.skeleton && mask.empty() && !placed.outline_sha256.empty() &&
        placed.outline_sha256 != outline)
      warnings.push_back(kOutlineChanged);
  }
  for (const char* warning : warningsOfEarlier(mended)) warnings.emplace_back(warning);

  SkeletonFile file;
  file.image_file = pathSeenFrom(skeleton_path, job.source);
  file.image_sha256 = image_sha256;
  file.image_width = drawing.image.width;
  file.image_height = drawing.image.height;
  file.figure = {figure, outline, drawing.recognition.turned_deg};
  file.skeleton = drawing.recognition.skeleton;
  file.confidence = drawing.recognition.confidence;
  file.missing = drawing.recognition.missing;
  file.warnings = std::move(warnings);
  if (!mask.empty()) file.mask = {pathSeenFrom(skeleton_path, mask), used_mask.sha256};
  file.labels = placed.labels;
  if (file.labels && !mended.labels.empty()) file.labels->file = pathSeenFrom(skeleton_path, mended.labels);

  const std::vector<KeptFile> kept = keepEarlier(mended, options, skeleton_path);
  FigureResult result;
  result.outputs = writeOutputs(options, stem, drawing, file, mended.painted_silhouette ? mended.mask : "");
  if (!options.trace_dir.empty()) {
    const bool given_mask = !mask.empty() || isModelAlone(options);
    writeTrace(drawing, given_mask ? SilhouetteSteps{} : silhouetteSteps(drawing.image),
               options.images.size() > 1 || options.figure == "all" ? options.trace_dir + "/" + stem
                                                                    : options.trace_dir);
  }

  result.number = figure;
  result.mend_file = fileToMend(options, job, figure);
  if (looksForJoints(figure_rig)) result.confidence = file.confidence;
  result.body_plan = drawing.body_plan.name;
  result.missing = file.missing;
  result.placed = std::count_if(file.skeleton.joints.begin(), file.skeleton.joints.end(),
                                [](const Joint& joint) { return joint.origin == JointOrigin::kEdited; });
  result.all_placed = allPlaced(file.skeleton);
  result.verdict = verdictOf(figure_rig, drawing, file);
  result.reasons = file.warnings;
  result.notes = notesOf(options, rig, drawing);
  if (const auto note = mendedNote(mended, options, placed)) result.notes.push_back(*note);
  if (const auto note = earlierNote(mended, kept)) result.notes.push_back(*note);
  if (!options.report_file.empty()) {
    result.advice = adviceOn(drawing, file, result.mend_file);
    result.pictures = reportPictures(drawing, options.clips.empty() ? "" : options.clips.front());
  }
  result.times = drawing.times;
  results.push_back(std::move(result));
  return drawing.silhouette.figure_count;
}

}  // namespace

bool isBackPicture(const std::string& back) { return !back.empty() && back != "plain" && back != "same"; }

bool isLayerMap(const std::string& layers) { return layers != "auto" && layers != "off"; }

// What was made of one of several figures keeps its name.
std::string stemOf(const InferOptions& options, const RigJob& job, int figure) {
  if (options.figure == "all") return job.stem + "-" + std::to_string(figure);
  const std::string from = fs::path(options.skeleton_file).filename().string(), start = job.stem + "-";
  constexpr std::string_view kEnding = ".skeleton.json";
  if (!from.starts_with(start) || !from.ends_with(kEnding)) return job.stem;
  const std::string number = from.substr(start.size(), from.size() - start.size() - kEnding.size());
  const bool numbered = !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
  return numbered ? start + number : job.stem;
}

std::string fileToMend(const InferOptions& options, const RigJob& job, int figure) {
  return figure > 1 ? options.out_dir + "/" + stemOf(options, job, figure) + ".skeleton.json" : job.source;
}

FigureRange figuresAskedFor(const InferOptions& options) {
  constexpr int kMostFigures = 99;
  if (options.figure == "all") return {1, kMostFigures};
  return {std::stoi(options.figure), std::stoi(options.figure)};
}

void noteResults(const InferOptions& options, const RigJob& job, const std::vector<Clip>& clips) {
  const FigureRange range = figuresAskedFor(options);
  for (int figure = range.first; figure <= range.last; ++figure)
    noteOutputs(options, stemOf(options, job, figure), clips);
}

void takeError(DrawingResult& result) {
  const Error error = caughtError(result.source);
  const std::string start = result.source + ": ";
  result.code = error.exitCode();
  result.error = result.problem = error.what();
  if (result.error.starts_with(start))
    result.problem = result.error.substr(start.size());
  else if (result.code == ExitCode::kUsage)  // for this drawing, if not for others
    result.error = start + result.problem;
}

DrawingResult rigDrawing(const InferOptions& options, const RigOptions& rig, const RigJob& job,
                         ProgressBar& progress) {
  DrawingResult result;
  result.source = job.source;
  std::size_t left = 1;  // figures
  std::unique_ptr<OpenDrawing> open;
  try {
    const int first = figuresAskedFor(options).first;
    const int count = rigFigure(options, rig, job, first, open, result.figures);
    if (options.figure == "all") left = std::size_t(count);
    progress.expect(left - 1);
    for (int figure = 2; left > 1; ++figure) {
      progress.advance();
      --left;
      rigFigure(options, rig, job, figure, open, result.figures);
    }
  } catch (...) {
    takeError(result);
  }
  progress.advance(left);
  return result;
}

}  // namespace skel
