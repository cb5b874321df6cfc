#include "trainer/learning_options.h"

#include "libskel/cli/number.h"

namespace skel {

void bindLearningOptions(CLI::App& command, LearningOptions& options) {
  command.add_option("--hands", options.hands, "Whose drawings are whose: a JSON object of lists of names")
      ->type_name("FILE");
  command.add_option("--folds", options.folds, "Groups of hands for cross-validation; 0: none")
      ->capture_default_str()
      ->check(numberIn(0, 1000));
  command.add_option("--seed", options.seed, "Same drawings, nets, seed and options: same bytes")
      ->capture_default_str()
      ->check(numberIn(0, 2'000'000'000));
  command.add_option("--threads", options.threads, "0: one a core")
      ->capture_default_str()
      ->check(numberIn(0, 1024));
}

}  // namespace skel
