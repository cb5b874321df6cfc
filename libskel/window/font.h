// The letters of the windows.
#pragma once

struct ImFontAtlas;

namespace skel {

// A font of the system with the letters of Latin, Greek, Cyrillic, Armenian and Georgian, in which names are
// written. False: there is none, and Dear ImGui's own was taken, which has those of western Europe alone.
bool addFont(ImFontAtlas& fonts, float size_px);

}  // namespace skel
