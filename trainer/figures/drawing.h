// A random figure before it becomes pixels, and what the generator knows of a body plan.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/core/rng.h"
#include "trainer/figures/scene.h"

namespace skel {

enum class FigureView { kFront, kThreeQuarter, kSide };

struct Drawing {
  Scene scene;
  bool whole = true;                    // one whole figure of the body plan; if not, the joints mean nothing
  std::vector<Eigen::Vector2d> joints;  // in the scene, as FigurePlan::joints
  FigureView view = FigureView::kFront;
  int kind = 0;             // family of proportions, see FigurePlan::kinds
  std::vector<int> absent;  // joints that this figure has none of
};

struct FigurePlan {
  std::string_view body_plan;  // name of the template
  struct Joint {
    std::string name;  // one that the template does not derive
    PartOwner owner;   // the part that it lies in
    bool end;          // a hand, a foot, a tail: a figure that has lost it is not whole
  };
  std::vector<Joint> joints;
  // Families of proportions, and how often each is drawn for training. One can be held back to measure on it.
  std::vector<double> kinds;
  Drawing (*draw)(Rng& rng, int kind);
  Scene (*drawOther)(Rng& rng);  // anything that is no figure of the body plan
};

std::vector<std::string> jointNames(const FigurePlan& plan);

// One of these kinds, each as likely; of none: of the plan's, as often as is useful for training.
int sampleKind(Rng& rng, const FigurePlan& plan, const std::vector<int>& kinds = {});

// Those that can be drawn.
std::span<const FigurePlan> figurePlans();
// The one of this template. Throws UsageError if there is none.
const FigurePlan& figurePlan(std::string_view body_plan);

}  // namespace skel
