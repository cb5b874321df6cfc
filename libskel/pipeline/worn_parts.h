// What is worn and held is carried as what it is, not as the flesh behind it.
#pragma once

#include "libskel/layers/layer_map.h"
#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/template.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

// Of the parts that the layer map tells:
// - a skirt hangs from the pelvis and is pushed by both thighs, more towards its hem, each on its own side:
//   it swings, and never becomes two legs;
// - a cape, wing or tail goes with the trunk that it touches, not with the limbs before it; a tail that the
//   body plan has joints for is moved by those;
// - a thing held rides rigidly with what touches it most, a hand mostly;
// - skirts, capes, wings, tails and hair that hangs get a chain of two joints each (skeleton/hanging.h),
// which
//   moves them the more the farther they are from where they hang.
// `skeleton` is lifted into the mesh (m); `weights` are those of the flesh alone. Nothing changes where the
// map tells no parts.
void carryWornParts(const TriangleMesh& mesh, const SkeletonTemplate& body_plan, const LayerMap& layers,
                    Skeleton& skeleton, SkinWeights& weights);

}  // namespace skel
