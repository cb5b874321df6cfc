// The elk of datasets/elk: a model with parts, and bones with heads and tails, z up.
#pragma once

#include "libskel/mesh/read_mesh.h"
#include "libskel/skeleton/place_in_mesh.h"
#include "libskel/skeleton/rig_file.h"

namespace skel {

inline const TriangleMesh& elkMesh() {
  static const TriangleMesh mesh = readMesh(SKEL_SOURCE_DIR "/datasets/elk/elk.obj");
  return mesh;
}

inline const Skeleton& elkSkeleton() {
  static const Skeleton skeleton = yUpFromZUp(readRigFile(SKEL_SOURCE_DIR "/datasets/elk/elk.rig.json"));
  return skeleton;
}

}  // namespace skel
