// Films of characters, as skel-animate render makes them.
#pragma once

#include <functional>
#include <vector>

#include "animator/render_options.h"

namespace skel {

struct CharacterRenderer {
  // Writes what was asked for of one character, moved by these clips, which are relative to its rest pose.
  // Files are named after the character. `flat`: the drawing that it was made of, to be shown itself; null:
  // the model is shown.
  std::function<void(CharacterFile, const RiggedDrawing* flat, const std::vector<Clip>&)> render;
  // Where all characters have something in common, which must be known of each before the first is rendered;
  // else empty.
  std::function<void(const CharacterFile&, const std::vector<Clip>&)> measure = {};
};

// A film a clip. `options` outlive the result. Throws UsageError, OutputError, UnavailableError where films
// cannot be written so, before there is a character.
CharacterRenderer filmRenderer(const RenderCommandOptions& options);

}  // namespace skel
