// The stylizer's numbers: factorising poses beside a plain loop of multiplicative updates, deforming a
// drawing, finding key frames. Rates are those of one core: processor time, whatever else the machine does.
#include <benchmark/benchmark.h>

#include <cmath>

#include "animator/film.h"
#include "animator/load_character.h"
#include "libskel/core/parallel.h"
#include "libskel/core/rng.h"
#include "libskel/deform/arap.h"
#include "libskel/style/sparse_coding.h"
#include "libskel/style/wear_motion.h"
#include "libskel/video/figure_in_frame.h"
#include "libskel/video/outline_distance.h"
#include "stylizer/puppet.h"

namespace {

using namespace skel;

constexpr int kRows = 34, kFrames = 1029, kComponents = 8, kIterations = 200;

Eigen::MatrixXd poses() {
  Rng rng(1);
  Eigen::MatrixXd u(kRows, kComponents), v(kComponents, kFrames);
  for (double& x : u.reshaped()) x = rng.uniform();
  for (double& x : v.reshaped()) x = rng.uniform();
  return u * v / kComponents;
}

void factorise(benchmark::State& state) {
  const Eigen::MatrixXd x = poses();
  SparseCodingOptions options;
  options.max_iterations = kIterations;
  options.tolerance = 0;
  options.restarts = 1;
  double error = 0;
  for (auto _ : state) error = sparseCoding(x, options).error;
  state.counters["error_percent"] = 100 * error;
}
BENCHMARK(factorise)->Unit(benchmark::kMillisecond);

// D. Lee, S. Seung, "Algorithms for non-negative matrix factorization" (2001), as it is usually written down.
void plainUpdates(benchmark::State& state) {
  const Eigen::MatrixXd x = poses();
  double error = 0;
  for (auto _ : state) {
    Rng rng(1);
    Eigen::MatrixXd u(kRows, kComponents), v(kComponents, kFrames);
    for (double& e : u.reshaped()) e = rng.uniform();
    for (double& e : v.reshaped()) e = rng.uniform();
    for (int i = 0; i < kIterations; ++i) {
      v = v.array() * (u.transpose() * x).array() / ((u.transpose() * (u * v)).array() + 1e-9);
      u = u.array() * (x * v.transpose()).array() / (((u * v) * v.transpose()).array() + 1e-9);
    }
    error = (x - u * v).norm() / x.norm();
  }
  state.counters["error_percent"] = 100 * error;
}
BENCHMARK(plainUpdates)->Unit(benchmark::kMillisecond);

// 1,500 vertices, 17 handles.
void deform(benchmark::State& state) {
  constexpr int kColumns = 30, kLines = 50;
  Eigen::MatrixX2d v(kColumns * kLines, 2);
  Eigen::MatrixX3i t(2 * (kColumns - 1) * (kLines - 1), 3);
  for (int y = 0, n = 0; y < kLines; ++y)
    for (int x = 0; x < kColumns; ++x) {
      const int at = y * kColumns + x;
      v.row(at) << x, y;
      if (x + 1 == kColumns || y + 1 == kLines) continue;
      t.row(n++) << at, at + 1, at + kColumns + 1;
      t.row(n++) << at, at + kColumns + 1, at + kColumns;
    }
  Eigen::MatrixX2d handles(17, 2);
  for (int h = 0; h < 17; ++h) handles.row(h) << 3 + h % 4 * 8, 2 + h / 4 * 11;
  const ArapMesh mesh(v, t, handles);
  double phase = 0;
  for (auto _ : state) {
    Eigen::MatrixX2d targets = handles;
    for (int h = 0; h < 17; ++h) targets(h, 0) += 3 * std::sin(phase + h / 4);
    phase += 0.1;
    benchmark::DoNotOptimize(mesh.deform(targets).data());
  }
  state.counters["frames_per_s"] =
      benchmark::Counter(double(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(deform)->Unit(benchmark::kMillisecond);

// A drawing in the motions of skel, with what has to be turned back.
void deformDrawing(benchmark::State& state, const std::string& name) {
  constexpr int kFrames = 12;
  const std::string path = std::string(SKEL_DATASETS) + "/characters/" + name + ".png";
  const SkeletonTemplate plan = loadTemplate("biped");
  const CharacterFile file = loadCharacter({.path = path});
  const RiggedCharacter& character = file.character;
  const Puppet puppet = makePuppet(readPerformer(path));
  std::vector<Eigen::VectorXd> poses;
  for (const Clip& clip : libraryFor(character)) {
    PoseMatrix motion(34, kFrames);
    for (int f = 0; f < kFrames; ++f) {
      const std::vector<Eigen::Vector3f> joints =
          posedJoints(character.skeleton, posedAt(character, clip, double(clip.duration_s()) * f / kFrames));
      for (std::size_t j = 0; j < plan.joints.size(); ++j) {
        const Eigen::Vector3f& at = joints[std::size_t(character.skeleton.index(plan.joints[j].name))];
        motion.col(f).segment<2>(2 * Eigen::Index(j)) << double(at.x()), -double(at.y());
      }
    }
    const PoseMatrix worn = wornBy(puppet.rest, 1000 * motion, plan);
    for (int f = 0; f < kFrames; ++f) poses.push_back(worn.col(f));
  }
  for (auto _ : state)
    for (const Eigen::VectorXd& pose : poses) benchmark::DoNotOptimize(posedSheets(puppet, pose).data());
  state.counters["frames_per_s"] =
      benchmark::Counter(double(state.iterations()) * double(poses.size()), benchmark::Counter::kIsRate);
  Eigen::Index vertices = 0;
  for (const CutOutSheet& sheet : puppet.cut_out.sheets) vertices += sheet.lattice.vertices.rows();
  state.counters["vertices"] = double(vertices);
}
BENCHMARK_CAPTURE(deformDrawing, cap_boy, "cap_boy")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(deformDrawing, alien, "alien")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(deformDrawing, dad_tie, "dad_tie")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(deformDrawing, clerk, "clerk")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(deformDrawing, zombie, "zombie")->Unit(benchmark::kMillisecond);

// From decoded frames of 640×488 to distances between their outlines.
void keyFrameDistances(benchmark::State& state) {
  constexpr int kWidth = 640, kHeight = 488, kCount = 32;
  std::vector<Image> frames;
  for (int f = 0; f < kCount; ++f) {
    Image image(kWidth, kHeight);
    image.rgba.setConstant(230);
    for (int y = 80; y < 420; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double limb = 220 + 3 * f + 60 * std::sin(y / 40. + f / 5.);
        if (std::abs(x - limb) < 45) image.pixel(x, y)[1] = 60;
      }
    frames.push_back(std::move(image));
  }
  const Image background = stillBackground(frames);
  for (auto _ : state) {
    std::vector<FrameOutline> outlines(frames.size());
    parallelFor(frames.size(), 0,
                [&](std::size_t i) { outlines[i] = outlineOf(foreground(frames[i], background)); });
    benchmark::DoNotOptimize(keyFrames(successiveDistances(outlines), 0.5));
  }
  state.counters["frames_per_s"] =
      benchmark::Counter(double(state.iterations()) * kCount, benchmark::Counter::kIsRate);
}
BENCHMARK(keyFrameDistances)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
