// A drawing as a puppet: rigged by the pipeline itself, so that it can be drawn again in other poses.
#pragma once

#include <string>
#include <vector>

#include "libskel/export/write_character.h"
#include "libskel/skeleton/template.h"
#include "trainer/figures/figure.h"
#include "trainer/jointed_drawing.h"

namespace skel {

struct PosableDrawing {
  RiggedCharacter character;
  std::vector<int> joints;         // in the character's skeleton, of each joint of the net
  std::vector<double> deviations;  // rad, of each joint of the skeleton: by how much it is turned
  std::vector<int> limbs;  // of each joint of the skeleton: 1 + its limb in the template, 0: the trunk
  FigureView view = FigureView::kFront;
  std::vector<bool> unknown = {};  // of each joint of the net: completed from the others, not to be learned
};

// Of the joints called `names` those that nobody could place (null) are completed from the others. Throws
// InputError: a drawing whose file does not speak of one of them, files that cannot be read.
std::vector<PosableDrawing> posableDrawings(const std::vector<JointedDrawing>& drawings,
                                            const std::vector<std::string>& names,
                                            const SkeletonTemplate& body_plan, int threads);

// As it was drawn.
SmallDrawing asDrawn(const PosableDrawing& drawing);
// With its limbs turned at random, arms before the body or behind it.
SmallDrawing posed(Rng& rng, const PosableDrawing& drawing);
// The same, with some of its arms and legs exchanged for those of another drawing, posed at random too: as
// many kinds of limbs on as many kinds of bodies. Limbs that lie before or behind the trunk stay where they
// are.
SmallDrawing withLimbsOf(Rng& rng, const PosableDrawing& drawing, const PosableDrawing& donor);

}  // namespace skel
