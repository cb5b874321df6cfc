#include <unistd.h>

#include <string>

#include "libskel/core/error.h"
#include "libskel/scene/mesh_painter.h"
#ifdef SKEL_EGL
#include "libskel/scene/gl_painter.h"
#endif

namespace skel {
namespace {

// Without one, OpenGL would be software, and starting it takes longer than many a film.
[[maybe_unused]] bool hasGraphicsCard() {
  for (int card = 128; card < 144; ++card)
    if (::access(("/dev/dri/renderD" + std::to_string(card)).c_str(), R_OK | W_OK) == 0) return true;
  return false;
}

}  // namespace

std::unique_ptr<MeshPainter> offscreenPainter([[maybe_unused]] const TriangleMesh& mesh) {
#ifdef SKEL_EGL
  return glPainter(mesh, false);
#else
  throw UnavailableError(
      "skel was built without EGL; install libegl-dev and build again, or use --painter software");
#endif
}

std::unique_ptr<MeshPainter> fastestPainter(const TriangleMesh& mesh) {
#ifdef SKEL_EGL
  if (hasGraphicsCard()) try {
      return glPainter(mesh, true);
    } catch (const UnavailableError&) {
    }
#endif
  return softwarePainter(mesh);
}

}  // namespace skel
