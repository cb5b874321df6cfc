#include "trainer/evaluation.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>

#include "libskel/core/json_names.h"
#include "libskel/core/sha256.h"
#include "libskel/core/text.h"

namespace skel {
namespace {

template <class... Numbers>
std::string line(const char* format, Numbers... numbers) {
  char text[160];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

int sumOf(const std::array<int, kJointClassCount>& row) { return std::accumulate(row.begin(), row.end(), 0); }

double share(int part, int whole) { return whole > 0 ? static_cast<double>(part) / whole : 0; }

}  // namespace

int Evaluation::samples() const {
  int count = 0;
  for (const CharacterScore& character : characters) count += character.samples;
  return count;
}

double Evaluation::accuracy() const {
  int right = 0;
  for (const CharacterScore& character : characters) right += character.right;
  return share(right, samples());
}

double Evaluation::balancedAccuracy() const {
  double sum = 0;
  int classes = 0;
  for (std::size_t c = 0; c < confusion.size(); ++c) {
    const int count = sumOf(confusion[c]);
    if (count == 0) continue;
    sum += share(confusion[c][c], count);
    ++classes;
  }
  return classes > 0 ? sum / classes : 0;
}

void Evaluation::add(const Evaluation& other) {
  for (std::size_t c = 0; c < confusion.size(); ++c)
    for (std::size_t k = 0; k < confusion.size(); ++k) confusion[c][k] += other.confusion[c][k];
  characters.insert(characters.end(), other.characters.begin(), other.characters.end());
}

Evaluation evaluateOn(const Mlp& mlp, const Characters& characters,
                      const std::function<void()>& on_character) {
  Evaluation evaluation;
  for (const LabelledCharacter* character : characters) {
    const ClassProbabilities classes = classify(mlp, character->features);
    CharacterScore& score = evaluation.characters.emplace_back();
    score.name = character->name;
    for (std::size_t i = 0; i < character->labels.size(); ++i) {
      Eigen::Index found;
      classes.row(static_cast<Eigen::Index>(i)).maxCoeff(&found);
      const auto truth = static_cast<std::size_t>(character->labels[i]);
      ++evaluation.confusion[truth][static_cast<std::size_t>(found)];
      score.right += static_cast<std::size_t>(found) == truth;
      ++score.samples;
    }
    if (on_character) on_character();
  }
  return evaluation;
}

std::string formatEvaluation(const Evaluation& evaluation) {
  nlohmann::ordered_json json;
  json["accuracy"] = evaluation.accuracy();
  if (!evaluation.measured_on.empty()) json["measured_on"] = evaluation.measured_on;
  if (!evaluation.set_sha256.empty()) json["set_sha256"] = evaluation.set_sha256;
  if (evaluation.net) {
    const WeightsProvenance& made = evaluation.net->provenance;
    json["net"] = {{"weights_sha256", sha256(formatWeights(*evaluation.net))},
                   {"trained_on_sha256", made.data_sha256},
                   {"options", made.options},
                   {"seed", made.seed}};
  }
  json["balanced_accuracy"] = evaluation.balancedAccuracy();
  json["samples"] = evaluation.samples();
  json["classes"] = kJointClassNames;
  json["confusion"] = evaluation.confusion;
  json["characters"] = nlohmann::ordered_json::array();
  for (const CharacterScore& character : evaluation.characters)
    json["characters"].push_back({{"name", jsonFromFileName(character.name)},
                                  {"samples", character.samples},
                                  {"accuracy", share(character.right, character.samples)}});
  if (const std::optional<Draws>& draws = evaluation.draws)
    json["draws"] = {{"count", draws->count},
                     {"characters", draws->characters},
                     {"accuracy", draws->accuracy},
                     {"deviation", draws->deviation}};
  return json.dump(2) + "\n";
}

std::string describeEvaluation(const Evaluation& evaluation) {
  std::string text = line("accuracy %.3f, balanced %.3f (%d candidates of %d characters)\n",
                          evaluation.accuracy(), evaluation.balancedAccuracy(), evaluation.samples(),
                          static_cast<int>(evaluation.characters.size()));
  text += "is \\ found as";
  for (const char* name : kJointClassNames) text += line("%8s", name);
  text += "\n";
  for (std::size_t c = 0; c < kJointClassNames.size(); ++c) {
    text += line("%-13s", kJointClassNames[c]);
    for (const int cell : evaluation.confusion[c]) text += line("%8d", cell);
    text += "\n";
  }
  std::vector<std::string> absent;
  for (std::size_t c = 0; c < kJointClassNames.size(); ++c)
    if (sumOf(evaluation.confusion[c]) == 0) absent.emplace_back(kJointClassNames[c]);
  if (!absent.empty())
    text += "no candidate is of class " + joined(absent) + ": not in the balanced accuracy\n";
  return text;
}

}  // namespace skel
