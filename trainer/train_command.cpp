#include "trainer/train_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

#include "libskel/classifier/weights_file.h"
#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/files.h"
#include "libskel/core/progress.h"
#include "libskel/core/text.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/coco_of_others.h"
#include "libskel/labels/twins.h"
#include "trainer/cross_validation.h"
#include "trainer/evaluation.h"
#include "trainer/generated_characters.h"
#include "trainer/report.h"
#include "trainer/writable_output.h"

namespace skel {
namespace {

const std::map<std::string, CandidateMethod> kCandidateMethods = {{"maxima", CandidateMethod::kMaxima},
                                                                  {"strict", CandidateMethod::kStrict},
                                                                  {"discs", CandidateMethod::kDiscs}};
const std::map<std::string, TrainingMethod> kMethods = {{"gradient", TrainingMethod::kGradient},
                                                        {"rprop", TrainingMethod::kRprop},
                                                        {"lbfgs", TrainingMethod::kLbfgs}};

std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string trim(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

template <class Value>
CLI::Option* addChoice(CLI::App& app, const std::string& name, Value& value,
                       const std::map<std::string, Value>& choices, const std::string& help) {
  std::string list, preset;
  for (const auto& [text, choice] : choices) {
    list += (list.empty() ? "" : "|") + text;
    if (choice == value) preset = text;
  }
  return app.add_option(name, value, help)
      ->transform(CLI::CheckedTransformer(choices).description(""))
      ->type_name(list)
      ->default_str(preset);
}

std::vector<int> parseLayers(const std::string& text) {
  std::vector<int> sizes;
  for (const std::string& part : CLI::detail::split(text, '-')) {
    const bool number = !part.empty() && part.size() <= 3 &&
                        part.find_first_not_of("0123456789") == std::string::npos && std::stoi(part) > 0;
    if (!number) throw UsageError("--layers \"" + text + "\": must be sizes such as 3-4-4-2, each 1 to 999");
    sizes.push_back(std::stoi(part));
  }
  if (sizes.size() < 2 || sizes.size() > 16 || sizes.front() != 3 || sizes.back() != 2)
    throw UsageError("--layers \"" + text +
                     "\": must begin with 3 (x, y, radius), end with 2 (the bits of the class)");
  return sizes;
}

void sayLeftOut(const LabelledSet& set) {
  for (const std::string& note : set.leftOut())
    std::fprintf(stderr, "skel-train: note: %s\n", printable(note).c_str());
}

LabelledSet readSet(const std::string& dir, CandidateMethod method) {
  LabelledSet set =
      method == CandidateMethod::kMaxima ? readLabelledSet(dir) : labelAnnotatedImages(dir, {method});
  sayLeftOut(set);
  return set;
}

// The options that decide over the weights, or over what their accuracy is measured on, and are not at their
// defaults, as on the command line.
std::string spell(const TrainOptions& options) {
  const TrainOptions preset;
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : " ") + part; };
  const TrainingOptions &ours = options.training, &theirs = preset.training;
  if (options.layers != preset.layers) add("--layers " + options.layers);
  if (ours.method != theirs.method)
    add(std::string("--method ") + kTrainingMethodNames[static_cast<std::size_t>(ours.method)]);
  if (ours.optimizer.learning_rate != theirs.optimizer.learning_rate)
    add("--learning-rate " + trim(ours.optimizer.learning_rate));
  if (ours.optimizer.momentum != theirs.optimizer.momentum)
    add("--momentum " + trim(ours.optimizer.momentum));
  if (ours.optimizer.batch != theirs.optimizer.batch) add("--batch " + std::to_string(ours.optimizer.batch));
  if (ours.optimizer.weight_decay != theirs.optimizer.weight_decay)
    add("--weight-decay " + trim(ours.optimizer.weight_decay));
  if (ours.epochs != theirs.epochs) add("--epochs " + std::to_string(ours.epochs));
  if (ours.restarts != theirs.restarts) add("--restarts " + std::to_string(ours.restarts));
  if (ours.validation != theirs.validation) add("--validation " + trim(ours.validation));
  if (ours.patience != theirs.patience) add("--patience " + std::to_string(ours.patience));
  if (options.class_weights != preset.class_weights) add("--class-weights " + options.class_weights);
  if (options.no_mirror) add("--no-mirror");
  if (ours.samples.warps != theirs.samples.warps) add("--warps " + std::to_string(ours.samples.warps));
  if (ours.samples.warp != theirs.samples.warp) add("--warp " + trim(ours.samples.warp));
  if (options.leave_one_out)
    add("--leave-one-out");
  else if (options.folds != preset.folds)
    add("--folds " + std::to_string(options.folds));
  if (options.generated != preset.generated) add("--generated " + std::to_string(options.generated));
  if (options.candidates == CandidateMethod::kStrict) add("--candidates strict");
  if (options.candidates == CandidateMethod::kDiscs) add("--candidates discs");
  return text;
}

// Runs `work` with a progress bar over the passes of `trainings` trainings, restarts included.
template <class Work>
auto withProgress(const std::string& title, std::size_t trainings, const TrainingOptions& options,
                  Work work) {
  const auto passes = static_cast<std::size_t>(options.epochs) * static_cast<std::size_t>(options.restarts);
  ProgressBar bar(title, trainings * passes);
  return work([&bar](double loss) { bar.advance(1, "loss " + trim(loss)); });
}

Draws summaryOf(const std::vector<Evaluation>& draws, int drawn) {
  double mean = 0, square = 0;
  for (const Evaluation& draw : draws) {
    mean += draw.accuracy() / static_cast<double>(draws.size());
    square += draw.accuracy() * draw.accuracy() / static_cast<double>(draws.size());
  }
  return {static_cast<int>(draws.size()), drawn, mean, std::sqrt(std::max(0., square - mean * mean))};
}

// `pictures`: how many the characters have.
void checkCounts(const TrainOptions& options, std::size_t characters, std::size_t pictures) {
  const std::string count = pictures == characters
                                ? counted(characters, "character")
                                : counted(pictures, "picture") + " of " + counted(characters, "character");
  const auto needed = static_cast<std::size_t>(options.leave_one_out ? 2 : options.folds);
  if (needed > pictures)
    throw UsageError(
        (options.leave_one_out ? "--leave-one-out" : "--folds " + std::to_string(options.folds)) + ": " +
        (pictures == 1 ? "there is only " : "there are only ") + count + "; take " +
        (pictures > 1 ? "fewer folds, or " : "") + "--folds 0");
  if (options.draws > 0 && static_cast<std::size_t>(options.drawn) >= pictures)
    throw UsageError("--drawn " + std::to_string(options.drawn) + ": must be less than the " + count +
                     " that there are");
}

// Where people and animals lie in one folder, somebody may have meant one of them.
void noteAnimals(const LabelledSet& set) {
  std::vector<std::string> animals;
  for (const LabelledCharacter& character : set.characters)
    if (character.body_plan == "quadruped") animals.push_back(character.name);
  if (!animals.empty() && animals.size() < set.characters.size())
    std::fprintf(
        stderr,
        "skel-train: note: %zu of %zu characters have joints of a quadruped (%s): one net learns the "
        "classes of all\n",
        animals.size(), set.characters.size(), firstFew(animals).c_str());
}

void noteUnlabelled(const std::string& dir) {
  const auto has = [](const std::string& image) {
    return std::filesystem::is_regular_file(labelFileFor(image));
  };
  if (const std::string without = picturesWithout("labels", dir, has); !without.empty())
    std::fprintf(stderr, "skel-train: note: %s: not learned from\n", without.c_str());
}

void noteTwins(const LabelledSet& set) {
  std::vector<std::string> names, pictures;
  for (const LabelledCharacter& character : set.characters) {
    names.push_back(character.name);
    pictures.push_back(character.image_sha256);
  }
  if (const std::string twins = twinsSaid("characters", names, pictures); !twins.empty())
    std::fprintf(stderr, "skel-train: note: %s: they are left out together\n", twins.c_str());
}

}  // namespace

