// Shu & Yang (2018): x, y and D of the candidates, each min-max normalised over all maxima of this one image.
#pragma once

#include "libskel/candidates/candidates.h"
#include "libskel/classifier/mlp.h"

namespace skel {

// One row for each of candidates.maxima, each column in [0, 1]; a column without range is 0.5.
Features features(const CandidateSet& candidates);

}  // namespace skel
