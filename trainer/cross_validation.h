// How good nets trained on such characters are on characters that they have not seen. Characters are split,
// never the samples of one, and those of one picture (byPicture()) stay together; `generated` are trained on
// each time and never judged (see train()).
#pragma once

#include <vector>

#include "trainer/evaluation.h"
#include "trainer/training.h"

namespace skel {

// Each character is left out once, in one of `folds` groups (as many as there are pictures: leave-one-out).
// 2 <= folds <= number of pictures.
Evaluation crossValidate(const Characters& characters, const Characters& generated, int folds,
                         const TrainingOptions& options, const TrainingProgress& progress);

// The paper's protocol: `draws` times, `drawn` random characters for training, the rest to measure. One
// evaluation a draw. 1 <= drawn < number of pictures.
std::vector<Evaluation> drawAndTest(const Characters& characters, const Characters& generated, int draws,
                                    int drawn, const TrainingOptions& options,
                                    const TrainingProgress& progress);

}  // namespace skel
