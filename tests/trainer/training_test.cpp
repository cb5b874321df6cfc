#include "trainer/training.h"

#include "libskel/classifier/weights_file.h"
#include "tests/support/benchmark_samples.h"
#include "tests/support/catch.h"
#include "trainer/cross_validation.h"

using namespace skel;

namespace {

// The benchmark's samples, dealt to characters.
std::vector<LabelledCharacter> characters(int count) {
  const Samples samples = benchmarkSamples();
  std::vector<LabelledCharacter> all;
  const Eigen::Index each = samples.count() / count;
  for (int c = 0; c < count; ++c) {
    LabelledCharacter& character = all.emplace_back();
    character.name = "character " + std::to_string(c);
    character.features = samples.inputs.middleRows(c * each, each);
    for (Eigen::Index i = 0; i < each; ++i) {
      const auto target = samples.targets.row(c * each + i);
      character.labels.push_back(
          static_cast<JointClass>(2 * std::lround(target[0]) + std::lround(target[1])));
    }
  }
  return all;
}

std::string bytes(const Training& training) { return formatWeights({training.mlp, {}}); }

TrainingOptions quick() {
  TrainingOptions options;
  options.epochs = 120;
  options.restarts = 3;
  return options;
}

}  // namespace

TEST_CASE("training gives the same bytes with any number of threads, and others for another seed") {
  const auto all = characters(12);
  TrainingOptions options = quick();
  options.threads = 1;
  const std::string one = bytes(train(pointersTo(all), {}, options, {}));
  options.threads = 4;
  CHECK(bytes(train(pointersTo(all), {}, options, {})) == one);
  options.seed = 2;
  CHECK(bytes(train(pointersTo(all), {}, options, {})) != one);
}

TEST_CASE("training stops early on held-out characters and keeps the best weights") {
  const auto all = characters(10);
  TrainingOptions options = quick();
  options.epochs = 2000;
  options.validation = 0.2;
  options.patience = 20;
  const Training training = train(pointersTo(all), {}, options, {});
  REQUIRE_FALSE(training.validation_curve.empty());
  CHECK(training.validation_curve.size() < 2000);
  CHECK(static_cast<float>(training.loss) ==
        *std::min_element(training.validation_curve.begin(), training.validation_curve.end()));
  CHECK(training.validation_curve[static_cast<std::size_t>(training.epochs)] ==
        static_cast<float>(training.loss));
  options.validation = 0;
  CHECK(train(pointersTo(all), {}, options, {}).validation_curve.empty());
}

TEST_CASE("generated characters are trained on in every fold, and never judged") {
  const auto all = characters(6);
  auto wrong = all;  // more of them than of the others in each fold
  for (LabelledCharacter& character : wrong)
    for (JointClass& label : character.labels)
      label = static_cast<JointClass>((static_cast<int>(label) + 1) % 4);
  TrainingOptions options = quick();
  options.samples.mirror = false;
  options.samples.warps = 0;
  const Evaluation evaluation = crossValidate(pointersTo(all), pointersTo(wrong), 3, options, {});
  CHECK(evaluation.characters.size() == 6);
  CHECK(evaluation.accuracy() < 0.5);
}

TEST_CASE("scaling the inputs does not change what they mean") {
  // The same answers for numbers of another size, since the net learns on mean 0 and deviation 1.
  auto all = characters(6), far = all;
  for (LabelledCharacter& character : far)
    character.features = (character.features.array() / 16 + 2).matrix();
  TrainingOptions options = quick();
  options.samples.mirror = false;
  options.samples.warps = 0;
  CHECK(evaluateOn(train(pointersTo(far), {}, options, {}).mlp, pointersTo(far)).accuracy() ==
        Approx(evaluateOn(train(pointersTo(all), {}, options, {}).mlp, pointersTo(all)).accuracy())
            .margin(0.01));
}

TEST_CASE("one character alone can be trained on") {
  const auto all = characters(1);
  CHECK(evaluateOn(train(pointersTo(all), {}, quick(), {}).mlp, pointersTo(all)).accuracy() > 0.9);
}

