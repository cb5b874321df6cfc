// What the stages of one drawing have made, and of what they have made it: a stage whose inputs are those of
// the last time need not run again. For RigDocument.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/animation/figure_shape.h"
#include "libskel/mesh/front_view.h"
#include "libskel/pipeline/rig_character.h"

namespace skel {

// A number that each change gets for itself; 0: not there, and never was.
using Change = std::uint64_t;

// What a drawing is rigged from, as far as stages tell it apart: of RigInput, then of RigOptions.
enum class RigPart {
  kImage,
  kMask,
  kModel,
  kBack,
  kLayers,
  kSkeleton,  // with `turned_deg` and the joints that were placed
  kSilhouetteOptions,
  kCandidateOptions,
  kRecognitionOptions,  // all that tells where joints are
  kLayerOptions,
  kMeshOptions,
  kSkinOptions,
  kRestPose,
  kRetargetOptions,
  kClips,
  kCount,
};

class RigChanges {
 public:
  Change of(RigPart part) const { return changes_[static_cast<std::size_t>(part)]; }
  void note(RigPart part) { changes_[static_cast<std::size_t>(part)] = ++last_; }

 private:
  std::array<Change, static_cast<std::size_t>(RigPart::kCount)> changes_{};
  Change last_ = 0;
};

// What a stage has made.
template <class T>
struct Made {
  std::vector<Change> of;  // all that it was made of; empty: nothing was made
  Change change = 0;       // of `value`
  T value{};

  bool isOf(const std::vector<Change>& changes) const { return !of.empty() && of == changes; }
  void take(T made, const std::vector<Change>& changes) {
    value = std::move(made);
    of = changes;
    ++change;
  }
};

// Joints in the picture, and the body plan that they are of.
struct FoundJoints {
  Recognition recognition;
  SkeletonTemplate body_plan;
};

// Weights that clips do not stretch far.
struct BoundSkin {
  SkinWeights weights;
  FigureShape shape;                  // as it was before weights went a longer way
  std::vector<Clip> own, own_fitted;  // clips that come with skel, and as the figure does them
};

// The model's flesh on its bones.
struct Skinned {
  Eigen::MatrixX3f vertices;  // of the mesh, limbs put beside one another
  Skeleton skeleton;
  SkinWeights weights;
};

struct RigMemory {
  RigChanges changes;
  Made<FrontView> front_view;
  Made<Silhouette> silhouette;
  Made<Image> even_light;
  Made<CandidateSet> candidates;
  Made<FoundJoints> recognized;
  Made<LayerMap> layers;  // found, not given
  Made<std::vector<FigurePiece>> pieces;
  Made<TriangleMesh> mesh;
  Made<Skinned> skinned;  // in the pose in which it is drawn
  Made<BoundSkin> bound;
};

// rigCharacter() that makes only what is not in the memory, where `memory` is one. Its changes are those of
// `input` and `options`; RiggedDrawing::times has the stages that ran. Goes as far as `last`, not
// options.last. Of a draft layers and mesh are those in the memory, which is of one that went to the end, and
// skin may be stretched; it leaves nothing there.
RiggedDrawing rigCharacter(RigInput input, const RigOptions& options, RigMemory* memory, LastStage last,
                           bool draft);

}  // namespace skel
