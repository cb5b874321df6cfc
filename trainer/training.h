// Training a net on labelled characters.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "libskel/classifier/mlp.h"
#include "trainer/optimizer.h"
#include "trainer/samples.h"

namespace skel {

struct TrainingOptions {
  std::vector<int> layers = {3, 4, 4, 2};
  TrainingMethod method = TrainingMethod::kRprop;
  OptimizerOptions optimizer;  // its seed is set by `seed`
  SampleOptions samples;
  int epochs = 400;       // at most
  int restarts = 4;       // trainings from different first weights; the best is kept
  double validation = 0;  // share of the characters held out to stop early; 0: none
  int patience = 100;     // epochs without a better loss on the held-out characters before a training stops
  int seed = 1;
  int threads = 0;  // 0: one a core; does not change the result
};

struct Training {
  Mlp mlp;
  // That the kept weights took, those of the least loss. An epoch tells the loss of what it begins with: what
  // the last one makes is not judged.
  int epochs = 0;
  double loss = 0;                      // mean squared error, on the held-out characters if there are any
  std::vector<float> training_curve;    // mean squared error by epoch, of the training that was kept
  std::vector<float> validation_curve;  // the same on the held-out characters; may be empty
};

// Called from several threads after every pass.
using TrainingProgress = std::function<void(double loss)>;

// Deterministic in characters and options. At least one character; with `validation` one at least is held out
// and one at least is trained on where there are two. `generated` are trained on as they are, without mirror
// images and bent copies, and never held out; may be empty.
// The inputs are brought to mean 0 and deviation 1 for the training (LeCun et al. 1998, "Efficient
// backprop"), and the first layer of the result undoes that.
Training train(const Characters& characters, const Characters& generated, const TrainingOptions& options,
               const TrainingProgress& progress);

// The same on bare samples: nothing held out, one start.
Training trainOnce(const TrainingData& data, const TrainingData* held_out, const TrainingOptions& options,
                   int start, const TrainingProgress& progress);

}  // namespace skel
