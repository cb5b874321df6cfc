// The rules of Y. Shu, X. Yang, "A fast skeleton extraction algorithm for 3D cartoon characters" (2018).
#pragma once

#include <array>
#include <vector>

#include "libskel/candidates/candidates.h"
#include "libskel/classifier/mlp.h"
#include "libskel/recognition/recognition.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/template.h"

namespace skel {

// Candidates that touch one another.
struct CandidateLine {
  std::vector<int> members;                               // indices into CandidateSet::maxima, ascending
  std::array<double, kJointClassCount> class_share = {};  // (2): P_i = C_i / C_total
  double mean_radius = 0;                                 // grid px
};

// (1): two candidates belong to one line when they are at most reach · (D1 + D2) apart. `classes` has a row
// for each of candidates.maxima. Lines with most members first.
std::vector<CandidateLine> candidateLines(const CandidateSet& candidates, const std::vector<int>& members,
                                          const ClassProbabilities& classes, double reach);

// Lines (1), class shares (2), head and body (Algorithm 2), limbs (3), completion from the template's preset,
// separation of joints that coincide. `silhouette` must be found; joints come in image px and lie on the
// figure.
Recognition recognizeByRules(const Silhouette& silhouette, const CandidateSet& candidates,
                             const ClassProbabilities& classes, const SkeletonTemplate& body_plan);

}  // namespace skel
