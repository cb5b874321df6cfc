// The command `skel-animate render WHAT --clip NAME|FILE -o FILM`.
#pragma once

#include <string>

#include "animator/load_character.h"
#include "libskel/core/error.h"

namespace CLI {
class App;
}

namespace skel {

struct RenderCommandOptions {
  CharacterSource source;
  std::string clip;
  ClipSource clips;
  std::string output;
  double frame_rate = 30;
  double duration_s = 0;
  std::string size = "512x512";
  double angle_deg = 0, pitch_deg = 5;
  std::string look = "solid";  // or flat: the drawing itself
  std::string background = "white";
  std::string frame = "clip";  // or clips: what the camera shows all of
  std::string painter = "auto";
  std::string blend = "linear";
  bool wireframe = false, translucent = false, skeleton = false, no_shadow = false;
  std::string weights_of;
};
void bindRenderOptions(CLI::App& app, RenderCommandOptions& options);
ExitCode runRender(const RenderCommandOptions& options);

}  // namespace skel
