// What `skel-animate render` can be asked for.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "animator/load_character.h"
#include "libskel/cli/named_numbers.h"
#include "libskel/scene/mesh_painter.h"

namespace CLI {
class App;
}

namespace skel {

// Among the names of clips: all that the character can do.
inline constexpr std::string_view kAllClips = "all";

// Of digits alone.
inline bool isCount(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

struct SheetOptions {
  std::string output;  // empty: films instead
  int directions = 1;
  int most_frames = 0;  // a clip; 0: as many as the rate gives
  bool trim = false;
  bool same_scale = false;      // all characters of the run
  std::string like;             // the .json of a sheet whose cell and scale are taken; or ""
  std::string atlas = "array";  // hash, aseprite
  bool pixels = false, outline = false;
  std::string palette;  // how many colours, or a picture that has them; "": as many as there are
};

struct RenderCommandOptions {
  std::vector<std::string> files;
  CharacterSource source;  // of each of them, but for its path
  std::vector<std::string> clips;
  ClipSource library;
  std::string output;
  bool together = false;  // one film of all
  bool names = false;     // below the characters of such a film
  std::string format;     // of films in a folder; empty: the first of filmFormats()
  SheetOptions sheet;
  std::optional<double> frame_rate;  // 30 of films, 12 of sheets
  double duration_s = 0;
  std::string size;     // empty: 512x512 of films, 64x64 of sheets
  NamedNumbers angles;  // from where characters are seen, about the vertical, degrees
  double pitch_deg = 5;
  std::string look = "auto";  // solid: the model; flat: the drawing itself; auto: looksBetterFlat()
  std::string background = "white";
  std::string frame = "auto";  // clip or clips: what the camera shows all of
  std::string painter = "auto";
  std::string blend = "linear";
  bool wireframe = false, translucent = false, skeleton = false, no_shadow = false, no_ink = false;
  std::string weights_of;
};
void bindRenderOptions(CLI::App& app, RenderCommandOptions& options);

bool manyClips(const RenderCommandOptions& options);

// Whether something is asked for that the flat look does not have. `turned`: not seen from where it was
// drawn.
bool needsModel(const RenderCommandOptions& options, bool turned);

// For --format, the default first.
std::vector<std::string> filmFormats();

struct PictureSize {
  int width = 0, height = 0;  // px
};
// Of --size. Throws UsageError.
PictureSize sizeOf(const RenderCommandOptions& options, PictureSize otherwise);

// Of --painter.
std::unique_ptr<MeshPainter> painterFor(const RenderCommandOptions& options, const TriangleMesh& mesh);

}  // namespace skel
