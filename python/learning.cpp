#include <cmath>

#include "libskel/classifier/weights_file.h"
#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "libskel/labels/label_folder.h"
#include "python/interruptible.h"
#include "trainer/cross_validation.h"
#include "trainer/generated_characters.h"
#include "trainer/training.h"

namespace skel::python {
namespace {

using Whole = std::int64_t;  // what does not fit an int is told its range, too

struct Trained {
  WeightsFile net;
  Training training;
  std::optional<Evaluation> evaluation;
};

LabelledCharacter labelledCharacter(const std::string& name, const Features& features,
                                    const std::vector<double>& labels) {
  const std::string where = "character \"" + name + "\": ";
  if (Eigen::Index(labels.size()) != features.rows())
    throw UsageError(where + std::to_string(features.rows()) + " rows of features, " +
                     std::to_string(labels.size()) + " labels");
  if (!(features.array() >= 0 && features.array() <= 1).all())
    throw UsageError(where + "features must be from 0 to 1");
  LabelledCharacter character{name, features, {}};
  for (const double label : labels) {
    if (!(label >= 0 && label < kJointClassCount && label == std::floor(label)))
      throw UsageError(where + "labels must be 0 to 3, indices into skel.CLASSES");
    character.labels.push_back(static_cast<JointClass>(int(label)));
  }
  return character;
}

std::vector<int> numbersOf(const std::vector<JointClass>& labels) {
  std::vector<int> numbers;
  for (const JointClass label : labels) numbers.push_back(static_cast<int>(label));
  return numbers;
}

LabelledSet setOf(const py::object& characters) {
  const auto isList = [](const py::handle& object) {
    return py::isinstance<py::sequence>(object) && !py::isinstance<py::str>(object);
  };
  const std::string wanted = "characters: must be a list, of each character (name, features, labels)";
  if (!isList(characters)) throw UsageError(wanted);
  LabelledSet set;
  std::string bytes;
  for (const py::handle& item : characters) {
    if (!isList(item) || py::len(item) != 3) throw UsageError(wanted);
    const auto parts = py::reinterpret_borrow<py::sequence>(item);
    const py::object first = parts[0];
    if (!py::isinstance<py::str>(first)) throw UsageError(wanted);
    const auto name = first.cast<std::string>();
    const std::string where = "character \"" + name + "\": ";
    const Features features = rowsIn(parts[1], 3, where + "features");
    const std::vector<double> labels = numbersIn(parts[2], -1, where + "labels");
    set.characters.push_back(labelledCharacter(name, features, labels));
    bytes += name + '\0' +
             std::string(reinterpret_cast<const char*>(features.data()),
                         std::size_t(features.size()) * sizeof(float));
    for (const double label : labels) bytes += char(label);
  }
  if (set.characters.empty()) throw UsageError("a set needs at least one character");
  set.sha256 = sha256(bytes);
  return set;
}

// As skel-train would be told.
std::string spelled(const TrainingOptions& options, int folds, int generated) {
  const TrainingOptions preset;
  std::string text;
  const auto add = [&](const std::string& name, double value, double other) {
    char number[32];
    std::snprintf(number, sizeof number, "%g", value);
    if (value != other) text += (text.empty() ? "--" : " --") + name + " " + number;
  };
  add("epochs", options.epochs, preset.epochs);
  add("restarts", options.restarts, preset.restarts);
  add("validation", options.validation, preset.validation);
  add("patience", options.patience, preset.patience);
  add("folds", folds, 10);
  add("generated", generated, 1000);
  return text;
}

Trained train(const LabelledSet& set, Whole folds, Whole epochs, Whole restarts, double validation,
              Whole patience, Whole generated, Whole seed, Whole threads, const py::object& progress) {
  checkRange("epochs", double(epochs), 1, 1e6);
  checkRange("restarts", double(restarts), 1, 1000);
  checkRange("validation", validation, 0, 0.9);
  checkRange("patience", double(patience), 1, 1e6);
  checkRange("generated", double(generated), 0, 1e5);
  checkRange("seed", double(seed), 0, 2e9);
  checkRange("threads", double(threads), 0, 1024);
  ensureEveryClass("characters", set);
  if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0)
    throw UsageError("progress: must be callable, or None");
  const auto pictures = static_cast<int>(byPicture(pointersTo(set.characters)).size());
  if (folds != 0 && (folds < 2 || folds > pictures))
    throw UsageError("folds: must be 0, or from 2 to the " + std::to_string(pictures) + " " +
                     (pictures < static_cast<int>(set.characters.size()) ? "pictures" : "characters") +
                     " that there are");
  TrainingOptions options;
  options.epochs = int(epochs);
  options.restarts = int(restarts);
  options.validation = validation;
  options.patience = int(patience);
  options.seed = static_cast<decltype(options.seed)>(seed);
  options.threads = int(threads);

