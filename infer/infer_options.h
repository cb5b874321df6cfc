// What skel-infer can be asked for.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libskel/animation/retarget.h"
#include "libskel/cli/joint_options.h"
#include "libskel/cli/named_numbers.h"
#include "libskel/core/error.h"

namespace skel {

struct InferOptions {
  std::vector<std::string> images;  // and folders of them; "-": bytes from the standard input
  std::string list_file;            // of more of them than a command line holds; "-": the standard input
  bool null_ended = false;          // the paths in it, instead of by ends of lines
  std::string shard;                // which part of the list, "I/N"; "": all of it
  std::string name;                 // of the results of one drawing; "": the drawing's
  std::string out_dir = "out";
  std::string weights_file, joint_net_file;  // empty: the built-in ones
  std::string part_net_file;                 // empty: the built-in one
  std::string mask_file, model_file, skeleton_file;
  std::string body_plan = "auto";
  std::string recognizer = "tree";
  bool upright = false;
  bool cut_limbs = false;
  std::optional<double> alpha;  // see SilhouetteOptions
  std::string candidates = "maxima";
  std::string skin = "geodesic";
  int max_influences = 4;
  std::vector<std::string> clips;  // empty: the built-in ones that fit the body plan
  std::string clips_dir;           // more of them
  double into_picture = RetargetOptions().into_picture;
  std::string rest_pose = "drawn";
  JointOptions joints;
  bool ink_hull = false;
  std::string back;             // "same", "plain", a picture, or nothing: the body plan's own
  std::string layers = "auto";  // "auto", "off", or a picture
  NamedNumbers heights;         // m; 0: the body plan's own
  NamedNumbers facing = {.of_others = std::nan("")};  // degrees, see RigOptions::facing_rad
  std::string figure = "1";                           // a number, or "all"
  double mesh_spacing_px = 0;
  std::vector<std::string> formats = {"glb", "json", "overlay", "silhouette"};
  std::string trace_dir, report_file;
  bool timings = false, quiet = false, json_lines = false;
  int jobs = 1;
  bool force = false, resume = false;

  // The options that were given and decide what is made of a drawing: name and values of each.
  std::vector<std::pair<std::string, std::vector<std::string>>> deciding;
  std::string version, nets;  // of this build: skel's, and the hashes of the nets
};

// --model without a drawing.
inline bool isModelAlone(const InferOptions& options) {
  return options.images.empty() && options.list_file.empty();
}
// Whether what becomes of drawings is written down beside their results, for a later run to go on from.
inline bool keepsResults(const InferOptions& options) { return !options.list_file.empty() || options.resume; }
inline bool tellsHashes(const InferOptions& options) { return options.json_lines || keepsResults(options); }

// Those that decide what is seen in a drawing.
void bindRecognitionOptions(CLI::App& app, InferOptions& options);
void bindInferOptions(CLI::App& app, InferOptions& options);

// Throws UsageError where options do not go together. Folders among the images are files by now.
void checkUsage(const InferOptions& options);

// Rigs all images; the exit code is that of the first failure.
ExitCode runInfer(const InferOptions& options);

}  // namespace skel
