#include "labeler/labeling_window.h"

namespace skel {

ExitCode runLabelingWindow(const std::string&, DocumentOptions) {
  throw UnavailableError(
      "was built without windows: install libimgui-dev, libglfw3-dev and libgl-dev, configure with "
      "SKEL_WINDOWS=ON and "
      "build again (the commands candidates, import, export, check, stats and motion need no window)");
}

}  // namespace skel
