#include "animator/skin_request.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "libskel/cli/number.h"
#include "libskel/core/error.h"

namespace skel {

void bindSkinRequest(CLI::App& app, SkinRequest& request) {
  std::vector<std::string> methods;
  for (const SkinMethod method : skinMethods()) methods.emplace_back(skinMethodName(method));
  app.add_option("--skin", request.method, "How weights are computed")
      ->check(CLI::IsMember(methods))
      ->capture_default_str();
  app.add_option("--max-influences", request.max_influences, "Joints that share a vertex, at most")
      ->check(numberIn(1, 4))
      ->capture_default_str();
  app.add_option("--smoothing", request.smoothing, "Rounds of evening out the weights of neighbours")
      ->check(numberIn(0, 1000))
      ->capture_default_str();
  app.add_option("--regions", request.regions,
                 "idw-region: which parts of the body may mix (docs/formats.md)")
      ->type_name("FILE");
}

SkinWeights weightsFor(const RiggedCharacter& character, const std::string& file,
                       const SkinRequest& request) {
  SkinOptions options;
  options.file = file;
  options.max_influences = request.max_influences;
  options.smoothing = request.smoothing;
  if (!request.regions.empty()) {
    if (request.method != "idw-region") throw UsageError("--regions goes with --skin idw-region");
    options.regions = std::make_shared<const SkinRegions>(readRegions(request.regions));
  }
  const std::vector<SkinMethod> methods = skinMethods();
  const auto method = std::find_if(methods.begin(), methods.end(),
                                   [&](SkinMethod m) { return skinMethodName(m) == request.method; });
  return computeSkinWeights(character.mesh, character.skeleton, *method, options);
}

}  // namespace skel
