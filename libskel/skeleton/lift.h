// Stage 7: the drawn skeleton inside the model.
#pragma once

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

// Sets each joint's position from its image point: x and y by mesh.model_from_image, z half way between the
// first and the last surface that a line of sight through the point meets; where it meets none, the z of the
// mesh's nearest vertex.
void liftToModel(Skeleton& skeleton, const TriangleMesh& mesh);

}  // namespace skel
