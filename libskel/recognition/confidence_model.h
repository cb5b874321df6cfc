// How sure one may be of what was found: learned from drawings that the nets had not seen (skel-train
// confidence), from what speaks for and against it (evidence.h).
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/core/logistic_net.h"
#include "libskel/recognition/evidence.h"

namespace skel {

// What the figure's net sees besides kFigureInputs: of the joints' log-odds, of those that count.
inline constexpr auto kJointSummary =
    std::to_array<std::string_view>({"least sure joint", "second least", "third least", "mean joint",
                                     "all joints"});  // the last: log of the product

struct ConfidenceModel {
  LogisticNet joint, figure;  // of kJointInputs, and of kFigureInputs and kJointSummary
  std::string provenance;     // how the numbers came to be, for people
};

struct Confidences {
  std::vector<double> joints;  // that each lies within 10 % of the figure's long side, [0, 1]
  double figure = 0;  // that every joint lies within 15 %: that the drawing is usable as it is, [0, 1]
};

Eigen::VectorXd figureInputs(const Evidence& evidence, const LogisticNet& joint);
Confidences confidencesOf(const Evidence& evidence, const ConfidenceModel& model);

// Files of format "skel-confidence". Throws InputError.
ConfidenceModel parseConfidenceModel(std::string_view text, const std::string& file);
std::string formatConfidenceModel(const ConfidenceModel& model);

// weights/confidence.json, compiled in.
const ConfidenceModel& builtInConfidenceModel();

}  // namespace skel
