// Finding the joints of a drawn character, colours and lines included, per instruction set: mean and slowest
// of the characters in datasets/characters, and how far joints lie from those of the plainest set.
#include <benchmark/benchmark.h>

#include <chrono>

#include "libskel/image/read_image.h"
#include "libskel/jointnet/tree_recognizer.h"
#include "libskel/labels/annotated_image.h"

namespace skel {
namespace {

struct Case {
  Image image;
  Silhouette silhouette;
};

const std::vector<Case>& cases() {
  static const auto all = [] {
    std::vector<Case> list;
    for (const AnnotatedImage& files : findAnnotatedImages(SKEL_DATASETS "/characters"))
      list.push_back({readImage(files.image), silhouetteOf(files.image, files.mask)});
    return list;
  }();
  return all;
}

TreeRecognition recognize(const Case& drawing, InstructionSet set) {
  const JointNet& net = builtInJointNets().of("biped");
  static const NetJoints joints = netJoints(net.joints, loadTemplate("biped"));
  const WorkingGrid& grid = drawing.silhouette.grid;
  const Plane8& mask = drawing.silhouette.grid_mask;
  const GridColours colours = gridColours(drawing.image, grid.corner_px, grid.scale, grid.width, grid.height);
  TreeRecognizerOptions options;
  options.instructions = set;
  return recognizeByJointNet(mask, figureLook(colours, mask), net, joints, options);
}

void recognition(benchmark::State& state, InstructionSet set) {
  if (!hasInstructionSet(set)) {
    state.SkipWithError("not on this machine");
    return;
  }
  double apart_px = 0;
  std::vector<double> fastest_ms(cases().size(), 1e9);
  for (auto _ : state) {
    for (std::size_t i = 0; i < cases().size(); ++i) {
      const auto start = std::chrono::steady_clock::now();
      benchmark::DoNotOptimize(recognize(cases()[i], set));
      const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
      fastest_ms[i] = std::min(fastest_ms[i], took.count());
    }
  }
  double sum_ms = 0;
  for (std::size_t i = 0; i < cases().size(); ++i) {
    sum_ms += fastest_ms[i];
    const TreeRecognition plain = recognize(cases()[i], InstructionSet::kBaseline),
                          other = recognize(cases()[i], set);
    for (std::size_t j = 0; j < plain.joints.size(); ++j)
      apart_px = std::max(apart_px, (plain.joints[j].position - other.joints[j].position).norm());
  }
  std::sort(fastest_ms.begin(), fastest_ms.end());
  state.counters["mean_ms"] = sum_ms / static_cast<double>(fastest_ms.size());
  state.counters["median_ms"] = fastest_ms[fastest_ms.size() / 2];
  state.counters["slowest_ms"] = fastest_ms.back();
  state.counters["apart_px"] = apart_px;
}
BENCHMARK_CAPTURE(recognition, sse2, InstructionSet::kBaseline)->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(recognition, avx2, InstructionSet::kAvx2)->Iterations(10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(recognition, avx512, InstructionSet::kAvx512)
    ->Iterations(10)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skel

BENCHMARK_MAIN();
