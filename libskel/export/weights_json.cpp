#include <cmath>
#include <nlohmann/json.hpp>

#include "libskel/export/formats.h"
#include "libskel/export/joint_names.h"

namespace skel {

std::vector<ExportedFile> exportWeights(const ExportInput& input) {
  const SkinWeights& weights = input.character.weights;
  nlohmann::ordered_json document;
  document["format"] = "skel-skin";
  document["version"] = 1;
  document["joints"] = exportedJointNames(input.character.skeleton, input.options.naming);
  // Vertex by vertex: a document of all of them takes many times the text, and memory even to go.
  std::string text = document.dump();
  text.back() = ',';
  text += "\"vertices\":[";
  for (Eigen::Index i = 0; i < weights.weights.rows(); ++i) {
    nlohmann::ordered_json joints = nlohmann::ordered_json::array(), shares = joints;
    for (int k = 0; k < 4; ++k)
      if (weights.weights(i, k) > 0) {
        joints.push_back(weights.joints(i, k));
        shares.push_back(std::round(weights.weights(i, k) * 1e6) / 1e6);
      }
    const nlohmann::ordered_json vertex = {{"joints", std::move(joints)}, {"weights", std::move(shares)}};
    text += (i ? "," : "") + vertex.dump();
  }
  return {{".weights.json", text + "]}\n"}};
}

}  // namespace skel
