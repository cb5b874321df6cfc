#include "libskel/import/read_weights.h"

#include <algorithm>
#include <array>
#include <vector>

#include "libskel/core/json.h"

namespace skel {

SkinWeights readWeights(const std::string& path, const RiggedCharacter& character) {
  const JsonDocument document = JsonDocument::readFile(path);
  const JsonValue root = document.root();
  root.checkFormat("skel-skin", 1);
  root.allowOnly({"format", "version", "joints", "vertices"});
  std::vector<int> joints;
  for (const JsonValue& item : root.at("joints").items()) {
    joints.push_back(character.skeleton.find(item.asString()));
    if (joints.back() < 0) item.fail("the skeleton has no joint \"" + item.asString() + "\"");
  }
  const JsonValue list = root.at("vertices");
  const std::vector<JsonValue> vertices = list.items();
  const Eigen::Index count = character.mesh.vertices.rows();
  if (static_cast<Eigen::Index>(vertices.size()) != count)
    list.fail("are " + std::to_string(vertices.size()) + ", the model has " + std::to_string(count));
  SkinWeights result;
  result.joints.setZero(count, 4);
  result.weights.setZero(count, 4);
  for (Eigen::Index v = 0; v < count; ++v) {
    const JsonValue& vertex = vertices[static_cast<std::size_t>(v)];
    vertex.allowOnly({"joints", "weights"});
    const std::vector<JsonValue> names = vertex.at("joints").items(), shares = vertex.at("weights").items();
    if (names.size() != shares.size() || names.size() > 4 || names.empty())
      vertex.fail("must have 1 to 4 joints and as many weights");
    std::vector<std::pair<float, int>> row;
    float sum = 0;
    for (std::size_t k = 0; k < names.size(); ++k) {
      const int joint =
          joints[static_cast<std::size_t>(names[k].asInt(0, static_cast<int>(joints.size()) - 1))];
      row.emplace_back(static_cast<float>(shares[k].asNumber(0, 1e6)), joint);
      sum += row.back().first;
    }
    if (!(sum > 0)) vertex.at("weights").fail("are all 0");
    std::stable_sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (std::size_t k = 0; k < row.size() && row[k].first > 0; ++k) {
      result.joints(v, static_cast<Eigen::Index>(k)) = static_cast<std::uint16_t>(row[k].second);
      result.weights(v, static_cast<Eigen::Index>(k)) = row[k].first / sum;
    }
  }
  return result;
}

}  // namespace skel
