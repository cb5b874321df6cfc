// Films of characters, as skel-animate render makes them.
#pragma once

#include <functional>
#include <vector>

#include "animator/render_options.h"

namespace skel {

// Writes what was asked for of one character, moved by these clips, which are relative to its rest pose.
// Files are named after the character. `drawing`: what it was made of; null: no drawing.
using RenderCharacter =
    std::function<void(CharacterFile, const RiggedDrawing* drawing, const std::vector<Clip>&)>;

// A film a clip. `options` outlive the result. Throws UsageError, OutputError, UnavailableError where films
// cannot be written so, before there is a character.
RenderCharacter filmRenderer(const RenderCommandOptions& options);

}  // namespace skel
