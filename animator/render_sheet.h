// Sprite sheets, as skel-animate render makes them.
#pragma once

#include "animator/render_films.h"

namespace skel {

// A sheet of all clips. As filmRenderer().
CharacterRenderer sheetRenderer(const RenderCommandOptions& options);

}  // namespace skel
