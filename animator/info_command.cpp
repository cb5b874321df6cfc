#include "animator/info_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "animator/rig_source.h"
#include "animator/rig_text.h"
#include "libskel/core/text.h"
#include "libskel/mesh/read_mesh.h"
#include "libskel/skin/parts.h"

namespace skel {
namespace {

// "1 joint", "2 joints"
std::string numbered(Eigen::Index count, const char* thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

void printMesh(const TriangleMesh& mesh) {
  const MeshParts parts = meshParts(mesh, Welding(mesh.vertices));
  const Eigen::RowVector3f low = mesh.vertices.colwise().minCoeff(),
                           high = mesh.vertices.colwise().maxCoeff();
  std::printf("mesh: %d vertices, %s, %s\n", static_cast<int>(mesh.vertices.rows()),
              numbered(mesh.triangles.rows(), "triangle").c_str(), numbered(parts.count, "part").c_str());
  std::printf("size: %g m wide, %g m high, %g m deep, from y = %g\n", static_cast<double>(high[0] - low[0]),
              static_cast<double>(high[1] - low[1]), static_cast<double>(high[2] - low[2]),
              static_cast<double>(low[1]) + 0.0);  // not "-0"
  if (mesh.texture.empty()) {
    std::printf("texture: none\n");
  } else {
    std::printf("texture: %d x %d px\n", mesh.texture.width, mesh.texture.height);
  }
}

void printSkeleton(const Skeleton& skeleton) {
  std::printf("skeleton: %s, %s%s%s\n", numbered(Eigen::Index(skeleton.joints.size()), "joint").c_str(),
              numbered(boneCount(skeleton), "bone").c_str(), skeleton.template_name.empty() ? "" : ", ",
              printable(skeleton.template_name).c_str());
  for (const auto& [j, spaces] : asTree(skeleton)) {
    const Eigen::Vector3d& at = skeleton.joints[j].position;
    std::printf("%s%s (%.3f, %.3f, %.3f)\n", spaces.c_str(), printable(skeleton.joints[j].name).c_str(),
                at.x(), at.y(), at.z());
  }
}

void printWeights(const SkinWeights& weights) {
  int most = 0;
  Eigen::Index whole = 0;
  for (Eigen::Index v = 0; v < weights.weights.rows(); ++v) {
    const int count = static_cast<int>((weights.weights.row(v).array() > 0).count());
    most = std::max(most, count);
    whole += count == 1;
  }
  std::printf("weights: up to %s a vertex, %d %s with one joint alone\n", numbered(most, "joint").c_str(),
              static_cast<int>(whole), whole == 1 ? "vertex" : "vertices");
}

}  // namespace

void bindInfoOptions(CLI::App& app, InfoOptions& options) {
  app.add_option("file", options.file, "A rigged character (.glb), or a model (.obj)")
      ->required()
      ->type_name("FILE");
  app.add_option("--skeleton", options.skeleton, "The skeleton of a model, to be told as well")
      ->type_name("FILE");
}

ExitCode runInfo(const InfoOptions& options) {
  if (std::filesystem::path(options.file).extension() != ".glb" && options.skeleton.empty()) {
    printMesh(readMesh(options.file));
    return ExitCode::kDone;
  }
  const RigModel model = readRigModel({options.file, options.skeleton, "auto"});
  const RiggedCharacter& character = model.file.character;
  if (!model.note.empty()) std::printf("%s\n", model.note.c_str());
  printMesh(character.mesh);
  printSkeleton(character.skeleton);
  if (character.weights.weights.rows() > 0) printWeights(character.weights);
  for (const Clip& clip : model.file.clips)
    std::printf("clip: %s, %.2f s, moves %s\n", printable(clip.name).c_str(),
                static_cast<double>(clip.duration_s()),
                numbered(Eigen::Index(clip.tracks.size()), "joint").c_str());
  return ExitCode::kDone;
}

}  // namespace skel
