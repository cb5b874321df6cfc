// What is learned from drawings on hard pages (pages/hard_pages.h) and measured on hands left out.
#pragma once

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/recognition/calibration.h"
#include "trainer/learning_options.h"
#include "trainer/logistic_fit.h"
#include "trainer/pages/hard_pages.h"

namespace skel {

struct PageCaseOptions : LearningOptions {
  std::vector<std::string> drawings;  // folders, see findAnnotatedImages()
  std::string output;
};

void bindPageCaseOptions(CLI::App& command, PageCaseOptions& options);

struct PageCase {
  std::string circumstance, drawing;
  Eigen::VectorXd inputs;
  bool came_true = false;
  double weight = 1;  // how much it counts
};

// The cases of one page.
using CasesOfPage = std::function<std::vector<PageCase>(const HardPage& page)>;
using PrintForecasts = std::function<void(const std::string& title, const std::vector<Forecast>& forecasts)>;

// Each drawing in each circumstance; learned from the cases of all, and before that, with folds, measured on
// hands left out: all cases, and those of each circumstance. `none`: what is said if there is no case; `fit`:
// the seed is that of `options`; `format`: of the net that is to be written.
struct LearnedFromPages {
  LogisticNet net;
  std::string provenance;  // "225 drawings, seed 1"
};
LearnedFromPages learnFromPages(const PageCaseOptions& options, std::string_view format,
                                const CasesOfPage& cases, const PrintForecasts& print,
                                const std::string& none, const LogisticFitOptions& fit = {});

}  // namespace skel
