#include "animator/info_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "libskel/import/read_character.h"

namespace skel {

void bindInfoOptions(CLI::App& app, InfoOptions& options) {
  app.add_option("file", options.file, "A rigged character (.glb)")->required()->type_name("FILE");
}

ExitCode runInfo(const InfoOptions& options) {
  const CharacterFile file = readGlb(options.file);
  std::printf("%s: %d vertices, %d triangles, %d joints, %d clips\n", file.name.c_str(),
              static_cast<int>(file.character.mesh.vertices.rows()),
              static_cast<int>(file.character.mesh.triangles.rows()),
              static_cast<int>(file.character.skeleton.joints.size()), static_cast<int>(file.clips.size()));
  return ExitCode::kDone;
}

}  // namespace skel