void bindTrainOptions(CLI::App& app, TrainOptions& options) {
  TrainingOptions& training = options.training;
  app.add_option("dir", options.dir, "Folder of label files (*.labels.json), searched at any depth")
      ->type_name("DIR");
  app.add_option("-o,--output", options.output, "The weights file to write")
      ->type_name("FILE")
      ->check(outputFile("skel-weights"));
  app.add_option("--layers", options.layers, "Sizes of the layers")->capture_default_str();
  addChoice(app, "--method", training.method, kMethods, "How the net is trained");
  app.add_option("--batch", training.optimizer.batch, "gradient: samples a step; 0: all of them; 1: online")
      ->check(numberIn(0, 1'000'000))
      ->capture_default_str();
  app.add_option("--learning-rate", training.optimizer.learning_rate, "gradient: 0: to suit the batch")
      ->check(numberIn(0., 100.))
      ->capture_default_str();
  app.add_option("--momentum", training.optimizer.momentum, "gradient: share of a step kept for the next")
      ->check(numberIn(0., 0.999))
      ->capture_default_str();
  app.add_option("--weight-decay", training.optimizer.weight_decay,
                 "Adds this times the weights' squares to the loss")
      ->check(numberIn(0., 1.))
      ->capture_default_str();
  app.add_option("--epochs", training.epochs, "Passes over the samples, at most")
      ->check(numberIn(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--restarts", training.restarts, "Trainings from other first weights; the best is kept")
      ->check(numberIn(1, 1000))
      ->capture_default_str();
  app.add_option("--validation", training.validation,
                 "Share of the characters held out to stop early; 0: none")
      ->check(numberIn(0., 0.9))
      ->capture_default_str();
  app.add_option("--patience", training.patience,
                 "Epochs without gain on the held-out characters before stopping")
      ->check(numberIn(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--class-weights", options.class_weights, "balanced: each class counts the same in sum")
      ->check(CLI::IsMember({"none", "balanced"}))
      ->capture_default_str();
  app.add_flag("--no-mirror", options.no_mirror, "Do not train on the mirror images as well");
  app.add_option("--warps", training.samples.warps,
                 "Also train on so many copies of each character with other proportions")
      ->check(numberIn(0, 100))
      ->capture_default_str();
  app.add_option("--warp", training.samples.warp, "How far proportions are bent")
      ->check(numberIn(0., 0.7))
      ->capture_default_str();
  app.add_option("--generated", options.generated,
                 "Also train on so many figures that the program draws itself (skel-train figures)")
      ->check(numberIn(0, 100'000))
      ->capture_default_str();
  addChoice(app, "--candidates", options.candidates, kCandidateMethods,
            "strict, discs: not those of the label files, but found anew and labelled by joints (of label "
            "files, *.joints.json)");
  app.add_option("--seed", training.seed, "Same data, seed and options: same bytes")
      ->check(numberIn(0, 2'000'000'000))
      ->capture_default_str();
  app.add_option("--threads", training.threads, "0: one a core")
      ->check(numberIn(0, 1024))
      ->capture_default_str();
  CLI::Option* folds =
      app.add_option("--folds", options.folds, "Groups of characters for cross-validation; 0: none")
          ->check(numberIn(0, 1'000'000))
          ->capture_default_str();
  app.add_flag("--leave-one-out", options.leave_one_out, "As many folds as there are pictures")
      ->excludes(folds);
  app.add_option("--draws", options.draws, "Also train on so many random draws of --drawn characters")
      ->check(numberIn(0, 10'000))
      ->capture_default_str();
  app.add_option("--drawn", options.drawn, "Characters of a draw (the paper: 17)")
      ->check(numberIn(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--json", options.json, "Writes accuracy and confusion of the cross-validation")
      ->type_name("FILE")
      ->check(outputFile());
  app.add_option("--report", options.report, "Writes loss curve and confusion matrix, as pictures and JSON")
      ->type_name("DIR");
}

ExitCode runTrain(const TrainOptions& given) {
  if (given.dir.empty() || given.output.empty())
    throw UsageError("a folder of label files and -o FILE are needed; see --help");
  TrainOptions options = given;
  TrainingOptions& training = options.training;
  training.layers = parseLayers(options.layers);
  training.samples.mirror = !options.no_mirror;
  training.samples.balance_classes = options.class_weights == "balanced";
  if (options.folds == 1) throw UsageError("--folds 1: must be 0 or at least 2");

  const LabelledSet set = readSet(options.dir, options.candidates);
  ensureEveryClass(options.dir, set);
  const Characters characters = pointersTo(set.characters);
  const std::size_t pictures = byPicture(characters).size();
  checkCounts(options, characters.size(), pictures);
  ensureWritableFile(options.output);
  if (!options.json.empty()) ensureWritableFile(options.json);
  keepCocoOfOthers(options.json, "name another file by --json");
  if (!options.report.empty()) ensureWritableFolder(options.report);
  if (options.candidates == CandidateMethod::kMaxima) noteUnlabelled(options.dir);
  noteAnimals(set);
  const int folds = options.leave_one_out ? static_cast<int>(pictures) : options.folds;
  if (folds > 1 || options.draws > 0 || training.validation > 0) noteTwins(set);
  const std::vector<LabelledCharacter> drawn_by_program = generateCharacters(
      options.generated, static_cast<std::uint64_t>(training.seed), training.threads, {options.candidates});
  const Characters generated = pointersTo(drawn_by_program);

  const Training result = withProgress("training", 1, training, [&](const TrainingProgress& progress) {
    return train(characters, generated, training, progress);
  });
  Evaluation evaluation;
  if (folds > 1) {
    evaluation = withProgress("cross-validation", static_cast<std::size_t>(folds), training,
                              [&](const TrainingProgress& progress) {
                                return crossValidate(characters, generated, folds, training, progress);
                              });
    evaluation.measured_on = "characters left out of training";
    std::printf("on characters left out of training (%d folds):\n", folds);
  } else {
    evaluation = evaluateOn(result.mlp, characters);
    evaluation.measured_on = "the training set itself";
    std::printf("on the training set itself:\n");
  }
  std::printf("%s", describeEvaluation(evaluation).c_str());
  if (options.draws > 0) {
    evaluation.draws = summaryOf(withProgress("draws", static_cast<std::size_t>(options.draws), training,
                                              [&](const TrainingProgress& progress) {
                                                return drawAndTest(characters, generated, options.draws,
                                                                   options.drawn, training, progress);
                                              }),
                                 options.drawn);
    std::printf("%d draws of %d characters: accuracy %.3f +- %.3f on the others\n", evaluation.draws->count,
                evaluation.draws->characters, evaluation.draws->accuracy, evaluation.draws->deviation);
  }

  WeightsFile weights;
  weights.mlp = result.mlp;
  weights.provenance = {set.sha256,           spell(options),    training.seed,
                        result.epochs,        set.sampleCount(), static_cast<int>(characters.size()),
                        evaluation.accuracy()};
  writeFile(options.output, formatWeights(weights));
  evaluation.set_sha256 = set.sha256;
  evaluation.net = std::move(weights);
  if (!options.json.empty()) writeFile(options.json, formatEvaluation(evaluation));
  if (!options.report.empty()) writeReport(options.report, result, evaluation);
  std::printf("wrote %s (of the least loss: after %d of %zu epochs)\n", printable(options.output).c_str(),
              result.epochs, result.training_curve.size());
  return ExitCode::kDone;
}

void bindEvaluateWeightsOptions(CLI::App& app, EvaluateWeightsOptions& options) {
  app.add_option("dir", options.dir, "Folder of label files, and of pictures with joints.json and mask.png")
      ->required()
      ->type_name("DIR");
  app.add_option("--weights", options.weights, "Weights file; without: those built in")->type_name("FILE");
  app.add_option("--json", options.json, "Writes the figures")->type_name("FILE")->check(outputFile());
  addChoice(app, "--candidates", options.candidates, kCandidateMethods,
            "strict, discs: found anew in the pictures");
}

ExitCode runEvaluateWeights(const EvaluateWeightsOptions& options) {
  keepCocoOfOthers(options.json, "name another file by --json");
  ExitCode code = ExitCode::kDone;
  const OnInputError leave_out = [&code](const InputError& error) {
    std::fprintf(stderr, "skel-train: %s\n", error.what());
    code = error.exitCode();
  };
  const LabelledSet set = options.candidates == CandidateMethod::kMaxima
                              ? readMeasuredSet(options.dir, leave_out)
                              : labelAnnotatedImages(options.dir, {options.candidates}, leave_out);
  sayLeftOut(set);
  WeightsFile net = options.weights.empty() ? defaultWeights() : readWeights(options.weights);
  Evaluation evaluation;
  {
    ProgressBar bar("evaluation", set.characters.size());
    evaluation = evaluateOn(net.mlp, pointersTo(set.characters), [&] { bar.advance(); });
  }
  evaluation.set_sha256 = set.sha256;
  evaluation.net = std::move(net);
  std::printf("%s", describeEvaluation(evaluation).c_str());
  if (!options.json.empty()) writeFile(options.json, formatEvaluation(evaluation));
  return code;
}

}  // namespace skel
