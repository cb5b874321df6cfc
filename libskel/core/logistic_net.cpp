#include "libskel/core/logistic_net.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "libskel/core/check.h"
#include "libskel/core/json.h"
#include "libskel/core/net_format.h"

namespace skel {
namespace {

constexpr double kMostWeight = 1e6, kLeastDeviation = 1e-9;
constexpr std::size_t kMostHidden = 64;
constexpr int kFileVersion = 1;

Eigen::VectorXd vectorAt(const JsonValue& value, std::size_t size) {
  value.asNumbers(size);
  Eigen::VectorXd out(static_cast<Eigen::Index>(size));
  for (std::size_t i = 0; i < size; ++i)
    out[static_cast<Eigen::Index>(i)] = value.item(i).asNumber(-kMostWeight, kMostWeight);
  return out;
}

std::string listed(const Eigen::VectorXd& numbers) {
  return nlohmann::json(std::vector<double>(numbers.begin(), numbers.end())).dump();
}

}  // namespace

Eigen::VectorXd LogisticNet::standardized(const Eigen::VectorXd& inputs) const {
  constexpr double kMost = 3;  // deviations: what lies farther off than all that was learned says no more
  return (inputs - mean).cwiseQuotient(deviation).cwiseMax(-kMost).cwiseMin(kMost);
}

double LogisticNet::logOdds(const Eigen::VectorXd& inputs) const {
  SKEL_CHECK_EQ(inputs.size(), mean.size());
  const Eigen::VectorXd x = standardized(inputs);
  const Eigen::VectorXd units = (hidden * x + hidden_bias).array().tanh();
  return bias + direct.dot(x) + out.dot(units);
}

double LogisticNet::probability(const Eigen::VectorXd& inputs) const {
  return 1 / (1 + std::exp(-logOdds(inputs)));
}

LogisticNet logisticNetAt(const JsonValue& value, const std::vector<std::string>& inputs) {
  value.allowOnly({"inputs", "mean", "deviation", "direct", "hidden", "hidden_bias", "out", "bias"});
  const std::vector<JsonValue> names = value.at("inputs").items();
  if (names.size() != inputs.size())
    value.at("inputs").fail("has " + std::to_string(names.size()) + " names, this program knows " +
                            std::to_string(inputs.size()));
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].asString() != inputs[i]) names[i].fail("must be \"" + inputs[i] + "\"");
  LogisticNet net;
  net.mean = vectorAt(value.at("mean"), inputs.size());
  net.deviation = vectorAt(value.at("deviation"), inputs.size());
  if (net.deviation.minCoeff() < kLeastDeviation)
    value.at("deviation").fail("has a number that is not above 0");
  net.direct = vectorAt(value.at("direct"), inputs.size());
  const std::vector<JsonValue> rows = value.at("hidden").items();
  if (rows.size() > kMostHidden)
    value.at("hidden").fail("has " + std::to_string(rows.size()) + " units, may have " +
                            std::to_string(kMostHidden));
  net.hidden.resize(static_cast<Eigen::Index>(rows.size()), net.mean.size());
  for (std::size_t h = 0; h < rows.size(); ++h)
    net.hidden.row(static_cast<Eigen::Index>(h)) = vectorAt(rows[h], inputs.size()).transpose();
  net.hidden_bias = vectorAt(value.at("hidden_bias"), rows.size());
  net.out = vectorAt(value.at("out"), rows.size());
  net.bias = value.at("bias").asNumber(-kMostWeight, kMostWeight);
  return net;
}

std::string formatLogisticNet(const LogisticNet& net, const std::vector<std::string>& inputs) {
  std::string text = "{\n    \"inputs\": " + nlohmann::json(inputs).dump() +
                     ",\n    \"mean\": " + listed(net.mean) +
                     ",\n    \"deviation\": " + listed(net.deviation) +
                     ",\n    \"direct\": " + listed(net.direct) + ",\n    \"hidden\": [";
  for (Eigen::Index h = 0; h < net.hidden.rows(); ++h)
    text += (h ? ",\n      " : "\n      ") + listed(net.hidden.row(h).transpose());
  return text + "],\n    \"hidden_bias\": " + listed(net.hidden_bias) + ",\n    \"out\": " + listed(net.out) +
         ",\n    \"bias\": " + nlohmann::json(net.bias).dump() + "\n  }";
}

LogisticNetFile parseLogisticNetFile(std::string_view text, const std::string& file,
                                     const std::string& format, const std::vector<std::string>& inputs) {
  checkNetFormat(text, file, format);
  const JsonDocument document = JsonDocument::parse(text, file);
  const JsonValue root = document.root();
  root.checkFormat(format, kFileVersion);
  root.allowOnly({"format", "version", "provenance", "net"});
  return {logisticNetAt(root.at("net"), inputs), root.at("provenance").asString()};
}

std::string formatLogisticNetFile(const LogisticNetFile& file, const std::string& format,
                                  const std::vector<std::string>& inputs) {
  return "{\n  \"format\": \"" + format + "\",\n  \"version\": " + std::to_string(kFileVersion) +
         ",\n  \"provenance\": " + nlohmann::json(file.provenance).dump() +
         ",\n  \"net\": " + formatLogisticNet(file.net, inputs) + "\n}\n";
}

}  // namespace skel
