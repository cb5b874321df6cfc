// Colours that run around a body: what the back of head and trunk wears is told from its two rims.
#pragma once

#include <optional>
#include <vector>

#include "libskel/mesh/seen_behind.h"

namespace skel {

inline constexpr int kUnpainted = -1, kInkPaint = -2;

// Paints `side`, which is seen from behind where seen.back says so: each row from rim to rim with the colours
// of `areas` that lie at its ends, rows of like ends joined. kUnpainted: no rim tells. `paint`: of each px.
void ruleBack(const DrawnAreas& areas, const SeenBehind& seen, const UprightRows& rows, Side side,
              const std::optional<HeadDisc>& head, std::vector<int>& paint);

}  // namespace skel
