#include <algorithm>
#include <cstdio>

#include "libskel/core/files.h"
#include "libskel/core/progress.h"
#include "libskel/core/text.h"
#include "stylizer/commands.h"
#include "stylizer/style_file.h"

namespace skel {

SparseCoding sparseCodingWithBar(const Eigen::MatrixXd& data, SparseCodingOptions options) {
  ProgressBar bar("factors", options.iterations());
  options.on_iteration = [&] { bar.advance(); };
  return sparseCoding(data, options);
}

ExitCode runFit(const FitOptions& options) {
  const SkeletonTemplate plan = loadTemplate("biped");
  StyleFile style;
  style.sparsity = options.coding.sparsity;
  std::vector<Eigen::VectorXd> columns;
  for (const std::string& path : options.motions)
    for (const NamedMotion& m : readMotions(path)) {
      const PoseMatrix poses = canonicalPoses(posesOf(m.motion, plan, m.path), plan);
      const bool any_key = std::any_of(m.motion.frames.begin(), m.motion.frames.end(),
                                       [](const MotionFrame& frame) { return frame.key; });
      const std::size_t before = columns.size();
      for (std::size_t f = 0; f < m.motion.frames.size(); ++f) {
        if (any_key && !options.all_frames && !m.motion.frames[f].key) continue;
        columns.push_back(poses.col(Eigen::Index(f)));
        style.frames.push_back({m.path, m.motion.action, int(f)});
      }
      requireFewPoses(Eigen::Index(columns.size() - before), m.path);
    }
  Eigen::MatrixXd data(columns[0].size(), Eigen::Index(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) data.col(Eigen::Index(i)) = columns[i];
  style.coding = sparseCodingWithBar(data, options.coding);
  std::vector<std::string> actions;
  for (const StyleFrame& frame : style.frames) actions.push_back(frame.action);
  if (std::find(actions.begin(), actions.end(), "") == actions.end())
    style.semantics = fitSemantics(style.coding.activations, actions, options.semantic);
  writeFile(options.output, formatStyleFile(style));
  std::printf("%s: %d frames of %d numbers, %d components, off by %.2f %%, after %d iterations\n",
              printable(options.output).c_str(), int(data.cols()), int(data.rows()),
              options.coding.components, 100 * style.coding.error, int(style.coding.objectives.size()) - 1);
  if (style.semantics)
    std::printf("  %d action classes, told apart in %.1f %% of the frames\n",
                int(style.semantics->classes.size()), 100 * style.semantics->accuracy);
  return ExitCode::kDone;
}

}  // namespace skel
