#include "trainer/cross_validation.h"

#include "libskel/core/check.h"
#include "libskel/core/parallel.h"

namespace skel {
namespace {

std::vector<Characters> shuffled(std::vector<Characters> pictures, const TrainingOptions& options,
                                 std::uint64_t stream) {
  Rng rng(static_cast<std::uint64_t>(options.seed), stream);
  for (std::size_t i = pictures.size(); i > 1; --i)
    std::swap(pictures[i - 1], pictures[rng.below(static_cast<std::uint32_t>(i))]);
  return pictures;
}

void append(Characters& characters, const Characters& more) {
  characters.insert(characters.end(), more.begin(), more.end());
}

struct Split {
  Characters training, test;
};

// The splits run side by side, so that each of them trains on one thread.
std::vector<Evaluation> evaluateSplits(const std::vector<Split>& splits, const Characters& generated,
                                       const TrainingOptions& options, const TrainingProgress& progress) {
  TrainingOptions single = options;
  single.threads = 1;
  std::vector<Evaluation> evaluations(splits.size());
  parallelFor(splits.size(), options.threads, [&](std::size_t i) {
    evaluations[i] = evaluateOn(train(splits[i].training, generated, single, progress).mlp, splits[i].test);
  });
  return evaluations;
}

constexpr std::uint64_t kFoldStream = 1'000'000, kDrawStream = 2'000'000;

}  // namespace

Evaluation crossValidate(const Characters& characters, const Characters& generated, int folds,
                         const TrainingOptions& options, const TrainingProgress& progress) {
  const std::vector<Characters> order = shuffled(byPicture(characters), options, kFoldStream);
  SKEL_CHECK(folds >= 2 && static_cast<std::size_t>(folds) <= order.size());
  std::vector<Split> splits(static_cast<std::size_t>(folds));
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t f = 0; f < splits.size(); ++f)
      append(i % splits.size() == f ? splits[f].test : splits[f].training, order[i]);
  Evaluation all;
  for (const Evaluation& evaluation : evaluateSplits(splits, generated, options, progress))
    all.add(evaluation);
  return all;
}

std::vector<Evaluation> drawAndTest(const Characters& characters, const Characters& generated, int draws,
                                    int drawn, const TrainingOptions& options,
                                    const TrainingProgress& progress) {
  const std::vector<Characters> pictures = byPicture(characters);
  SKEL_CHECK(drawn >= 1 && static_cast<std::size_t>(drawn) < pictures.size());
  std::vector<Split> splits(static_cast<std::size_t>(draws));
  for (std::size_t d = 0; d < splits.size(); ++d)
    for (const Characters& picture : shuffled(pictures, options, kDrawStream + d)) {
      Split& split = splits[d];
      const bool enough = split.training.size() >= static_cast<std::size_t>(drawn);
      append(enough ? split.test : split.training, picture);
    }
  return evaluateSplits(splits, generated, options, progress);
}

}  // namespace skel
