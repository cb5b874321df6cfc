#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "infer/infer_options.h"
#include "infer/outputs.h"
#include "infer/rig_request.h"
#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/files.h"
#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
#include "libskel/core/sha256.h"
#include "libskel/image/read_image.h"
#include "libskel/image/result_picture.h"
#include "libskel/mesh/read_mesh.h"
#include "libskel/pipeline/drawing_notes.h"
#include "libskel/pipeline/rig_drawing.h"
#include "libskel/pipeline/trace.h"
#include "libskel/skeleton/outside_figure.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

template <class Value>
CLI::IsMember namesOf(const std::map<std::string, Value>& all) {
  std::vector<std::string> names;
  for (const auto& one : all) names.push_back(one.first);
  return CLI::IsMember(names);
}

// One figure of one drawing, and where it goes.
struct Job {
  std::string source;  // the file that complaints name
  std::string stem;    // of the outputs
};

// What became of a job, to be said in the order of the command line.
struct Outcome {
  ExitCode code = ExitCode::kDone;
  std::string report;      // stdout
  std::string complaints;  // stderr
};

std::string stemOf(const std::string& path) { return fs::path(path).stem().string(); }

// The images that are no results: not what skel-infer has written of a drawing (or the mask beside one),
// whose drawing is among the others, or whose skeleton file lies beside it. So `*.png` in a folder of results
// rigs the drawings alone.
std::vector<std::string> drawingsAmong(const std::vector<std::string>& images) {
  std::set<std::pair<std::string, std::string>> stems;  // and their folders
  for (const std::string& image : images)
    stems.emplace(fs::path(image).parent_path().string(), stemOf(image));
  const auto isResult = [&](const std::string& image) {
    if (images.size() < 2) return false;
    const std::string name = fs::path(image).filename().string();
    for (const std::string_view ending : kResultPictureEndings) {
      if (!name.ends_with(ending)) continue;
      const std::string stem = name.substr(0, name.size() - ending.size());
      return stems.contains({fs::path(image).parent_path().string(), stem}) ||
             fs::exists(fs::path(image).replace_filename(stem + ".skeleton.json"));
    }
    return false;
  };
  std::vector<std::string> drawings;
  for (const std::string& image : images) {
    if (isResult(image))
      std::fprintf(stderr, "skel-infer: note: %s is no drawing but what was made of one: left out\n",
                   image.c_str());
    else
      drawings.push_back(image);
  }
  if (drawings.empty() && !images.empty())
    throw UsageError("none of the images is a drawing; name one of them alone to rig it all the same");
  return drawings;
}

std::vector<Job> jobsOf(const InferOptions& options) {
  std::vector<Job> jobs;
  for (const std::string& image : options.images) jobs.push_back({image, stemOf(image)});
  if (jobs.empty()) jobs.push_back({options.model_file, stemOf(options.model_file)});
  std::map<std::string, std::string> writers;
  for (const Job& job : jobs) {
    const auto [other, is_new] = writers.emplace(job.stem, job.source);
    if (!is_new)
      throw UsageError(other->second + " and " + job.source + " would both write " + options.out_dir + "/" +
                       job.stem + ".*; rename one or run them with different -o");
  }
  return jobs;
}

// What --back names, if it is a file.
bool isPicture(const std::string& back) { return !back.empty() && back != "plain" && back != "same"; }

// What --layers names, if it is a file.
bool isLayerMap(const std::string& layers) { return layers != "auto" && layers != "off"; }

