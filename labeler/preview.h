// The rigged model, waving: what R shows.
#pragma once

#include "libskel/pipeline/rig_character.h"
#include "libskel/window/window.h"

namespace skel {

class Preview {
 public:
  // Fills the width that is there with the model as it moves. True while it moves; a click moves it again.
  bool draw(const RiggedDrawing& rigged, float width, float height);
  // From the start, also where it is the model that is there already.
  void play() { shown_ = nullptr; }

 private:
  const RiggedDrawing* shown_ = nullptr;
  double start_s_ = 0;
  bool resting_ = false;
  Texture texture_;
};

}  // namespace skel
