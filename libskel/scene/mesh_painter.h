// Pictures of one mesh in many poses, for films and windows. (For a single picture: draw/render_mesh.h.)
#pragma once

#include <memory>
#include <string>

#include "libskel/draw/color.h"
#include "libskel/draw/render_mesh.h"
#include "libskel/image/image.h"
#include "libskel/mesh/triangle_mesh.h"

namespace skel {

// How the mesh is painted; fill and wires may go together.
struct Surface {
  bool fill = true;
  float opacity = 1;  // of the fill: what is nearest shows whatever lies behind the whole mesh
  bool wires = false;
  Color wire_color = kInk;
  float wire_px = 0.8f;
  Eigen::Vector3f plain_rgb = {205, 205, 210};  // 0…255, where the mesh has no texture
  float shading = 0.45f;                        // 0: the colours as they are; 1: black in the shade
  bool ink = true;  // the drawn line around the mesh: only around an opaque fill without `colors`
  // #V×3, 0…255, instead of texture and plain colour; else null.
  const Eigen::MatrixX3f* colors = nullptr;

  bool hasInk() const { return ink && fill && opacity == 1 && colors == nullptr; }
};

class MeshPainter {
 public:
  virtual ~MeshPainter() = default;
  // `vertices`: as many as the mesh has. The background is clear, edges are smooth.
  virtual Image paint(const Eigen::MatrixX3f& vertices, const Camera& camera, int width, int height,
                      const Surface& surface) = 0;
  // Whether several threads may paint at once.
  virtual bool isConcurrent() const = 0;
};

// All in software, the same bytes on every machine. Keeps what it needs of the mesh.
std::unique_ptr<MeshPainter> softwarePainter(const TriangleMesh& mesh);

// With OpenGL 3.3 in a context of its own, which needs no display (EGL, surfaceless). Used by the thread that
// made it. Throws UnavailableError: no EGL, no such context, a build without it.
std::unique_ptr<MeshPainter> offscreenPainter(const TriangleMesh& mesh);

// The fastest there is: OpenGL on a graphics card, else software, which is faster than OpenGL in software.
std::unique_ptr<MeshPainter> fastestPainter(const TriangleMesh& mesh);

}  // namespace skel
