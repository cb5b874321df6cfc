#include "animator/bind_command.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "animator/glb_output.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/text.h"
#include "libskel/export/formats.h"
#include "libskel/import/read_weights.h"
#include "libskel/skin/bones.h"

namespace skel {
namespace {

// Devices have no ending.
void checkEnding(const std::string& path, const std::string& ending) {
  if (std::filesystem::path(path).has_extension() && !path.ends_with(ending))
    throw UsageError(path + ": must end in " + ending);
}

RigModel toldRigModel(const RigSource& source) {
  RigModel model = readRigModel(source);
  if (!model.note.empty()) std::printf("%s\n", model.note.c_str());
  if (!model.warning.empty()) std::fprintf(stderr, "%s\n", model.warning.c_str());
  return model;
}

// Reads the model, computes its weights and says so.
CharacterFile boundModel(const RigSource& source, const SkinRequest& skin) {
  RigModel model = toldRigModel(source);
  RiggedCharacter& character = model.file.character;
  const auto start = std::chrono::steady_clock::now();
  character.weights = weightsFor(character, source.model, skin);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  const Eigen::Vector3f size =
      (character.mesh.vertices.colwise().maxCoeff() - character.mesh.vertices.colwise().minCoeff())
          .transpose();
  constexpr float kLargest_m = 30, kSmallest_m = 0.03f;
  if (const float longest_m = size.maxCoeff(); longest_m > kLargest_m || longest_m < kSmallest_m)
    std::fprintf(stderr,
                 "%s: note: it is %.3g m long: numbers are metres here; if they are other units, scale model "
                 "and skeleton\n",
                 printable(source.model).c_str(), double(longest_m));
  std::printf("%d vertices bound to %d bones by %s in %.1f ms\n",
              static_cast<int>(character.mesh.vertices.rows()),
              static_cast<int>(skeletonBones(character.skeleton).size()), skin.method.c_str(), took.count());
  return std::move(model.file);
}

}  // namespace

void bindBindOptions(CLI::App& app, BindOptions& options) {
  bindRigSource(app, options.source);
  bindSkinRequest(app, options.skin);
  app.add_option("--weights", options.weights, "Take these weights (.weights.json) instead of computing any")
      ->type_name("FILE");
  bindJointOptions(app, options.joints);
  app.add_option("-o,--output", options.output, "The .glb to write; without: out/<model>.glb")
      ->type_name("FILE")
      ->check(outputFile());
}

ExitCode runBind(const BindOptions& options) {
  const std::string path =
      options.output.empty() ? glbNamedAfter(options.source.model, kWrittenByBind) : options.output;
  checkEnding(path, ".glb");
  noteOutput(path);
  CharacterFile file;
  if (options.weights.empty()) {
    file = boundModel(options.source, options.skin);
  } else {
    file = toldRigModel(options.source).file;
    file.character.weights = readWeights(options.weights, file.character);
  }
  if (const std::string note = namingNote(file.character.skeleton, options.joints); !note.empty())
    std::printf("%s\n", note.c_str());
  ExportOptions written = exportOptions(file.name, options.joints);
  written.generator = kWrittenByBind;
  written.ink_hull = file.ink_hull;
  writeFile(path, encodeGlb(file.character, file.clips, written));
  std::printf("wrote %s\n", printable(path).c_str());
  return ExitCode::kDone;
}

void bindWeightsOptions(CLI::App& app, WeightsOptions& options) {
  bindRigSource(app, options.source);
  bindSkinRequest(app, options.skin);
  app.add_option("-o,--output", options.output,
                 "The .weights.json to write; without: out/<model>.weights.json")
      ->type_name("FILE")
      ->check(outputFile("skel-skin"));
}

ExitCode runWeights(const WeightsOptions& options) {
  const std::string path =
      options.output.empty() ? "out/" + stemOf(options.source.model) + ".weights.json" : options.output;
  checkEnding(path, ".json");
  noteOutput(path);
  const CharacterFile file = boundModel(options.source, options.skin);
  writeFile(path, exportWeights({file.character, file.clips, {stemOf(path)}})[0].bytes);
  std::printf("wrote %s\n", printable(path).c_str());
  return ExitCode::kDone;
}

}  // namespace skel