  Trained trained;
  interruptible(std::size_t(folds + 1) * std::size_t(epochs) * std::size_t(restarts), progress,
                [&](const Tick& tick, const Pause& pause) {
                  const Characters characters = pointersTo(set.characters);
                  const auto drawn = generateCharacters(int(generated), static_cast<std::uint64_t>(seed),
                                                        int(threads), {}, pause);
                  const Characters more = pointersTo(drawn);
                  trained.training = skel::train(characters, more, options, tick);
                  if (folds > 0)
                    trained.evaluation = crossValidate(characters, more, int(folds), options, tick);
                  const double accuracy = trained.evaluation
                                              ? trained.evaluation->accuracy()
                                              : evaluateOn(trained.training.mlp, characters).accuracy();
                  trained.net = {trained.training.mlp,
                                 {set.sha256, spelled(options, int(folds), int(generated)), options.seed,
                                  trained.training.epochs, set.sampleCount(),
                                  static_cast<int>(set.characters.size()), accuracy}};
                });
  return trained;
}

Eigen::MatrixXi confusionOf(const Evaluation& evaluation) {
  Eigen::MatrixXi matrix(kJointClassCount, kJointClassCount);
  for (int i = 0; i < kJointClassCount; ++i)
    for (int j = 0; j < kJointClassCount; ++j)
      matrix(i, j) = evaluation.confusion[std::size_t(i)][std::size_t(j)];
  return matrix;
}

}  // namespace

