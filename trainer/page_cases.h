// What is learned from drawings on hard pages (pages/hard_pages.h) and measured on hands left out.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "trainer/cases.h"
#include "trainer/pages/hard_pages.h"

namespace skel {

struct PageCaseOptions : LearningOptions {
  std::vector<std::string> drawings;  // folders, see findAnnotatedImages()
  std::string output;
};

// `format`: of the net that is to be written.
void bindPageCaseOptions(CLI::App& command, PageCaseOptions& options, const std::string& format);

// The cases of one page; their group and drawing are filled in by whoever asks.
using CasesOfPage = std::function<std::vector<Case>(const HardPage& page)>;

// learnFromCases() with each drawing in each circumstance, the group. `none`: what is said if there is no
// case.
struct LearnedFromPages {
  LogisticNet net;
  std::string provenance;  // "225 drawings, seed 1"
};
LearnedFromPages learnFromPages(const PageCaseOptions& options, const CasesOfPage& cases,
                                const PrintForecasts& print, const std::string& none,
                                const LogisticFitOptions& fit = {});

}  // namespace skel
