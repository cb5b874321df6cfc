// What follows from picture and mask: the figure, and the candidates that are labelled.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "labeler/drawing_state.h"
#include "libskel/candidates/candidates.h"
#include "libskel/classifier/mlp.h"
#include "libskel/silhouette/silhouette.h"

namespace skel {

struct Figure {
  Silhouette silhouette;
  CandidateSet candidates;
  std::vector<Eigen::Vector2d> centers_px;  // of the candidates, image px
  std::vector<JointClass> suggestions;      // by the weights
  std::vector<double> certainties;          // their probabilities
};

using CandidateLabels = std::vector<std::optional<JointClass>>;

// `mask`: null: the figure is found in the picture. `number`: which figure of the picture, or of the mask, if
// that holds so many: one that was painted for a figure holds that one alone.
std::shared_ptr<const Figure> figureOf(const Image& image, const MaskVersion* mask, int number,
                                       const Mlp& mlp);

// Labels of other candidates for this figure's: each takes over that of the nearest in whose disc it lies.
CandidateLabels carriedLabels(const Figure& figure, const Figure& old_figure,
                              const CandidateLabels& old_labels);
CandidateLabels carriedLabels(const Figure& figure, const std::vector<JointCandidate>& old_candidates,
                              const CandidateLabels& old_labels);
bool samePlaces(const std::vector<JointCandidate>& a, const std::vector<JointCandidate>& b);
int countLabels(const CandidateLabels& labels);

// The unlabelled candidate that the weights are least sure about; -1 if all are labelled.
int mostUnsure(const Figure& figure, const CandidateLabels& labels);
// The one whose centre is nearest to an image point, within `radius_px`; else, of the discs that hold the
// point, the kept one with the nearest centre; -1 if there is none.
int candidateAt(const Figure& figure, const Eigen::Vector2d& image_px, double radius_px);
std::vector<int> candidatesNear(const Figure& figure, const Eigen::Vector2d& image_px, double radius_px);
std::vector<int> candidatesInside(const Figure& figure, const Polygon& lasso);

// Of points in any unit, that nearest to `to` within `radius`; -1 if there is none.
int nearestPoint(const std::vector<std::optional<Eigen::Vector2d>>& points, const Eigen::Vector2d& to,
                 double radius);

}  // namespace skel