void checkUsage(const InferOptions& options) {
  const auto single = [&](const std::string& file, const char* option) {
    if (!file.empty() && options.images.size() > 1)
      throw UsageError(std::string(option) + " goes with one image, " +
                       std::to_string(options.images.size()) + " were given");
  };
  single(options.mask_file, "--mask");
  single(options.skeleton_file, "--skeleton");
  single(options.model_file, "--model");
  if (isPicture(options.back)) single(options.back, "--back FILE");
  if (isLayerMap(options.layers)) {
    single(options.layers, "--layers FILE");
    if (options.images.empty()) throw UsageError("--layers FILE needs the image that it belongs to");
    if (!options.model_file.empty()) throw UsageError("--layers FILE goes with a drawing, not with --model");
    if (options.figure == "all")
      throw UsageError("--layers FILE goes with one figure, not with --figure all");
  }
  if (options.images.empty() && options.model_file.empty())
    throw UsageError("name an image, or --model; see --help");
  if (options.images.empty() && !options.mask_file.empty())
    throw UsageError("--mask needs the image that it belongs to");
  if (options.images.empty() && !options.skeleton_file.empty())
    throw UsageError("--skeleton needs the image that it belongs to");
  if (options.figure != "all" &&
      (options.figure.empty() || options.figure.find_first_not_of("0123456789") != std::string::npos ||
       options.figure.size() > 4 || std::stoi(options.figure) < 1))
    throw UsageError("--figure is \"" + options.figure + "\", must be 1, 2, ... or all");
  if (options.figure == "all" && !options.skeleton_file.empty())
    throw UsageError("--skeleton goes with one figure, not with --figure all");
}

std::string sizeText(long width, long height) { return std::to_string(width) + "x" + std::to_string(height); }

// The mask that is used, "": none.
std::string useMask(const InferOptions& options, const std::optional<SkeletonFile>& given, RigInput& input) {
  std::string path = options.mask_file;
  if (path.empty() && given && given->mask) {
    path = (fs::path(options.skeleton_file).parent_path() / given->mask->file).string();
    if (sha256(readFile(path)) != given->mask->sha256)
      throw InputError(path, "has changed since " + options.skeleton_file +
                                 " was made with it; name it by --mask if that is meant");
  }
  if (path.empty()) return path;
  input.mask = readMask(path);
  if (input.mask->cols() != input.image.width || input.mask->rows() != input.image.height)
    throw InputError(path, "is a mask of " + sizeText(input.mask->cols(), input.mask->rows()) +
                               " px, the image has " + sizeText(input.image.width, input.image.height));
  return path;
}

// The skeleton says which figure it belongs to; a number that was asked for must be that one.
int figureOf(const InferOptions& options, const SkeletonFile& given, int asked) {
  if (asked != 1 && asked != given.figure.number)
    throw InputError(options.skeleton_file, "belongs to figure " + std::to_string(given.figure.number) +
                                                " of the drawing, --figure asks for " +
                                                std::to_string(asked));
  return given.figure.number;
}

// What was made of one of several figures keeps its name.
std::string stemOf(const InferOptions& options, const Job& job, int figure) {
  if (options.figure == "all") return job.stem + "-" + std::to_string(figure);
  const std::string from = fs::path(options.skeleton_file).filename().string(), start = job.stem + "-";
  constexpr std::string_view kEnding = ".skeleton.json";
  if (!from.starts_with(start) || !from.ends_with(kEnding)) return job.stem;
  const std::string number = from.substr(start.size(), from.size() - start.size() - kEnding.size());
  const bool numbered = !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
  return numbered ? start + number : job.stem;
}

// An input among the files that are to be written is told of before any work.
void noteResults(const InferOptions& options, const Job& job, const std::vector<Clip>& clips) {
  constexpr int kMostFigures = 99;
  for (int figure = 1; figure <= (options.figure == "all" ? kMostFigures : 1); ++figure)
    noteOutputs(options, stemOf(options, job, figure), clips);
}

// The joints must be this figure's.
void checkJoints(const InferOptions& options, const SkeletonFile& given, const Plane8& mask) {
  const Joint* stray = jointFarOutside(given.skeleton, mask);
  if (!stray) return;
  throw InputError(options.skeleton_file, "joint \"" + stray->name + "\" lies far outside figure " +
                                              std::to_string(given.figure.number) +
                                              " of the drawing; place it on the figure, or take the "
                                              "skeleton of this one");
}