TEST_CASE("mirror images, bent copies and class weights make the samples they should") {
  std::vector<LabelledCharacter> all(1);
  all[0].features.resize(3, 3);
  all[0].features << 0, 0, 1, 0.25, 0.5, 0, 1, 1, 0.5;
  all[0].labels = {JointClass::kHead, JointClass::kLeg, JointClass::kLeg};
  SampleOptions options;
  options.balance_classes = true;
  options.warps = 0;
  const Samples samples = samplesOf(pointersTo(all), options);
  REQUIRE(samples.count() == 6);
  CHECK(samples.inputs.row(4) == Eigen::RowVector3f(0.75, 0.5, 0));
  CHECK(samples.targets.row(4) == Eigen::RowVector2f(1, 1));
  CHECK(samples.weights[0] == Approx(3. / 4));
  CHECK(samples.weights[1] == Approx(3. / 8));

  options.mirror = false;
  options.warps = 5;
  options.warp = 0.7;
  const Samples bent = samplesOf(pointersTo(all), options);
  REQUIRE(bent.count() == 18);
  CHECK(bent.inputs.topRows(3) == all[0].features);
  for (int copy = 1; copy <= 5; ++copy) {
    const auto rows = bent.inputs.middleRows(3 * copy, 3);
    // Ends and order stay.
    CHECK(rows(0, 0) == 0);
    CHECK(rows(2, 1) == 1);
    CHECK(rows(1, 1) > 0);
    CHECK(rows(1, 1) < 1);
    CHECK(rows(1, 1) != 0.5f);
  }
}

TEST_CASE("cross-validation leaves each character out once") {
  const auto all = characters(7);
  for (const int folds : {2, 7}) {
    const Evaluation evaluation = crossValidate(pointersTo(all), {}, folds, quick(), {});
    CHECK(evaluation.characters.size() == 7);
    CHECK(evaluation.accuracy() > 0.93);
    CHECK(evaluation.balancedAccuracy() > 0.93);
    int sum = 0;
    for (const auto& row : evaluation.confusion)
      for (const int cell : row) sum += cell;
    CHECK(sum == evaluation.samples());
  }
  const auto draws = drawAndTest(pointersTo(all), {}, 3, 5, quick(), {});
  REQUIRE(draws.size() == 3);
  for (const Evaluation& draw : draws) CHECK(draw.characters.size() == 2);
}

TEST_CASE("a character that is unlike the others is judged by nets that have not seen it") {
  auto all = characters(6);
  for (JointClass& label : all[2].labels) label = static_cast<JointClass>((static_cast<int>(label) + 1) % 4);
  for (const CharacterScore& score : crossValidate(pointersTo(all), {}, 6, quick(), {}).characters)
    CHECK((score.right < score.samples / 2) == (score.name == "character 2"));
}

TEST_CASE("balanced accuracy counts each class the same") {
  Evaluation evaluation;
  evaluation.confusion[0] = {90, 10, 0, 0};
  evaluation.confusion[2] = {0, 0, 1, 1};
  CHECK(evaluation.balancedAccuracy() == Approx((0.9 + 0.5) / 2));
  CHECK(Evaluation().accuracy() == 0);
  CHECK(Evaluation().balancedAccuracy() == 0);
}

TEST_CASE("characters of one picture lay in two folds and on both sides of a draw") {
  auto all = characters(4);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].image_sha256 = i % 2 == 0 ? "even" : "odd";
  const Characters even = {&all[0], &all[2]}, odd = {&all[1], &all[3]};
  TrainingOptions options = quick();
  options.epochs = 20;
  options.restarts = 1;
  Evaluation apart = evaluateOn(train(even, {}, options, {}).mlp, odd);
  apart.add(evaluateOn(train(odd, {}, options, {}).mlp, even));
  CHECK(crossValidate(pointersTo(all), {}, 2, options, {}).confusion == apart.confusion);
  for (const Evaluation& draw : drawAndTest(pointersTo(all), {}, 5, 1, options, {})) {
    REQUIRE(draw.characters.size() == 2);
    const bool is_even = draw.characters[0].name == all[0].name;
    CHECK(draw.characters[1].name == all[is_even ? 2 : 3].name);
  }
}
