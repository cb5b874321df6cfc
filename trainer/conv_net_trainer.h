// One step after the other of AdamW on batches of images, for any convolutional net.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "libskel/convnet/conv_net.h"
#include "libskel/core/rng.h"
#include "trainer/conv_net_backward.h"

namespace skel {

// He's initialisation (He et al. 2015); what is added to a skip starts small.
void initialise(ConvNet& net, Rng& rng);

struct ConvNetSchedule {
  int steps = 0, batch = 16;
  double peak_rate = 2e-3;  // after a short warm-up; falls as a cosine does
  double weight_decay = 1e-4;
  double averaging = .999;  // of the weights over steps
  int threads = 0;          // 0: one a core. The result does not depend on it.
};

class ConvNetTrainer {
 public:
  // What is to be learned from one image of a batch.
  struct Lesson {
    // Fills the net's input map.
    std::function<void(int image, std::vector<float>& input)> show;
    // The loss of the net's last map; adds its derivative, divided by the size of the batch, to `gradient`.
    std::function<double(int image, const std::vector<float>& output, std::vector<float>& gradient)> judge;
  };

  ConvNetTrainer(ConvNet first, const ConvNetSchedule& schedule);

  std::int64_t steps() const { return state_.step; }  // that have been made
  bool done() const { return state_.step >= schedule_.steps; }
  // One step; `lesson` is asked by several threads. Returns the batch's mean loss.
  double step(const Lesson& lesson);
  // The running mean of the parameters, which is the result.
  const std::vector<float>& averaged() const { return state_.average; }

  // Everything that a step changes. restore() throws InputError where it is none of this net's.
  std::string checkpoint() const;
  void restore(const std::string& bytes, const std::string& file);

 private:
  double rate() const;
  void adam();

  struct State {
    std::int64_t step = 0;
    std::vector<float> parameters, first_moment, second_moment, average;
  };
  ConvNet net_;
  ConvNetSchedule schedule_;
  InstructionSet set_;
  State state_;
  std::vector<ConvNetMaps> maps_;
  std::vector<ConvNetGradient> gradients_;
};

}  // namespace skel
