// How well a net tells the classes apart.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "libskel/classifier/weights_file.h"
#include "trainer/samples.h"

namespace skel {

struct CharacterScore {
  std::string name;
  int right = 0, samples = 0;
};

// Nets that were trained on so many random draws of so many characters each, on all others.
struct Draws {
  int count = 0, characters = 0;
  double accuracy = 0, deviation = 0;  // mean, standard deviation
};

struct Evaluation {
  // Samples by their true class (row) and the class of largest probability (column).
  std::array<std::array<int, kJointClassCount>, kJointClassCount> confusion{};
  std::vector<CharacterScore> characters;
  std::string measured_on;         // with respect to training; "": it is not told
  std::string set_sha256;          // of what it is measured on, see LabelledSet; "": it is not told
  std::optional<WeightsFile> net;  // that is measured; nothing of several
  std::optional<Draws> draws;

  int samples() const;
  double accuracy() const;
  // Mean over the classes that occur of the share of their samples that are recognised.
  double balancedAccuracy() const;
  void add(const Evaluation& other);
};

// `on_character` is called after each; may be empty.
Evaluation evaluateOn(const Mlp& mlp, const Characters& characters,
                      const std::function<void()>& on_character = {});

// Keys accuracy, measured_on, set_sha256 and net, where they are told, balanced_accuracy, samples, classes,
// confusion, characters, draws, where there were some.
std::string formatEvaluation(const Evaluation& evaluation);
// Accuracy and confusion matrix as lines for a terminal.
std::string describeEvaluation(const Evaluation& evaluation);

}  // namespace skel
