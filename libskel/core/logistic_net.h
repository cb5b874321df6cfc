// A small net for yes or no: logistic in its inputs and in a few hidden units.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace skel {

class JsonValue;

struct LogisticNet {
  Eigen::VectorXd mean, deviation;   // of N inputs, which it brings to mean 0 and deviation 1; deviation > 0
  Eigen::VectorXd direct;            // N weights
  Eigen::MatrixXd hidden;            // H×N
  Eigen::VectorXd hidden_bias, out;  // H
  double bias = 0;

  Eigen::VectorXd standardized(const Eigen::VectorXd& inputs) const;
  double logOdds(const Eigen::VectorXd& inputs) const;
  double probability(const Eigen::VectorXd& inputs) const;  // [0, 1]
};

// In JSON, as the files of those who have one hold it. Throws InputError unless the inputs are those named.
LogisticNet logisticNetAt(const JsonValue& value, const std::vector<std::string>& inputs);
std::string formatLogisticNet(const LogisticNet& net, const std::vector<std::string>& inputs);

// A file that holds one net and nothing else.
struct LogisticNetFile {
  LogisticNet net;
  std::string provenance;  // how the numbers came to be, for people
};

// Version 1 of `format`. Throws InputError.
LogisticNetFile parseLogisticNetFile(std::string_view text, const std::string& file,
                                     const std::string& format, const std::vector<std::string>& inputs);
std::string formatLogisticNetFile(const LogisticNetFile& file, const std::string& format,
                                  const std::vector<std::string>& inputs);

}  // namespace skel
