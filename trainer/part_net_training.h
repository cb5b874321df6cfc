// skel-train parts: trains the net that says which part of a figure each pixel is.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "libskel/core/error.h"

namespace skel {

struct PartTrainingOptions {
  std::string output;      // weights file to write; needed to train
  std::string start;       // net to go on from; "": from nothing
  std::string checkpoint;  // "": none
  std::string sheet;       // picture of samples to write instead of training; "": none
  std::string truth;       // folder to write the parts of held_out to instead of training; "": none
  std::uint64_t seed = 1;
  int steps = 8000;
  int batch = 8;
  double peak_rate = 2e-3;
  double averaging = .999;            // of the weights over steps
  std::string shapes;                 // folder that script/shape-maps has written
  std::vector<std::string> drawings;  // folders of drawings with joints, see findJointedDrawings()
  std::vector<std::string> held_out;  // the same, which only measure
  double drawn_share = .7;            // of samples that come from drawings
  double posed_share = .5;            // of these whose limbs are turned
  double thing_share = .3;            // of these, posed or not, that are given things to hold or carry
  double animal_share = .2;           // of the others that go on four feet
  int threads = 0;                    // 0: one a core. The result does not depend on it.
  int report_every = 500;             // steps
};

void bindPartTrainingOptions(CLI::App& command, PartTrainingOptions& options);
ExitCode runPartTraining(const PartTrainingOptions& options);

}  // namespace skel
