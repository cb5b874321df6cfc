// The commands of skel-style: an options struct, a function that binds it to the command line, one that runs.
#pragma once

#include <string>
#include <vector>

#include "libskel/core/error.h"
#include "libskel/style/semantics.h"
#include "stylizer/find_keypoints.h"
#include "stylizer/performer.h"
#include "stylizer/puppet_film.h"
#include "stylizer/transfer_motion.h"

namespace CLI {
class App;
}

namespace skel {

struct KeyframesOptions {
  FilmSource film;
  std::string output = "out/keyframes";  // a folder
  double threshold = 0.5;
  bool matrix = false;
};
void bindKeyframes(CLI::App& app, KeyframesOptions& options);
ExitCode runKeyframes(const KeyframesOptions& options);

struct KeypointsCommandOptions {
  KeypointOptions find;
  bool force = false;
};
void bindKeypoints(CLI::App& app, KeypointsCommandOptions& options);
ExitCode runKeypoints(const KeypointsCommandOptions& options);

struct DatabaseOptions {
  std::string task, folder, action;
  std::vector<std::string> motions;
  bool force = false;
};
void bindDatabase(CLI::App& app, DatabaseOptions& options);
ExitCode runDatabase(const DatabaseOptions& options);

struct FitOptions {
  std::vector<std::string> motions;  // files or databases
  std::string output = "out/style.style.json";
  SparseCodingOptions coding;
  SemanticOptions semantic;
  bool all_frames = false;
};
void bindFit(CLI::App& app, FitOptions& options);
ExitCode runFit(const FitOptions& options);

// How a motion is transferred, as `transfer` and `make` are asked.
struct StyleRequest {
  SparseCodingOptions coding;
  double amount = 1;
  std::string mirror = "auto", loop = "auto", match = "phases";
};

struct TransferCommandOptions {
  std::string content, style, output = "out/transfer.motion.json";
  StyleRequest request;
  bool force = false;
};
void bindTransfer(CLI::App& app, TransferCommandOptions& options);
ExitCode runTransfer(const TransferCommandOptions& options);

// How a drawing performs, as `render` and `make` are asked.
struct PerformRequest {
  MendedSource mended;  // of a drawing
  std::string order;    // of parts, with commas
  std::string background = "white";
  int size_px = 480;
  double frame_rate = 0;  // 1/s; 0: the motion's
  double duration_s = 0;  // 0: once
  bool in_place = false;
};

struct RenderOptions2D {
  std::string character, motion, output, to_clip;
  std::string loop = "auto";
  PerformRequest perform;
};
void bindRender(CLI::App& app, RenderOptions2D& options);
ExitCode runRender(const RenderOptions2D& options);

struct InspectOptions {
  std::string motion, output = "out/inspect.png";
  SparseCodingOptions coding;
};
void bindInspect(CLI::App& app, InspectOptions& options);
ExitCode runInspect(const InspectOptions& options);

struct MakeOptions {
  std::string character, content, style, output = "out/styled.mp4", work;
  FilmSource film;
  StyleRequest request;
  PerformRequest perform;
  bool force = false;
};
void bindMake(CLI::App& app, MakeOptions& options);
ExitCode runMake(const MakeOptions& options);

// What the commands share.
MotionTransferOptions transferOptions(const StyleRequest& request);
// On stderr. `file`: where the motion is.
void sayTransferNotes(const MotionTransferReport& report, const std::string& file);
SparseCoding sparseCodingWithBar(const Eigen::MatrixXd& data, SparseCodingOptions options);
// All that a film needs but a motion, so that what cannot be made is said before a motion is looked for.
struct Stage {
  Performer performer;
  Puppet puppet;
  FilmBackground background;
};
Stage setStage(const std::string& character, const PerformRequest& request, const std::string& output);
// Performs `motion` (of the file `path`) and says so.
void perform(const Stage& stage, const MotionFile& motion, const std::string& path, bool loops,
             const PerformRequest& request, const std::string& output);

}  // namespace skel
