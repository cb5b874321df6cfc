// How far probabilities that were said can be believed, held against what came out.
#pragma once

#include <vector>

namespace skel {

struct Forecast {
  double probability = 0;  // [0, 1], that was said
  bool came_true = false;
};

// Area under the ROC curve: the chance that of a case that came true and one that did not the first had the
// higher probability; ties count half. 0.5 where there are not both.
double areaUnderRoc(const std::vector<Forecast>& forecasts);

// Expected calibration error: of ten equal bins of the probability the distance of its mean to the share that
// came true, weighted by their counts (M. Naeini, G. Cooper, M. Hauskrecht, "Obtaining well calibrated
// probabilities using Bayesian binning", 2015). 0 without any forecast.
double calibrationError(const std::vector<Forecast>& forecasts);

}  // namespace skel
