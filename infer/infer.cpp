#include <cstdio>
#include <filesystem>
#include <map>

#include "infer/class_table.h"
#include "infer/drawings.h"
#include "infer/infer_options.h"
#include "infer/outputs.h"
#include "infer/report_page.h"
#include "infer/rig_figure.h"
#include "infer/rig_request.h"
#include "libskel/cli/names.h"
#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/files.h"
#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
#include "libskel/core/text.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

std::string stemOf(const std::string& path) { return fs::path(path).stem().string(); }

std::vector<RigJob> jobsOf(const InferOptions& options) {
  std::vector<RigJob> jobs;
  for (const std::string& image : options.images) jobs.push_back({image, stemOf(image)});
  if (jobs.empty()) jobs.push_back({options.model_file, stemOf(options.model_file)});
  std::map<std::string, std::string> writers;
  for (const RigJob& job : jobs) {
    const auto [other, is_new] = writers.emplace(job.stem, job.source);
    if (!is_new)
      throw UsageError(other->second + " and " + job.source + " would both write " + options.out_dir + "/" +
                       job.stem + ".*; rename one or run them with different -o");
  }
  return jobs;
}

void checkUsage(const InferOptions& options) {
  const auto single = [&](const std::string& file, const char* option) {
    if (!file.empty() && options.images.size() > 1)
      throw UsageError(std::string(option) + " goes with one image, " +
                       std::to_string(options.images.size()) + " were given");
  };
  single(options.mask_file, "--mask");
  single(options.skeleton_file, "--skeleton");
  single(options.model_file, "--model");
  if (isBackPicture(options.back)) single(options.back, "--back FILE");
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

// Of results that were named with the drawings: once, whatever their number.
void sayLeftOut(const std::vector<std::string>& results) {
  if (results.empty()) return;
  std::fprintf(stderr, "skel-infer: note: no drawings but what was made of some, left out: %s\n",
               printable(joined(results)).c_str());
}

void print(const InferOptions& options, const RigOptions& rig, const DrawingResult& drawing) {
  for (const FigureResult& figure : drawing.figures) {
    const std::string number = options.figure == "all" ? ", figure " + std::to_string(figure.number) : "";
    std::printf("%s%s: %s  confidence %.2f%s\n", printable(drawing.source).c_str(), number.c_str(),
                figure.written.empty() ? "nothing to write" : printable(figure.written).c_str(),
                figure.confidence, rig.otherwise ? ("  " + figure.body_plan).c_str() : "");
    if (!options.timings) continue;
    double total = 0;
    for (const StageTime& time : figure.times) {
      std::printf("  %-12s %8.2f ms\n", time.stage.c_str(), time.time_s * 1e3);
      total += time.time_s;
    }
    std::printf("  %-12s %8.2f ms\n", "total", total * 1e3);
  }
}

void sayNotes(const InferOptions& options, const DrawingResult& drawing) {
  for (const FigureResult& figure : drawing.figures) {
    const std::string number = options.figure == "all" ? ", figure " + std::to_string(figure.number) : "";
    const auto say = [&](const Note& note) {
      std::fprintf(stderr, "%s%s: note: %s\n", printable(drawing.source).c_str(), number.c_str(),
                   printable(noteText(note, figure.mend_file)).c_str());
    };
    for (const std::string& reason : figure.reasons) say({reason});
    for (const Note& note : figure.notes) say(note);
  }
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
  app.add_option("IMAGE", options.images, "Drawings, or folders of them: PNG, JPEG, WebP, BMP, TIFF, GIF")
      ->always_capture_default(false)
      ->check(pickedFiles());
  app.add_option("-o,--out", options.out_dir, "Folder for the results");
  app.add_option("--mask", options.mask_file, "The figure, white on black, instead of finding it")
      ->always_capture_default(false);
  app.add_option("--model", options.model_file,
                 "Rig this .obj instead of inflating the drawing; without an image, by its own front view")
      ->always_capture_default(false);
  app.add_option("--skeleton", options.skeleton_file,
                 "Go on from this (corrected) .skeleton.json, or from the joints of a .labels.json")
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
  bindJointOptions(app, options.joints);
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
  app.add_option("--report", options.report_file,
                 "A page of HTML that shows each drawing beside its moving figure, and what to take again")
      ->type_name("FILE")
      ->always_capture_default(false)
      ->check(outputFile());
  app.add_flag("--quiet", options.quiet, "Say what went wrong, nothing else");
  app.add_flag("--timings", options.timings, "Print how long each stage took");
  app.add_flag("--force", options.force, "Leave out what was mended by hand, overwrite mended skeletons");
}

ExitCode runInfer(const InferOptions& asked) {
  InferOptions options = asked;
  NamedDrawings named = drawingsOf(asked.images);
  options.images = std::move(named.drawings);
  checkUsage(options);
  const std::vector<RigJob> jobs = jobsOf(options);
  const RigOptions rig = rigOptions(options);
  for (const RigJob& job : jobs) noteInput(job.source);
  for (const RigJob& job : jobs) {
    noteResults(options, job, rig.clips);
    if (rig.otherwise) noteResults(options, job, rig.otherwise->clips);
  }
  if (!options.quiet) {
    sayLeftOut(named.results);
    noteUnusedWeights(options);
  }
  ensureWritableFolder(options.out_dir);
  if (!options.trace_dir.empty()) ensureWritableFolder(options.trace_dir);
  if (!options.report_file.empty()) ensureWritableFolderOf(options.report_file);
  std::vector<DrawingResult> drawings(jobs.size());
  {
    ProgressBar progress("rigging", jobs.size(), !options.quiet);
    parallelFor(jobs.size(), options.jobs,
                [&](std::size_t i) { drawings[i] = rigDrawing(options, rig, jobs[i], progress); });
  }
  ExitCode code = ExitCode::kDone;
  for (const DrawingResult& drawing : drawings) {
    if (!options.quiet) print(options, rig, drawing);
    if (!options.quiet && drawings.size() == 1) sayNotes(options, drawing);
    if (!drawing.error.empty()) std::fprintf(stderr, "skel-infer: %s\n", drawing.error.c_str());
    if (code == ExitCode::kDone) code = drawing.code;
  }
  if (!options.quiet && drawings.size() > 1)
    std::fputs(classTable(drawings, options.figure == "all").c_str(), stderr);
  if (!options.report_file.empty()) {
    writeFile(options.report_file, reportPage(drawings));
    if (!options.quiet) std::printf("%s: the report\n", printable(options.report_file).c_str());
  }
  return code;
}

}  // namespace skel
