#include "trainer/bone_lengths.h"

#include <cmath>
#include <cstdio>

#include "libskel/cli/outputs.h"
#include "libskel/core/files.h"
#include "libskel/core/parallel.h"
#include "libskel/core/text.h"
#include "libskel/image/read_image.h"
#include "libskel/jointnet/net_joints.h"
#include "trainer/jointed_drawing.h"
#include "trainer/writable_output.h"

namespace skel {
namespace {

constexpr int kLeastDrawings = 10;  // that have a bone

class MeanAndDeviation {
 public:
  void add(double value) {
    ++count_;
    sum_ += value;
    squares_ += value * value;
  }
  bool known() const { return count_ >= kLeastDrawings; }
  double mean() const { return known() ? rounded(sum_ / count_) : 0; }
  double deviation() const {
    return known() ? rounded(std::sqrt(std::max(0., squares_ / count_ - sum_ / count_ * sum_ / count_))) : 0;
  }

 private:
  static double rounded(double value) { return std::round(value * 1e4) / 1e4; }

  int count_ = 0;
  double sum_ = 0, squares_ = 0;
};

// By joint of the net, where the drawing has it: working grid px.
std::vector<std::optional<Eigen::Vector2d>> placed(const JointedDrawing& drawing, const NetJoints& joints) {
  const Silhouette silhouette = silhouetteOf(readImage(drawing.image), drawing);
  std::vector<std::optional<Eigen::Vector2d>> places(joints.names.size());
  for (const auto& [name, image] : drawing.joints)
    for (std::size_t j = 0; j < places.size(); ++j)
      if (image && joints.names[j] == name) places[j] = silhouette.grid.gridFromImage(*image);
  return places;
}

}  // namespace

void bindBoneLengthsOptions(CLI::App& command, BoneLengthsOptions& options) {
  command.add_option("net", options.net, "Joint net that is to know them")->required()->type_name("FILE");
  command
      .add_option("--drawings", options.drawings,
                  "Drawings with known joints to measure (see skel-train joints)")
      ->required()
      ->type_name("DIR")
      ->take_all();
  command.add_option("-o,--output", options.output, "Weights file to write (default: that of the net)")
      ->check(outputFile("skel-joint-net"));
}

ExitCode runBoneLengths(const BoneLengthsOptions& options) {
  if (!options.output.empty()) ensureWritableFile(options.output);
  JointNet net = parseJointNet(readFile(options.net), options.net);
  const NetJoints joints = netJoints(net.joints, loadTemplate(net.body_plan));
  const std::vector<JointedDrawing> drawings = findJointedDrawings(options.drawings);
  std::vector<std::vector<std::optional<Eigen::Vector2d>>> places(drawings.size());
  parallelFor(drawings.size(), 0, [&](std::size_t i) { places[i] = placed(drawings[i], joints); });

  const auto count = static_cast<std::size_t>(joints.count());
  std::vector<MeanAndDeviation> lengths(count), ratios(count);
  for (const auto& at : places) {
    const auto logLength = [&](int j) -> std::optional<double> {
      const int parent = joints.parent[static_cast<std::size_t>(j)];
      if (parent < 0 || !at[static_cast<std::size_t>(j)] || !at[static_cast<std::size_t>(parent)])
        return std::nullopt;
      return BoneLength::logOf(
          (*at[static_cast<std::size_t>(j)] - *at[static_cast<std::size_t>(parent)]).norm());
    };
    for (std::size_t j = 0; j < count; ++j) {
      const int parent = joints.parent[j];
      // From the body joint, which lies somewhere in the trunk, a length says little.
      if (parent < 0 || joints.parent[static_cast<std::size_t>(parent)] < 0) continue;
      const auto length = logLength(static_cast<int>(j));
      if (!length) continue;
      // Both sides have bones of one kind.
      for (const std::size_t side : {j, static_cast<std::size_t>(joints.mirrored[j])})
        lengths[side].add(*length);
      if (const auto before = logLength(parent))
        for (const std::size_t side : {j, static_cast<std::size_t>(joints.mirrored[j])})
          ratios[side].add(*length - *before);
    }
  }
  net.bones.clear();
  for (std::size_t j = 0; j < count; ++j) {
    net.bones.push_back({lengths[j].mean(), lengths[j].deviation(), ratios[j].mean(), ratios[j].deviation()});
    if (lengths[j].known())
      std::printf("%-16s log length %.2f ± %.2f  to the bone before %.2f ± %.2f\n",
                  printable(joints.names[j]).c_str(), lengths[j].mean(), lengths[j].deviation(),
                  ratios[j].mean(), ratios[j].deviation());
  }
  if (options.output.empty())
    replaceFile(options.net, formatJointNet(net));
  else
    writeFile(options.output, formatJointNet(net));
  return ExitCode::kDone;
}

}  // namespace skel
