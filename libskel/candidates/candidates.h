// Stage 3: where joints may be.
//
// Shu & Yang (2018), Algorithm 1: distance of every inner pixel to the contour; pixels that are maximal among
// their 8 neighbours; sorted by distance; each that lies inside the disc of a larger one is dropped.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/silhouette/silhouette.h"

namespace skel {

struct JointCandidate {
  float x = 0, y = 0;  // grid px, a pixel's centre
  float radius = 0;    // grid px, exact Euclidean distance to the nearest pixel outside the figure
};

using DistanceField = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct CandidateSet {
  DistanceField distance;              // grid H×W; 0 outside, >= 1 inside
  std::vector<JointCandidate> maxima;  // largest radius first; equal radii by row, then column
  std::vector<int> kept;               // indices into maxima that survive disc pruning, ascending
};

enum class CandidateMethod {
  kMaxima,  // D >= all 8 neighbours
  kStrict,  // D > all 8 neighbours, as the paper prints it
  kDiscs,   // centres of all maximal discs: with pruning, every pixel is within 2·radius of a kept centre
};

struct CandidateOptions {
  CandidateMethod method = CandidateMethod::kMaxima;
};

// Exact Euclidean distance of each figure pixel (mask > 0) to the nearest pixel outside; the outside of the
// array counts as outside the figure.
DistanceField distanceField(const Plane8& mask);

CandidateSet extractCandidates(const Silhouette& silhouette, const CandidateOptions& options = {});

// Algorithm 1's last step: walks down `maxima` (sorted) and drops each that lies inside the disc of a kept
// one.
std::vector<int> pruneByDiscs(const std::vector<JointCandidate>& maxima);

// Share of the figure's pixels that lie in no disc of a kept candidate grown by `factor` (1: the discs
// themselves).
double uncoveredShare(const CandidateSet& candidates, double factor = 1);

}  // namespace skel