void bindLearning(py::module_& module) {
  module.attr("CLASSES") = py::make_tuple("head", "body", "hand", "leg");

  py::class_<WeightsFile>(module, "Net",
                          "The net that tells head, body, hand and leg candidates apart: 3-4-4-2, sigmoids.")
      .def_static(
          "load",
          [](const py::object& path) {
            const std::string file = pathOf(path, "path");
            return unlocked(file, [&] { return readWeights(file); });
          },
          py::arg("path"), "Reads a weights file.")
      .def_static("builtin", &defaultWeights, py::return_value_policy::copy,
                  "The one that skel brings along.")
      .def(
          "save",
          [](const WeightsFile& net, const py::object& path) {
            const std::string file = pathOf(path, "path");
            unlocked(file, [&] { writeFile(file, formatWeights(net)); });
          },
          py::arg("path"), "Writes a weights file, for the tools' --weights.")
      .def(
          "classify",
          [](const WeightsFile& net, const py::object& numbers) {
            const Features features = rowsIn(numbers, 3, "features");
            if (!features.allFinite()) throw UsageError("features: must be finite");
            return unlocked("features", [&] { return classify(net.mlp, features); });
          },
          py::arg("features"),
          "(N, 3), each from 0 to 1, to (N, 4) float32: probabilities of skel.CLASSES; rows sum to 1.")
      .def_property_readonly(
          "layers",
          [](const WeightsFile& net) {
            std::vector<std::pair<Eigen::MatrixXf, Eigen::VectorXf>> layers;
            for (const MlpLayer& layer : net.mlp.layers) layers.emplace_back(layer.weights, layer.biases);
            return layers;
          },
          "Of each layer, weights (outputs, inputs) and biases (outputs,).")
      .def_property_readonly(
          "sizes", [](const WeightsFile& net) { return net.mlp.sizes(); },
          "Units of each layer, inputs first.")
      .def_property_readonly(
          "accuracy", [](const WeightsFile& net) { return net.provenance.accuracy; },
          "0 to 1, on characters that were left out of training.");

  py::class_<LabelledCharacter>(module, "LabelledCharacter",
                                "The candidates of one drawing, with their classes.")
      .def_readonly("name", &LabelledCharacter::name)
      .def_property_readonly(
          "features", [](const LabelledCharacter& c) { return c.features; },
          "(N, 3) float32: x, y, radius, each from 0 to 1.")
      .def_property_readonly(
          "labels",
          [](const LabelledCharacter& c) {
            return py::array(py::cast(numbersOf(c.labels))).attr("astype")("int64");
          },
          "(N,) int64: indices into skel.CLASSES.");

  py::class_<LabelledSet>(module, "LabelledSet", "Labelled characters, to train and to measure on.")
      .def(py::init(&setOf), py::arg("characters"),
           "characters: of each a name, features (N, 3) from 0 to 1, and labels (N,), 0 to 3.")
      .def_static(
          "load",
          [](const py::object& folder) {
            const std::string path = pathOf(folder, "folder", "the path of a folder");
            return unlocked(path, [&] { return readLabelledSet(path); });
          },
          py::arg("folder"),
          "All label files below a folder. Raises InputError for whatever `skel-label check` finds.")
      .def_readonly("characters", &LabelledSet::characters)
      .def("__len__", [](const LabelledSet& set) { return set.characters.size(); });

  py::class_<Evaluation>(module, "Evaluation", "How well a net tells the classes apart.")
      .def_property_readonly("accuracy", &Evaluation::accuracy, "0 to 1.")
      .def_property_readonly("balanced_accuracy", &Evaluation::balancedAccuracy,
                             "0 to 1: the mean over the classes that candidates have.")
      .def_property_readonly("confusion", &confusionOf,
                             "(4, 4) int32: candidates by their class (row) and the net's (column).")
      .def_property_readonly(
          "characters",
          [](const Evaluation& e) {
            std::map<std::string, std::pair<int, int>> scores;
            for (const CharacterScore& score : e.characters)
              scores[score.name] = {score.right, score.samples};
            return scores;
          },
          "By name: right candidates, and all.")
      .def("__repr__", [](const Evaluation& e) {
        return "<skel.Evaluation: accuracy " + std::to_string(e.accuracy()) + ", " +
               std::to_string(e.characters.size()) + " characters>";
      });

  py::class_<Trained>(module, "Training", "A net, and how it was learned.")
      .def_readonly("net", &Trained::net)
      .def_property_readonly(
          "epochs", [](const Trained& t) { return t.training.epochs; },
          "That the net took: the one of the least loss is kept.")
      .def_property_readonly(
          "loss", [](const Trained& t) { return t.training.loss; }, "Mean squared error of the net.")
      .def_property_readonly(
          "losses", [](const Trained& t) { return t.training.training_curve; },
          "Mean squared error by epoch.")
      .def_property_readonly(
          "validation_losses", [](const Trained& t) { return t.training.validation_curve; },
          "The same on characters held out by `validation`; empty if none were.")
      .def_readonly("evaluation", &Trained::evaluation,
                    "By folds, on characters that were left out; None without folds.")
      .def("__repr__", [](const Trained& t) {
        return "<skel.Training: " + std::to_string(t.training.epochs) + " epochs, loss " +
               std::to_string(t.training.loss) + ">";
      });

  module.def("train", &train, py::arg("characters"), py::kw_only(), py::arg("folds") = 10,
             py::arg("epochs") = 400, py::arg("restarts") = 4, py::arg("validation") = 0.,
             py::arg("patience") = 100, py::arg("generated") = 1000, py::arg("seed") = 1,
             py::arg("threads") = 0, py::arg("progress") = py::none(),
             "Trains a net of 3-4-4-2 as skel-train does: same characters, options and seed, same net. "
             "Mirror images and bent "
             "copies of each character are learned from as well.\n\n"
             "folds: groups of characters for cross-validation, at least 2; 0: none. epochs: passes over the "
             "samples, 1 to 1e6. restarts: "
             "trainings from other first weights, 1 to 1000, of which the best is kept. validation: share of "
             "the characters held out to stop "
             "early, 0 to 0.9. patience: epochs without gain before that. generated: figures drawn by the "
             "program to train on as well, 0 to "
             "1e5. seed: 0 to 2e9. threads: 0: one a core; does not change the result. progress: called as "
             "progress(done, total, loss).");
  module.def(
      "evaluate",
      [](const WeightsFile& net, const LabelledSet& set) {
        return unlocked("characters", [&] { return evaluateOn(net.mlp, pointersTo(set.characters)); });
      },
      py::arg("net"), py::arg("characters"),
      "How well the net tells the classes of these characters' candidates apart.");
}

}  // namespace skel::python
