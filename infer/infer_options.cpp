#include "infer/infer_options.h"

#include "infer/deciding_options.h"
#include "infer/outputs.h"
#include "infer/rig_figure.h"
#include "infer/rig_request.h"
#include "libskel/cli/names.h"
#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/file_names.h"

namespace skel {
namespace {

// Of what is for many drawings, and what is not.
void checkListUsage(const InferOptions& options) {
  const bool list = !options.list_file.empty();
  const std::string many = list ? "--from" : "--resume";
  if (list && !options.images.empty())
    throw UsageError("--from names the drawings; name none beside it, or put " + options.images.front() +
                     " into the list");
  if (!list && options.null_ended) throw UsageError("--null says how the list of --from is written");
  if (!list && !options.shard.empty()) throw UsageError("--shard is a part of the list of --from");
  if (!list && !options.resume) return;
  if (!options.report_file.empty())
    throw UsageError(
        "--report holds pictures of all drawings, " +
        std::string(list ? "and a list may name any number: name the drawings, or their folder, "
                           "instead of --from, or leave out --report"
                         : "also of those that --resume leaves as they are: leave out --resume to "
                           "rig all for the page, or --report to go on"));
  if (!options.trace_dir.empty())
    throw UsageError("--trace draws every stage and does not go with " + many +
                     "; name the drawings to look into");
  for (const auto& [option, numbers] : {std::pair("--height NAME=METRES", &options.heights),
                                        std::pair("--facing NAME=DEGREES", &options.facing)})
    if (list && !numbers->of.empty())
      throw UsageError(
          std::string(option) +
          " names one drawing, and a list may hold any number of that name: give those drawings, or "
          "one number for all");
  if (isModelAlone(options)) throw UsageError("--resume goes with drawings, not with --model alone");
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
  app.add_option("--recognizer", options.recognizer,
                 "How joints are found; with paper the figure's holes are filled, also a given mask's")
      ->check(namesOf(kRecognizerNames));
  app.add_option("--candidates", options.candidates, "Which points may be joints")
      ->check(namesOf(kCandidateNames));
  app.add_option("--jobs", options.jobs, "Drawings at a time; 0: one a core")->check(numberIn(0, 1024));
}

void bindInferOptions(CLI::App& app, InferOptions& options) {
  app.option_defaults()->always_capture_default();
  app.add_option("IMAGE", options.images,
                 "Drawings, or folders of them (not those in their folders): PNG, JPEG, WebP, BMP,\n"
                 "TIFF, GIF; -: one from the standard input")
      ->always_capture_default(false)
      ->check(pickedFiles());
  app.add_option(
         "--from", options.list_file,
         "A list of drawings, one path a line (-: the standard input), however many; results lie below\n"
         "--out as the drawings lie in their folders, each with a .result.json")
      ->type_name("LIST")
      ->always_capture_default(false);
  app.add_flag("-0,--null", options.null_ended,
               "Paths in the list end with a zero byte, as those of find -print0");
  app.add_option("--shard", options.shard, "I/N: every Nth drawing of the list, from the Ith on")
      ->type_name("I/N")
      ->always_capture_default(false);
  app.add_flag(
      "--resume", options.resume,
      "Leave what an earlier run has done of the same drawing with the same options, nets and version");
  app.add_flag("--json", options.json_lines, "Print an object of JSON a drawing, one a line");
  app.add_option("--name", options.name,
                 "What the results of one drawing are called (default: as the drawing)")
      ->type_name("NAME")
      ->always_capture_default(false);
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
                 "Motions to put into the .glb, or none (default: the built-in ones that fit the body plan, "
                 "and those\n"
                 "of --clips-dir)")
      ->delimiter(',')
      ->transform(withoutBlanks())
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
  app.add_flag(
      "--ink", options.ink_hull,
      "The .glb's model wears the drawing's outline, if it has one, from all sides: an inverted hull,\n"
      "which programs that show both sides of triangles show alone");
  app.add_option(
         "--back", options.back,
         "What the model wears behind: plain (its colours without the face), same (the drawing), or a\n"
         "picture of it from behind (default: plain; same for who is drawn from the side, as animals are)")
      ->always_capture_default(false);
  app.add_option(
      "--layers", options.layers,
      "The figure's parts: auto (found), off (one skin that knows of none), or a layer map (written by\n"
      "--formats layers, mended), whose limbs are bodies of their own");
  app.add_flag("--cut-limbs", options.cut_limbs,
               "Limbs drawn over the body are cut out: they move more, and tear what they lie on");
  addNamedNumbers(
      app, "--height", options.heights, zeroOrNumberIn(1e-3, 1e3),
      "Of the model as it is drawn, raised arms and hat included, m; of several drawings NAME=METRES "
      "is of one alone, with commas in between: 1.7,dwarf=1.2 (default: 1.7, or 1.2 from end to end "
      "of an animal)");
  addNamedNumbers(app, "--facing", options.facing, numberIn(-180.0, 180.0),
                  "Which way the figure looks, degrees, where skel is wrong: 0 at you, 90 to the right of "
                  "the picture, -90 to the left, 45 and -45 between; NAME=DEGREES of one drawing of several");
  app.add_option("--figure", options.figure, "Which figure of the drawing: 1 is the largest; or all");
  app.add_option("--mesh-spacing", options.mesh_spacing_px,
                 "Distance of mesh vertices where the figure is 128 px long; 0: chosen")
      ->check(zeroOrNumberIn(1e-3, 64.0));
  app.add_option("--formats", options.formats, "What to write: " + formatNames())
      ->delimiter(',')
      ->check(CLI::IsMember(allFormats()));
  app.add_option("--trace", options.trace_dir,
                 "Folder in which each drawing gets one with a picture of every stage")
      ->check([](const std::string& name) {
        return name.starts_with('-') ? "needs the name of a folder" : std::string();
      })
      ->type_name("FOLDER")
      ->always_capture_default(false);
  app.add_option(
         "--report", options.report_file,
         "A page of HTML that shows each drawing beside its moving figure, and what to mend or take again")
      ->type_name("FILE")
      ->always_capture_default(false)
      ->check(outputFile());
  app.add_flag("--quiet", options.quiet, "Say what went wrong, nothing else");
  app.add_flag("--timings", options.timings, "Print how long each stage took");
  app.add_flag("--force", options.force, "Leave out what was mended by hand, overwrite mended skeletons");
  app.parse_complete_callback([&] { options.deciding = decidingOptions(app); });
}

void checkUsage(const InferOptions& options) {
  const bool list = !options.list_file.empty();
  const auto single = [&](const std::string& value, const char* option) {
    if (!value.empty() && list)
      throw UsageError(std::string(option) + " goes with one image, not with --from");
    if (!value.empty() && options.images.size() > 1)
      throw UsageError(std::string(option) + " goes with one image, " +
                       std::to_string(options.images.size()) + " were given");
  };
  single(options.mask_file, "--mask");
  single(options.skeleton_file, "--skeleton");
  single(options.model_file, "--model");
  if (isBackPicture(options.back)) single(options.back, "--back FILE");
  if (options.cut_limbs && options.layers != "auto")
    throw UsageError("--cut-limbs cuts out what is found, --layers " + options.layers + " finds nothing");
  if (isLayerMap(options.layers)) {
    single(options.layers, "--layers FILE");
    if (options.images.empty()) throw UsageError("--layers FILE needs the image that it belongs to");
    if (!options.model_file.empty()) throw UsageError("--layers FILE goes with a drawing, not with --model");
    if (options.figure == "all")
      throw UsageError("--layers FILE goes with one figure, not with --figure all");
  }
  single(options.name, "--name");
  if (safeFileName(options.name) != options.name && !options.name.empty())
    throw UsageError("--name is \"" + options.name + "\", which is no name for files; \"" +
                     safeFileName(options.name) + "\" is one");
  checkListUsage(options);
  if (isModelAlone(options) && options.model_file.empty())
    throw UsageError("name an image, or --model; see --help");
  if (isModelAlone(options) && !options.mask_file.empty())
    throw UsageError("--mask needs the image that it belongs to");
  if (isModelAlone(options) && !options.skeleton_file.empty())
    throw UsageError("--skeleton needs the image that it belongs to");
  if (options.figure != "all" &&
      (options.figure.empty() || options.figure.find_first_not_of("0123456789") != std::string::npos ||
       options.figure.size() > 4 || std::stoi(options.figure) < 1))
    throw UsageError("--figure is \"" + options.figure + "\", must be 1, 2, ... or all");
  if (options.figure == "all" && !options.skeleton_file.empty())
    throw UsageError("--skeleton goes with one figure, not with --figure all");
}

}  // namespace skel
