#include "animator/animation_window.h"

namespace skel {

ExitCode runAnimationWindow(const CharacterSource&, const ClipSource&) {
  throw UnavailableError(
      "skel was built without windows; install what script/bootstrap --all does and build again, or use "
      "skel-animate render");
}

}  // namespace skel