// What to say of a figure whose joints were given.
std::vector<std::string> warningsOf(const SkeletonFile& given, const RiggedDrawing& drawing, bool own_mask) {
  std::vector<std::string> warnings = drawing.silhouette.warnings;
  // What was said of joints before somebody moved them is stale.
  const auto& joints = given.skeleton.joints;
  if (std::none_of(joints.begin(), joints.end(),
                   [](const Joint& joint) { return joint.origin == JointOrigin::kEdited; }))
    for (const std::string& warning : given.warnings)
      if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
  if (!own_mask && !given.figure.sha256.empty() && given.figure.sha256 != outlineHash(drawing.silhouette))
    warnings.push_back("the figure is not outlined as it was when the joints were found: look at them");
  return warnings;
}

// Rigs one figure and writes its files. Returns how many figures there are in the drawing.
int rigFigure(const InferOptions& options, const RigOptions& rig, const Job& job, int figure,
              Outcome& outcome) {
  std::optional<SkeletonFile> given;
  if (!options.skeleton_file.empty()) {
    const std::string text = readFile(options.skeleton_file);
    given = parseSkeletonFile(text, options.skeleton_file, planOfSkeleton(text, options.skeleton_file, rig));
    figure = figureOf(options, *given, figure);
  }
  const std::string stem = stemOf(options, job, figure);
  const std::string skeleton_path = options.out_dir + "/" + stem + ".skeleton.json";
  const bool writes_skeleton = std::count(options.formats.begin(), options.formats.end(), "json") > 0;
  std::error_code no_file;
  if (writes_skeleton && !options.force && !fs::equivalent(skeleton_path, options.skeleton_file, no_file) &&
      hasEditedJoint(skeleton_path))
    throw InputError(
        skeleton_path,
        "holds joints that were edited by hand; go on from it by --skeleton, or give --force to lose them");

  RigInput input;
  if (!options.images.empty()) input.image = readImage(job.source);
  if (!options.model_file.empty()) input.model = readMesh(options.model_file);
  if (given) {
    if (given->image_width != input.image.width || given->image_height != input.image.height)
      throw InputError(options.skeleton_file,
                       "belongs to an image of " + sizeText(given->image_width, given->image_height) +
                           " px, " + job.source + " has " + sizeText(input.image.width, input.image.height));
    input.skeleton = given->skeleton;
    input.turned_deg = given->figure.turned_deg;
  }
  const std::string mask = useMask(options, given, input);
  if (isLayerMap(options.layers)) input.layers = {readImage(options.layers), options.layers};
  if (isPicture(options.back)) input.back = readImage(options.back);

  RigOptions figure_rig = rig;
  figure_rig.silhouette.figure = std::max(figure, 1);
  RiggedDrawing drawing = rigCharacter(std::move(input), figure_rig);
  if (!drawing.found()) throw InputError(mask.empty() ? job.source : mask, drawing.silhouette.reason);
  std::vector<std::string> warnings;
  if (given) {
    checkJoints(options, *given, drawing.silhouette.mask);
    drawing.recognition.confidence = given->confidence;
    drawing.recognition.missing = given->missing;
    warnings = warningsOf(*given, drawing, !mask.empty());
  } else {
    warnings = figureNotes(drawing);
  }

  SkeletonFile file;
  file.image_file = pathSeenFrom(skeleton_path, job.source);
  file.image_width = drawing.image.width;
  file.image_height = drawing.image.height;
  file.figure = {figure, outlineHash(drawing.silhouette), drawing.recognition.turned_deg};
  file.skeleton = drawing.recognition.skeleton;
  file.confidence = drawing.recognition.confidence;
  file.missing = drawing.recognition.missing;
  file.warnings = std::move(warnings);
  if (!mask.empty()) file.mask = {pathSeenFrom(skeleton_path, mask), sha256(readFile(mask))};

  const std::vector<std::string> written = writeOutputs(options, stem, drawing, file);
  if (!options.trace_dir.empty()) {
    const bool given_mask = !mask.empty() || options.images.empty();
    writeTrace(drawing, given_mask ? SilhouetteSteps{} : silhouetteSteps(drawing.image),
               options.images.size() > 1 || options.figure == "all" ? options.trace_dir + "/" + stem
                                                                    : options.trace_dir);
  }

  char line[64];
  std::snprintf(line, sizeof line, "  confidence %.2f", file.confidence);
  const std::string source =
      options.figure == "all" ? job.source + ", figure " + std::to_string(figure) : job.source;
  outcome.report += source + ": " + (written.empty() ? "nothing to write" : written.front()) + line +
                    (rig.otherwise ? "  " + drawing.body_plan.name : "") + "\n";
  std::vector<std::string> notes = file.warnings;
  for (const std::string& name : options.clips)
    if (name != "none" && std::none_of(drawing.clips.begin(), drawing.clips.end(),
                                       [&](const Clip& clip) { return clip.name == name; }))
      notes.push_back("there is no clip \"" + name + "\" for a " + drawing.body_plan.name + ": left out");
  if (options.model_file.empty() && rig.layers) {
    const std::vector<std::string> of_limbs =
        limbNotes(drawing, drawing.clips, figure > 1 ? skeleton_path : job.source);
    notes.insert(notes.end(), of_limbs.begin(), of_limbs.end());
  }
  for (const std::string& note : notes) outcome.complaints += source + ": note: " + note + "\n";
  if (options.timings) {
    double total = 0;
    for (const StageTime& time : drawing.times) {
      std::snprintf(line, sizeof line, "  %-12s %8.2f ms\n", time.stage.c_str(), time.time_s * 1e3);
      outcome.report += line;
      total += time.time_s;
    }
    std::snprintf(line, sizeof line, "  %-12s %8.2f ms\n", "total", total * 1e3);
    outcome.report += line;
  }
  return drawing.silhouette.figure_count;
}

