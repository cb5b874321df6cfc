// Looking round a character: the camera of the window.
#pragma once

#include "libskel/draw/render_mesh.h"

namespace skel {

// Turns by so much of a circle a picture height of movement.
void orbit(Camera& camera, double across_px, double down_px, int height_px);
// What was under the mouse stays under it.
void pan(Camera& camera, double across_px, double down_px, int height_px);
// Above 1: nearer. Towards the point of the picture that is so far from its middle.
void zoom(Camera& camera, double factor, double across_px, double down_px, int height_px);

}  // namespace skel
