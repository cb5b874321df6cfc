// What skel-infer can be asked for.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "libskel/animation/retarget.h"
#include "libskel/cli/joint_options.h"
#include "libskel/core/error.h"

namespace skel {

struct InferOptions {
  std::vector<std::string> images;  // and folders of them
  std::string out_dir = "out";
  std::string weights_file, joint_net_file;  // empty: the built-in ones
  std::string part_net_file;                 // empty: the built-in one
  std::string mask_file, model_file, skeleton_file;
  std::string body_plan = "auto";
  std::string recognizer = "tree";
  bool upright = false;
  std::optional<double> alpha;  // see SilhouetteOptions
  std::string candidates = "maxima";
  std::string skin = "geodesic";
  int max_influences = 4;
  std::vector<std::string> clips;  // empty: the built-in ones that fit the body plan
  std::string clips_dir;           // more of them
  double into_picture = RetargetOptions().into_picture;
  std::string rest_pose = "drawn";
  JointOptions joints;
  std::string back;             // "same", "plain", a picture, or nothing: the body plan's own
  std::string layers = "auto";  // "auto", "off", or a picture
  double height_m = 0;          // 0: the body plan's own
  std::string figure = "1";     // a number, or "all"
  double mesh_spacing_px = 0;
  std::vector<std::string> formats = {"glb", "json", "overlay", "silhouette"};
  std::string trace_dir, report_file;
  bool timings = false, quiet = false;
  int jobs = 1;
  bool force = false;
};

// Those that decide what is seen in a drawing.
void bindRecognitionOptions(CLI::App& app, InferOptions& options);
void bindInferOptions(CLI::App& app, InferOptions& options);

// Rigs all images; the exit code is that of the first failure.
ExitCode runInfer(const InferOptions& options);

}  // namespace skel
