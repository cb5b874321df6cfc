// Stage 7: the drawn skeleton inside the model.
#pragma once

#include <vector>

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

// Sets each joint's position from its image point: x and y by mesh.model_from_image, z half way between the
// first and the last surface that a line of sight through the point meets; where it meets none, the z of the
// mesh's nearest vertex.
// Of a mesh in layers, each joint sees the surfaces of its own alone: `layers`, one number a joint, -1: all;
// empty: all see all.
void liftToModel(Skeleton& skeleton, const TriangleMesh& mesh, const std::vector<int>& layers = {});

}  // namespace skel
