// Inside the room: OpenGL without a display.
#pragma once

#include "libskel/scene/mesh_painter.h"

namespace skel {

// Throws UnavailableError; also where OpenGL is software and a card is asked for.
std::unique_ptr<MeshPainter> glPainter(const TriangleMesh& mesh, bool on_card_only);

}  // namespace skel
