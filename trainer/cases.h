// What a logistic net learns from, and how it is measured on hands left out.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/recognition/calibration.h"
#include "trainer/hands.h"
#include "trainer/learning_options.h"
#include "trainer/logistic_fit.h"

namespace skel {

struct Case {
  std::string group, drawing;  // group: measured by itself as well
  Eigen::VectorXd inputs;
  bool came_true = false;
  double weight = 1;  // how much it counts
};

using PrintForecasts = std::function<void(const std::string& title, const std::vector<Forecast>& forecasts)>;

// Learns from all cases, at least one, and before that, with folds, from those of all hands but a fold's,
// which it is measured on: all of them, and group by group. The seed of `fit` is that of `options`.
LogisticNet learnFromCases(const std::vector<Case>& cases, const Hands& hands, const LearningOptions& options,
                           const PrintForecasts& print, LogisticFitOptions fit = {});

}  // namespace skel
