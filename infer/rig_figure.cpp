#include "infer/rig_figure.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include "infer/advice.h"
#include "infer/keep_earlier.h"
#include "infer/outputs.h"
#include "libskel/animation/clip_library.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "libskel/image/read_image.h"
#include "libskel/mended/rig_mended.h"
#include "libskel/mesh/read_mesh.h"
#include "libskel/pipeline/drawing_notes.h"
#include "libskel/pipeline/facing.h"
#include "libskel/pipeline/rig_drawing.h"
#include "libskel/pipeline/trace.h"
#include "libskel/skeleton/mark_placed.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

bool looksForJoints(LastStage last) { return last >= LastStage::kJoints; }

// A picture that is clear around its figure is no photo, which could be taken again.
Verdict verdictOf(LastStage last, const RiggedDrawing& drawing, const SkeletonFile& file) {
  constexpr double kRecognized = .5;
  const Silhouette& silhouette = drawing.silhouette;
  const bool guessed =
      looksForJoints(last) && drawing.recognition.likeness < kRecognized && !hasPlacedJoint(file.skeleton);
  if (guessed || silhouette.is_sheet || !silhouette.cut_sides.empty())
    return silhouette.clear_around ? Verdict::kLookAt : Verdict::kRetake;
  return file.warnings.empty() ? Verdict::kFine : Verdict::kLookAt;
}

// Of nets and clips that were asked for, and of limbs.
// `alone`: no other drawing was asked for.
std::vector<Note> notesOf(const InferOptions& options, const RigOptions& rig, const RiggedDrawing& drawing,
                          bool alone) {
  std::vector<Note> notes;
  if (rig.joint_net && rig.recognizer == Recognizer::kTree && looksForJoints(rig.last) &&
      drawing.body_plan.name != rig.body_plan.name)
    notes.push_back({"the joints of this " + drawing.body_plan.name +
                     " come from the net that is built in: the one of --joint-net finds those of a " +
                     rig.body_plan.name});
  for (const std::string& name : options.clips)
    if (name != "none" && rig.last == LastStage::kClips && !hasClip(drawing.clips, name)) {
      const std::string meant = meantClip(name, clipsFor(builtinClips(), drawing.body_plan));
      notes.push_back({"there is no clip \"" + name + "\" for a " + drawing.body_plan.name +
                       (meant.empty() ? "" : ", but \"" + meant + "\"") + ": left out"});
    }
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
  // Of two in three drawings, so not where many are spoken of.
  if (alone && rig.last == LastStage::kClips)
    if (std::optional<Note> note = restNote(drawing)) notes.push_back(std::move(*note));
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
  std::optional<Plane8> painted;  // the first figure, where all are rigged and it was mended
};

