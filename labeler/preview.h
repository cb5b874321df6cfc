// The rigged model, waving: what R shows.
#pragma once

#include <memory>

#include "labeler/last_shown.h"
#include "libskel/window/window.h"

namespace skel {

class Preview {
 public:
  // Fills the width that is there with the model as it moves. True while it moves; a click moves it again.
  bool draw(const std::shared_ptr<const RiggedDrawing>& rigged, float width, float height);
  // From the start, also where it is the model that is there already.
  void play() { shown_.forget(); }

 private:
  LastShown shown_;
  double start_s_ = 0;
  bool resting_ = false;
  Texture texture_;
};

}  // namespace skel
