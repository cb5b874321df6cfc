#include "stylizer/style_file.h"

#include <nlohmann/json.hpp>

#include "libskel/core/json.h"
#include "libskel/core/json_names.h"
#include "libskel/skeleton/joint_json.h"

namespace skel {
namespace {

constexpr const char* kFormat = "skel-style";
constexpr int kMaxFrames = 10'000'000;

// Row by row.
nlohmann::ordered_json jsonOf(const Eigen::MatrixXd& matrix) {
  auto rows = nlohmann::ordered_json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    auto row = nlohmann::ordered_json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(rounded(matrix(r, c), 1e6));
    rows.push_back(std::move(row));
  }
  return rows;
}

Eigen::MatrixXd matrixAt(const JsonValue& value) {
  const std::vector<JsonValue> rows = value.items();
  if (rows.empty()) value.fail("has no rows");
  const std::size_t columns = rows[0].items().size();
  if (columns == 0) value.fail("has no columns");
  Eigen::MatrixXd matrix(Eigen::Index(rows.size()), Eigen::Index(columns));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::vector<double> numbers = rows[r].asNumbers(columns);
    for (std::size_t c = 0; c < columns; ++c) matrix(Eigen::Index(r), Eigen::Index(c)) = numbers[c];
  }
  return matrix;
}

}  // namespace

std::string formatStyleFile(const StyleFile& style) {
  nlohmann::ordered_json root = {{"format", kFormat},
                                 {"version", 1},
                                 {"template", "biped"},
                                 {"sparsity", style.sparsity},
                                 {"objective", style.coding.objectives.back()},
                                 {"iterations", style.coding.objectives.size() - 1},
                                 {"error", rounded(style.coding.error, 1e6)},
                                 {"frames", nlohmann::ordered_json::array()}};
  for (const StyleFrame& frame : style.frames)
    root["frames"].push_back(
        {{"motion", jsonFromFileName(frame.motion)}, {"frame", frame.frame}, {"action", frame.action}});
  root["basis"] = jsonOf(style.coding.basis);
  root["activations"] = jsonOf(style.coding.activations);
  if (style.semantics)
    root["semantics"] = {{"classes", style.semantics->classes},
                         {"class_weights", jsonOf(style.semantics->class_weights)},
                         {"accuracy", rounded(style.semantics->accuracy, 1e6)}};
  return root.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

StyleFile readStyleFile(const std::string& path) {
  const JsonDocument document = JsonDocument::readFile(path);
  const JsonValue root = document.root();
  root.checkFormat(kFormat, 1);
  root.allowOnly({"format", "version", "template", "sparsity", "objective", "iterations", "error", "frames",
                  "basis", "activations", "semantics"});
  checkTemplate(root.at("template"), "biped");
  StyleFile style;
  style.sparsity = root.at("sparsity").asNumber(0, 1e9);
  style.coding.objectives = {root.at("objective").asNumber()};
  style.coding.error = root.at("error").asNumber();
  for (const JsonValue& item : root.at("frames").items()) {
    item.allowOnly({"motion", "frame", "action"});
    style.frames.push_back({item.at("motion").asFileName(), item.at("action").asString(),
                            item.at("frame").asInt(0, kMaxFrames)});
  }
  style.coding.basis = matrixAt(root.at("basis"));
  style.coding.activations = matrixAt(root.at("activations"));
  if (style.coding.basis.cols() != style.coding.activations.rows())
    root.at("activations").fail("has another number of rows than the basis has columns");
  if (std::size_t(style.coding.activations.cols()) != style.frames.size())
    root.at("frames").fail("are not as many as the activations have columns");
  if (const auto semantics = root.find("semantics")) {
    semantics->allowOnly({"classes", "class_weights", "accuracy"});
    Semantics& s = style.semantics.emplace();
    for (const JsonValue& name : semantics->at("classes").items()) s.classes.push_back(name.asString());
    s.class_weights = matrixAt(semantics->at("class_weights"));
    s.accuracy = semantics->at("accuracy").asNumber(0, 1);
  }
  return style;
}

}  // namespace skel
