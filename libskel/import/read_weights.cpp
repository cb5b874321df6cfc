#include "libskel/import/read_weights.h"

#include <algorithm>
#include <array>
#include <vector>

#include "libskel/core/json.h"
#include "libskel/skeleton/joint_lookup.h"

namespace skel {
namespace {

// Of each vertex of `mesh` its entry in a list of weights, one for each vertex of the mesh or of its file.
Eigen::VectorXi entriesOf(const TriangleMesh& mesh, const JsonValue& list, Eigen::Index count) {
  const Eigen::Index vertices = mesh.vertices.rows();
  const Eigen::VectorXi same = Eigen::VectorXi::LinSpaced(vertices, 0, static_cast<int>(vertices) - 1);
  const bool of_mesh = count == vertices,
             of_file = mesh.file_vertex.size() > 0 && count == mesh.file_vertices;
  if (of_mesh && of_file && mesh.file_vertex != same)
    list.fail("could be those of the model's file or of its " + std::to_string(count) +
              " vertices with copies at seams; remove vertices without faces from the model");
  if (!of_mesh && !of_file)
    list.fail("are " + std::to_string(count) + ", the model has " + std::to_string(vertices) +
              (mesh.file_vertex.size() > 0 && mesh.file_vertices != vertices
                   ? " with copies at seams, its file " + std::to_string(mesh.file_vertices)
                   : ""));
  return of_file ? mesh.file_vertex : same;
}

}  // namespace

SkinWeights readWeights(const std::string& path, const RiggedCharacter& character) {
  const JsonDocument document = JsonDocument::readFile(path);
  const JsonValue root = document.root();
  root.checkFormat("skel-skin", 1);
  root.allowOnly({"format", "version", "joints", "vertices"});
  std::vector<int> joints;
  const JointLookup known(character.skeleton);
  for (const JsonValue& item : root.at("joints").items()) {
    joints.push_back(known.find(item.asString()));
    if (joints.back() < 0) item.fail("the skeleton has no joint \"" + item.asString() + "\"");
  }
  const JsonValue list = root.at("vertices");
  const std::vector<JsonValue> vertices = list.items();
  const auto count = static_cast<Eigen::Index>(vertices.size());
  const Eigen::VectorXi entry = entriesOf(character.mesh, list, count);
  SkinWeights read;
  read.joints.setZero(count, 4);
  read.weights.setZero(count, 4);
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
      read.joints(v, static_cast<Eigen::Index>(k)) = static_cast<std::uint16_t>(row[k].second);
      read.weights(v, static_cast<Eigen::Index>(k)) = row[k].first / sum;
    }
  }
  return {read.joints(entry, Eigen::all), read.weights(entry, Eigen::all)};
}

}  // namespace skel