Outcome rigDrawing(const InferOptions& options, const RigOptions& rig, const Job& job) {
  Outcome outcome;
  try {
    if (options.figure == "all") {
      const int count = rigFigure(options, rig, job, 1, outcome);
      for (int figure = 2; figure <= count; ++figure) rigFigure(options, rig, job, figure, outcome);
    } else {
      rigFigure(options, rig, job, std::stoi(options.figure), outcome);
    }
  } catch (...) {
    const Error error = caughtError(job.source);
    outcome.code = error.exitCode();
    outcome.complaints += std::string("skel-infer: ") + error.what() + "\n";
  }
  return outcome;
}

}  // namespace

void bindRecognitionOptions(CLI::App& app, InferOptions& options) {
  app.add_option("--weights", options.weights_file, "Weights of the candidates' net (default: built in)")
      ->always_capture_default(false);
  app.add_option(
      "--template", options.body_plan,
      "Body plan: biped, quadruped, a .json file, or auto: the\nbiped or quadruped that a figure fits");
  app.add_option("--part-net", options.part_net_file,
                 "Weights of the net that tells the figure's parts (default: built in)")
      ->always_capture_default(false);
  app.add_option("--joint-net", options.joint_net_file,
                 "Weights of the net that finds the joints (default: built in)")
      ->always_capture_default(false);
  app.add_option(
         "--alpha", options.alpha,
         "How opaque the figure is where pictures can be seen through, 0.01 to 1: leaves a soft glow\n"
         "out (default: half of the most)")
      ->check(numberIn(0.01, 1.0))
      ->always_capture_default(false);
  app.add_flag("--upright", options.upright, "The figure is not turned: try no other orientations");
  app.add_option("--recognizer", options.recognizer, "How joints are found")
      ->check(namesOf(kRecognizerNames));
  app.add_option("--candidates", options.candidates, "Which points may be joints")
      ->check(namesOf(kCandidateNames));
  app.add_option("--jobs", options.jobs, "Drawings at a time; 0: one a core")->check(numberIn(0, 1024));
}

