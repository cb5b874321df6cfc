// One character's motion in the style of another: the content's activations with the style's basis.
//
// Patent CN102231209A: X̃ = U_B·V_A.
#pragma once

#include <string>
#include <vector>

#include "libskel/style/align_phases.h"
#include "libskel/style/sparse_coding.h"

namespace skel {

struct TransferOptions {
  SparseCodingOptions coding;
  double amount = 1;                        // 0: the content as it is; 1: the style; beyond: more of it
  std::function<void()> on_beginning = {};  // of a pair's phases; may be empty
};

// A motion of each of two characters that show the same action, as canonical poses (2J rows).
struct MotionPair {
  PoseMatrix content, style;
  bool content_loops = false, style_loops = false;
  std::string content_path = "the content", style_path = "the style";  // for complaints
  std::vector<int> keys = {};  // ascending frames of the content that are factored; empty: all
};

struct Transfer {
  std::vector<PoseMatrix> poses;           // of each pair, the content's frames in the style: canonical
  std::vector<PhaseAlignment> alignments;  // of each pair
  SparseCoding coding;                     // of [X_A; X_B], 4J rows; the keys of all pairs one after another
};

// For the components of two characters to mean the same, they are factored together: the style's poses at the
// phases of the content's stand below those, [X_A; X_B] = [U_A; U_B]·V. With more than one pair (actions that
// both show), all share one basis. What the factors cannot express is the content's own and stays:
// X̃ = X_A + amount · (U_B − U_A)·V. With more components than frames that are
// independent of each other, there are as many as those. Frames
// that are no keys come by inBetweens() (in_between.h). Throws UsageError: no pair, no frame, no component;
// InputError as alignPhases().
Transfer transferStyle(const std::vector<MotionPair>& pairs, const TransferOptions& options = {});

// The two factored each by itself, matched by what their components say of the actions (semantics.h):
// needs at least as many shared classes as components. `actions`: one a pair, all different.
Transfer transferBySignatures(const std::vector<MotionPair>& pairs, const std::vector<std::string>& actions,
                              const TransferOptions& options = {});

}  // namespace skel
