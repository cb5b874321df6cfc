// Binding a model to its skeleton by each method, and skinning one frame of it: the elk of datasets/elk,
// 6,700 vertices and 37 bones, and a drawn figure of about 4,100 vertices and 17 joints. Best of all runs.
// Peers, measured on the same kind of machine: the elk's own program (Python) 1,700 ms to bind and 2 ms a
// frame; for the figure Pinocchio's bone heat 108 ms, Blender 3.4's 205 ms, libigl's bounded biharmonic
// weights 8,590 ms.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>

#include "libskel/deform/skin_vertices.h"
#include "libskel/mesh/inflate.h"
#include "libskel/mesh/read_mesh.h"
#include "libskel/skeleton/place_in_mesh.h"
#include "libskel/skeleton/rig_file.h"
#include "libskel/skin/skin_weights.h"
#include "tests/support/synthetic_figure.h"

namespace skel {
namespace {

struct Model {
  TriangleMesh mesh;
  Skeleton skeleton;
};

const Model& elk() {
  static const Model model{readMesh(SKEL_DATASETS "/elk/elk.obj"),
                           yUpFromZUp(readRigFile(SKEL_DATASETS "/elk/elk.rig.json"))};
  return model;
}

const Model& figure() {
  static const Model model = [] {
    const CapsuleFigure capsules;
    Model result{
        inflate(capsuleImage(capsules), silhouetteFromMask(capsuleMask(capsules)), {.spacing_px = 1.5}),
        capsuleSkeleton(capsules)};
    for (Joint& joint : result.skeleton.joints) {
      const Eigen::Vector2d p = result.mesh.model_from_image(joint.image);
      joint.position = {p.x(), p.y(), 0};
    }
    return result;
  }();
  return model;
}

// Runs `work` and tells the least time that it took of the processor, which others may be using too.
template <class Work>
void best(benchmark::State& state, const Work& work) {
  double best_ms = 1e9;
  for (auto _ : state) {
    const std::clock_t start = std::clock();
    work();
    best_ms = std::min(best_ms, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  state.counters["best_ms"] = best_ms;
}

void bind(benchmark::State& state, const Model& (*model)(), SkinMethod method) {
  const Model& m = model();
  best(state, [&] { benchmark::DoNotOptimize(computeSkinWeights(m.mesh, m.skeleton, method)); });
  state.counters["vertices"] = static_cast<double>(m.mesh.vertices.rows());
}

void skin(benchmark::State& state, const Model& (*model)()) {
  const Model& m = model();
  const SkinWeights weights = computeSkinWeights(m.mesh, m.skeleton, SkinMethod::kGeodesic);
  std::vector<Eigen::Quaternionf> rotations(m.skeleton.joints.size(), Eigen::Quaternionf::Identity());
  for (std::size_t j = 0; j < rotations.size(); ++j)
    rotations[j] = Eigen::AngleAxisf(0.01f * static_cast<float>(j), Eigen::Vector3f::UnitX());
  const JointTransforms posed = posedFromRest(m.skeleton, rotations);
  best(state, [&] { benchmark::DoNotOptimize(skinVertices(m.mesh.vertices, weights, posed)); });
}

}  // namespace
}  // namespace skel

int main(int argc, char** argv) {
  using namespace skel;
  for (const SkinMethod method : skinMethods()) {
    const std::string name(skinMethodName(method));
    benchmark::RegisterBenchmark(("bind elk, " + name).c_str(), bind, elk, method)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("bind figure, " + name).c_str(), bind, figure, method)
        ->Unit(benchmark::kMillisecond);
  }
  benchmark::RegisterBenchmark("skin a frame of the elk", skin, elk)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("skin a frame of the figure", skin, figure)->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