void bindInferOptions(CLI::App& app, InferOptions& options) {
  app.option_defaults()->always_capture_default();
  app.add_option("IMAGE", options.images, "Drawings: PNG, JPEG, WebP, BMP, TIFF, GIF")
      ->always_capture_default(false)
      ->check(pickedFiles());
  app.add_option("-o,--out", options.out_dir, "Folder for the results");
  app.add_option("--mask", options.mask_file, "The figure, white on black, instead of finding it")
      ->always_capture_default(false);
  app.add_option("--model", options.model_file,
                 "Rig this .obj instead of inflating the drawing; without an image, by its own front view")
      ->always_capture_default(false);
  app.add_option("--skeleton", options.skeleton_file, "Go on from this (corrected) .skeleton.json")
      ->always_capture_default(false);
  bindRecognitionOptions(app, options);
  app.add_option("--skin", options.skin, "How the skin follows the bones")->check(namesOf(kSkinNames));
  app.add_option("--max-influences", options.max_influences, "Joints that carry one vertex at most")
      ->check(numberIn(1, 4));
  app.add_option("--clips", options.clips,
                 "Motions to put into the .glb, or none (default: the built-in ones that fit the body plan)")
      ->delimiter(',')
      ->always_capture_default(false);
  app.add_option("--clips-dir", options.clips_dir,
                 "A folder of clip files (.clip.json) beside the built-in ones")
      ->type_name("DIR")
      ->always_capture_default(false);
  app.add_option("--into-picture", options.into_picture,
                 "How far limbs that point at the viewer turn into the picture, of figures drawn from the\n"
                 "front: 0 not at all, 1 all the way")
      ->check(numberIn(0.0, 1.0));
  app.add_option("--rest-pose", options.rest_pose, "How the character stands when nothing moves it")
      ->check(namesOf(kRestPoseNames));
  app.add_option("--names", options.naming, "What exported joints are called")->check(namesOf(kNamingNames));
  app.add_option(
         "--back", options.back,
         "What the model wears behind: plain (its colours without the face), same (the drawing), or a\n"
         "picture of it from behind (default: plain; same for an animal, which is seen from the side)")
      ->always_capture_default(false);
  app.add_option(
      "--layers", options.layers,
      "Limbs drawn over the body: auto (each a body of its own), off (all one skin), or a layer map\n"
      "(written by --formats layers) to go on from");
  app.add_option("--height", options.height_m, "Of the model, m; 0: 1.7, or 1.2 from end to end of an animal")
      ->check(zeroOrNumberIn(1e-3, 1e3));
  app.add_option("--figure", options.figure, "Which figure of the drawing: 1 is the largest; or all");
  app.add_option("--mesh-spacing", options.mesh_spacing_px,
                 "Distance of mesh vertices where the figure is 128 px long; 0: chosen")
      ->check(zeroOrNumberIn(1e-3, 64.0));
  app.add_option("--formats", options.formats, "What to write: " + formatNames())
      ->delimiter(',')
      ->check(CLI::IsMember(allFormats()));
  app.add_option("--trace", options.trace_dir, "Folder for a picture of every stage")
      ->always_capture_default(false);
  app.add_flag("--timings", options.timings, "Print how long each stage took");
  app.add_flag("--force", options.force, "Overwrite a skeleton that was edited by hand");
}

ExitCode runInfer(const InferOptions& asked) {
  checkUsage(asked);
  InferOptions options = asked;
  options.images = drawingsAmong(asked.images);
  const std::vector<Job> jobs = jobsOf(options);
  const RigOptions rig = rigOptions(options);
  for (const Job& job : jobs) noteInput(job.source);
  for (const Job& job : jobs) {
    noteResults(options, job, rig.clips);
    if (rig.otherwise) noteResults(options, job, rig.otherwise->clips);
  }
  noteUnusedWeights(options);
  ensureWritableFolder(options.out_dir);
  std::vector<Outcome> outcomes(jobs.size());
  {
    ProgressBar progress("rigging", jobs.size());
    parallelFor(jobs.size(), options.jobs, [&](std::size_t i) {
      outcomes[i] = rigDrawing(options, rig, jobs[i]);
      progress.advance();
    });
  }
  ExitCode code = ExitCode::kDone;
  for (const Outcome& outcome : outcomes) {
    std::fputs(outcome.report.c_str(), stdout);
    std::fputs(outcome.complaints.c_str(), stderr);
    if (code == ExitCode::kDone) code = outcome.code;
  }
  return code;
}

}  // namespace skel
