// skel-train pages: trains the net that tells the figure from the page it is drawn on.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "libskel/core/error.h"

namespace skel {

struct PageTrainingOptions {
  std::string output = "out/page_net.bin";
  std::string start;       // net to go on from; "": from nothing
  std::string checkpoint;  // "": none
  std::string sheet;       // picture of generated pages to write instead of training; "": none
  std::uint64_t seed = 1;
  int steps = 8000;
  int batch = 16;
  double peak_rate = 2e-3;
  std::vector<std::string> drawings;  // folders of drawings with joints, see findJointedDrawings()
  double drawn_share = .6;            // of figures that come from them
  int threads = 0;                    // 0: one a core. The result does not depend on it.
  int report_every = 500;             // steps
  int validation_pages = 300;
};

void bindPageTrainingOptions(CLI::App& command, PageTrainingOptions& options);
ExitCode runPageTraining(const PageTrainingOptions& options);

}  // namespace skel
