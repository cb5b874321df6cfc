// skel-train joints: trains the joint net on generated figures, and on drawings in other poses.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "libskel/core/error.h"

namespace skel {

// Values not given depend on whether a net is trained from nothing or goes on from another, with a few
// drawings of one style (see Schedule in the .cpp).
struct JointTrainingOptions {
  std::string body_plan = "biped";
  std::string output = "out/joint_net.bin";
  std::string start;       // net to go on from; "": from nothing
  std::string checkpoint;  // "": none
  int hourglasses = 0;     // of the net; more than `start` has are added to it. 0: as many as that, else 1
  std::uint64_t seed = 1;
  std::optional<int> steps;
  int batch = 16;
  std::optional<double> peak_rate;
  double weight_decay = 1e-4;
  std::optional<double> averaging;     // of the weights over steps
  int figures_per_round = 4096;        // drawn anew each round
  int passes = 3;                      // over the figures of a round
  double other_share = .16;            // of figures that are not whole
  double no_look_share = .25;          // of figures of which only the silhouette is shown
  double no_colours_share = .2;        // of the others: those that show only their lines
  std::vector<std::string> drawings;   // folders of drawings with joints, see findJointedDrawings()
  std::vector<std::string> rehearsed;  // folders of drawings that `start` knows, so that it forgets nothing
  std::optional<double> drawn_share;   // of figures that come from drawings and rehearsed ones
  int hard_copies = 1;             // how often a drawing counts of which `start` gets a joint wrong by 10 %
  std::optional<double> left_out;  // share of the drawings that only measure, before and after
  std::vector<int> held_back;      // body kinds not trained on
  int threads = 0;                 // 0: one a core. The result does not depend on it.
  int report_every = 500;          // steps
  int validation_figures = 1000;
};

void bindJointTrainingOptions(CLI::App& command, JointTrainingOptions& options);
ExitCode runJointTraining(const JointTrainingOptions& options);

}  // namespace skel
