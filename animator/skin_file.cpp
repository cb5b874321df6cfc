#include "animator/skin_file.h"

#include <cmath>

#include "libskel/core/json.h"

namespace skel {

SkinWeights readSkinFile(const std::string& path, const RiggedCharacter& character) {
  const JsonDocument document = JsonDocument::readFile(path);
  const JsonValue root = document.root();
  root.allowOnly({"format", "version", "joints", "vertices"});
  root.checkFormat("skel-skin", 1);
  std::vector<int> joints;
  for (const JsonValue& name : root.at("joints").items()) {
    joints.push_back(character.skeleton.find(name.asString()));
    if (joints.back() < 0) name.fail("is a joint that this character lacks");
  }
  const std::vector<JsonValue> vertices = root.at("vertices").items();
  const Eigen::Index count = character.mesh.vertices.rows();
  if (Eigen::Index(vertices.size()) != count)
    root.at("vertices")
        .fail("has " + std::to_string(vertices.size()) + " vertices, the model has " + std::to_string(count));
  SkinWeights weights;
  weights.joints.setZero(count, 4);
  weights.weights.setZero(count, 4);
  for (Eigen::Index v = 0; v < count; ++v) {
    const JsonValue& vertex = vertices[std::size_t(v)];
    vertex.allowOnly({"joints", "weights"});
    const std::vector<JsonValue> carriers = vertex.at("joints").items();
    const std::vector<double> shares = vertex.at("weights").asNumbers(carriers.size());
    if (carriers.empty() || carriers.size() > 4) vertex.fail("must have 1 to 4 joints");
    double sum = 0;
    for (std::size_t k = 0; k < carriers.size(); ++k) {
      if (shares[k] < 0) vertex.at("weights").fail("has a negative weight");
      sum += shares[k];
    }
    if (std::abs(sum - 1) > 1e-3) vertex.at("weights").fail("must sum to 1");
    for (std::size_t k = 0; k < carriers.size(); ++k) {
      weights.joints(v, Eigen::Index(k)) =
          std::uint16_t(joints[std::size_t(carriers[k].asInt(0, int(joints.size()) - 1))]);
      weights.weights(v, Eigen::Index(k)) = float(shares[k] / sum);
    }
  }
  return weights;
}

}  // namespace skel
