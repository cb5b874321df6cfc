#include "trainer/cases.h"

#include <cstdio>
#include <map>

namespace skel {
namespace {

LogisticNet learnFrom(const std::vector<const Case*>& cases, const LogisticFitOptions& fit) {
  const auto count = static_cast<Eigen::Index>(cases.size());
  Eigen::MatrixXd inputs(count, cases.front()->inputs.size());
  Eigen::VectorXd came_true(count), weights(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    inputs.row(i) = cases[static_cast<std::size_t>(i)]->inputs;
    came_true[i] = cases[static_cast<std::size_t>(i)]->came_true;
    weights[i] = cases[static_cast<std::size_t>(i)]->weight;
  }
  return fitLogisticNet(inputs, came_true, weights, fit);
}

void measureOnHandsLeftOut(const std::vector<Case>& cases, const Hands& hands, const LearningOptions& options,
                           const PrintForecasts& print, const LogisticFitOptions& fit) {
  std::vector<std::string> drawings;
  for (const Case& one : cases) drawings.push_back(one.drawing);
  const std::map<std::string, int> fold_of = foldOfDrawing(drawings, hands, options.folds);
  std::map<std::string, std::vector<Forecast>> by_group;
  std::vector<Forecast> all;
  for (int fold = 0; fold < options.folds; ++fold) {
    std::vector<const Case*> learned;
    for (const Case& one : cases)
      if (fold_of.at(one.drawing) != fold) learned.push_back(&one);
    if (learned.empty()) continue;
    const LogisticNet net = learnFrom(learned, fit);
    for (const Case& one : cases) {
      if (fold_of.at(one.drawing) != fold) continue;
      all.push_back({net.probability(one.inputs), one.came_true});
      by_group[one.group].push_back(all.back());
    }
  }
  std::printf("on hands left out (%d folds):\n", options.folds);
  for (const auto& [name, forecasts] : by_group) print(name, forecasts);
  print("all", all);
}

}  // namespace

LogisticNet learnFromCases(const std::vector<Case>& cases, const Hands& hands, const LearningOptions& options,
                           const PrintForecasts& print, LogisticFitOptions fit) {
  fit.seed = static_cast<std::uint64_t>(options.seed);
  if (options.folds > 1) measureOnHandsLeftOut(cases, hands, options, print, fit);
  std::vector<const Case*> all;
  for (const Case& one : cases) all.push_back(&one);
  return learnFrom(all, fit);
}

}  // namespace skel
