// Films of characters, as skel-animate render makes them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "animator/render_options.h"

namespace skel {

// A character and what it is to do: clips relative to its rest pose.
struct Performer {
  CharacterFile file;
  std::optional<RiggedDrawing> flat;  // that it was made of, to be shown itself; else the model is shown
  std::vector<Clip> clips;
};

struct CharacterRenderer {
  // Writes what was asked for of one character. Files are named after it. Returns whether a clip tears it.
  std::function<bool(Performer)> render;
  // Where all characters have something in common, which must be known of each before the first is rendered;
  // else empty.
  std::function<void(const Performer&)> measure = {};
  // Where all are in one film, which is written when each has been given to `render`; else empty.
  std::function<void()> finish = {};
};

// A film a clip, or one of all characters. `options` outlive the result. Throws UsageError, OutputError,
// UnavailableError where films cannot be written so, before there is a character.
CharacterRenderer filmRenderer(const RenderCommandOptions& options);

}  // namespace skel