// Rigs one figure, writes its files and adds what became of it. Returns how many figures there are in the
// drawing, which is opened by the first of them.
int rigFigure(const InferOptions& options, const RigOptions& rig, const RigJob& job, int figure,
              std::unique_ptr<OpenDrawing>& open, std::vector<FigureResult>& results) {
  const std::string& handed_in = options.skeleton_file;
  const std::optional<SkeletonFile> given = givenSkeleton(handed_in, rig);
  if (given) figure = figureOf(*given, handed_in, figure);
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
  const MendRequest request = mendRequest(options, job, figure, image_sha256);
  MendedRig mended = rigMended(request, rig, std::move(input), given);
  const RiggedDrawing& drawing = mended.drawing;
  const std::string& mask = mended.mask.file;

  SkeletonFile file;
  file.image_file = pathSeenFrom(skeleton_path, job.source);
  file.image_sha256 = image_sha256;
  file.image_width = drawing.image.width;
  file.image_height = drawing.image.height;
  file.figure = {figure, mended.outline_sha256, drawing.recognition.turned_deg, mended.found_outline_sha256,
                 mended.facing_deg};
  file.skeleton = drawing.recognition.skeleton;
  file.confidence = drawing.recognition.confidence;
  file.missing = drawing.recognition.missing;
  file.warnings = withAdviceIfUpright(std::move(mended.warnings), "use --upright");
  const auto asSeen = [&](SkeletonFile::Mask painted) {
    painted.file = pathSeenFrom(skeleton_path, painted.file);
    return painted;
  };
  if (!mask.empty()) file.mask = asSeen(mended.mask);
  if (!mended.limbs.file.empty()) file.limbs = asSeen(mended.limbs);
  file.labels = mended.placed.labels;
  if (file.labels && !mended.files.labels.empty())
    file.labels->file = pathSeenFrom(skeleton_path, mended.files.labels);

  std::vector<std::string> painted;
  if (mended.files.painted_silhouette) painted.push_back(mask);
  if (mended.files.painted_layers) painted.push_back(mended.files.limbs);
  const std::optional<Note> kept_layers = keepPaintedLayers(painted, mended.files, options, stem, file);
  const std::vector<KeptFile> kept = keepEarlier(mended.files, options, skeleton_path, drawing.image);
  const std::string contradicted = keepContradicted(mended, options, skeleton_path);
  const std::optional<Note> kept_model = keepModelOfOthers(options, stem);
  FigureResult result;
  result.outputs = writeOutputs(options, stem, drawing, file, painted);
  if (!options.trace_dir.empty()) {
    const bool given_mask = !mask.empty() || isModelAlone(options);
    writeTrace(drawing, given_mask ? SilhouetteSteps{} : silhouetteSteps(drawing.image),
               options.trace_dir + "/" + stem);
  }

  result.number = figure;
  result.mend_file = fileToMend(options, job, figure);
  if (looksForJoints(mended.last)) result.confidence = file.confidence;
  result.body_plan = drawing.body_plan.name;
  if (mended.last >= LastStage::kModel)
    result.facing_deg = std::round(facing(drawing.character) * 180 / std::numbers::pi);
  result.missing = file.missing;
  result.placed = std::count_if(file.skeleton.joints.begin(), file.skeleton.joints.end(),
                                [](const Joint& joint) { return joint.origin == JointOrigin::kEdited; });
  result.all_placed = allPlaced(file.skeleton);
  result.verdict = verdictOf(mended.last, drawing, file);
  result.reasons = file.warnings;
  const bool alone = options.images == std::vector{job.source} && options.list_file.empty();
  result.notes = notesOf(options, rig, drawing, alone);
  if (const auto note = mendedNote(mended.files, request, mended.placed)) result.notes.push_back(*note);
  if (const auto note = contradictionNote(mended.files, mended.placed, contradicted))
    result.notes.push_back(*note);
  if (const auto note = otherFigureNote(mended.files)) result.notes.push_back(*note);
  if (const auto note = otherPlanNote(mended.files, rig)) result.notes.push_back(*note);
  if (const auto note = unknownJointNote(mended.files)) result.notes.push_back(*note);
  for (const auto& note :
       {earlierNote(mended.files, kept), otherSizeNote(mended.files, kept), fitsAgainNote(mended.files)}) {
    if (!note) continue;
    result.left_out.push_back(*note);
    result.reasons.push_back(note->text);
    if (result.verdict == Verdict::kFine) result.verdict = Verdict::kLookAt;
  }
  for (const auto& note : {kept_layers, kept_model, keptLayersNote(mended.files, request)})
    if (note) result.notes.push_back(*note);
  const std::optional<std::string> looks_elsewhere =
      mended.last >= LastStage::kModel ? facingNote(drawing.character) : std::nullopt;
  if (looks_elsewhere) {
    result.reasons.push_back(*looks_elsewhere);
    if (result.verdict == Verdict::kFine) result.verdict = Verdict::kLookAt;
  }
  if (!options.report_file.empty()) {
    result.advice = adviceOn(drawing, file, result.mend_file, rig.otherwise.has_value());
    if (looks_elsewhere)
      result.advice.push_back("It " + noteText({*looks_elsewhere}, job.source) +
                              " (an option of skel-infer).");
    if (!result.left_out.empty()) result.advice.push_back(noteText({kAdviceOnLeftOut}, result.mend_file));
    result.pictures = reportPictures(drawing, options.clips.empty() ? "" : options.clips.front(),
                                     result.verdict == Verdict::kFine);
  }
  result.times = drawing.times;
  results.push_back(std::move(result));
  const bool found_mask = !mask.empty() && options.mask_file.empty();
  if (options.figure != "all" || figure > 1 || !found_mask) return drawing.silhouette.figure_count;
  open->painted = drawing.silhouette.mask;
  return std::max(1, open->figures.take(open->image, 1).figure_count);
}

// Whether a figure of the picture is a piece of the one that a person has painted.
bool isOfPainted(OpenDrawing& open, int figure) {
  if (!open.painted) return false;
  const Silhouette found = open.figures.take(open.image, figure);
  return found.found() && 2 * (found.mask != 0 && *open.painted != 0).count() > (found.mask != 0).count();
}

// For a report. "": it cannot be read a second time, as a pipe's.
std::string pictureOf(const RigJob& job) {
  try {
    return reportPicture(decodeImage(job.read ? job.read->bytes : readFile(job.source), job.source));
  } catch (const Error&) {
    return "";
  }
}

}  // namespace

MendRequest mendRequest(const InferOptions& options, const RigJob& job, int figure,
                        const std::string& image_sha256) {
  MendRequest request;
  request.source = job.source;
  request.image_sha256 = image_sha256;
  request.results = options.out_dir + "/" + stemOf(options, job, figure);
  request.out_dir = options.out_dir;
  request.former_names = job.former_names;
  request.figure = figure;
  request.is_one_of_all = options.figure == "all";
  request.skeleton = options.skeleton_file;
  request.mask = options.mask_file;
  if (isLayerMap(options.layers)) request.limbs = options.layers;
  if (isBackPicture(options.back)) request.back = options.back;
  request.finds_limbs = options.layers == "auto" && options.model_file.empty();
  request.finds_back = options.back.empty();
  request.takes_up = !options.force && !isModelAlone(options);
  return request;
}

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
  const std::string name = fs::path(job.source).stem().string();
  RigOptions own = rig;
  own.height_m = options.heights(name);
  if (const auto facing_deg = options.facing.given(name))
    own.facing_rad = *facing_deg * std::numbers::pi / 180;
  DrawingResult result;
  result.source = job.source;
  std::size_t left = 1;  // figures
  std::unique_ptr<OpenDrawing> open;
  try {
    const int first = figuresAskedFor(options).first;
    const int count = rigFigure(options, own, job, first, open, result.figures);
    if (options.figure == "all") left = std::size_t(count);
    progress.expect(left - 1);
    for (int figure = 2; left > 1; ++figure) {
      progress.advance();
      --left;
      if (!isOfPainted(*open, figure)) rigFigure(options, own, job, figure, open, result.figures);
    }
  } catch (const NoFigureError&) {
    takeError(result);
    result.nothing_found = figuresAskedFor(options).first == 1;
    if (!options.report_file.empty()) result.picture = pictureOf(job);
  } catch (...) {
    takeError(result);
  }
  result.opened = open || !result.figures.empty();
  if (open) result.image_sha256 = open->image_sha256;
  progress.advance(left);
  return result;
}

}  // namespace skel
