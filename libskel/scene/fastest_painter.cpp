#include "libskel/core/error.h"
#include "libskel/scene/mesh_painter.h"

namespace skel {

std::unique_ptr<MeshPainter> offscreenPainter(const TriangleMesh&) { throw UnavailableError("not yet"); }

std::unique_ptr<MeshPainter> fastestPainter(const TriangleMesh& mesh) { return softwarePainter(mesh); }

}  // namespace skel
