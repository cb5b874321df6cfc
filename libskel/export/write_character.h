// Stage 9: files that other programs read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/facing.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

struct RiggedCharacter {
  TriangleMesh mesh;
  Skeleton skeleton;
  SkinWeights weights;
  std::optional<Facing> facing = {};  // in its rest pose; nothing: not known, see measureFigure()
};

// Names of the joints in exported files.
enum class JointNaming { kSkel, kVrm, kMixamo };

// The joints' own axes in a GLB; what moves is the same with all of them.
enum class BoneStyle {
  kAlong,  // +y along the bone (bone_axes.h), as Blender draws bones
  kEnds,   // so, too, and each last bone ends in a joint that moves nothing (bone_ends.h): it has a length
  kPlain,  // the model's, for code that turns joints
};

struct ExportOptions {
  std::string name = "character";  // of the mesh and of the scene
  JointNaming naming = JointNaming::kSkel;
  BoneStyle bones = BoneStyle::kAlong;
  std::string generator = "skel";  // who wrote it
  bool ink_hull = false;           // the line around the figure, if there is one, as triangles (ink_hull.h)
};

// glTF 2.0 binary: one skinned mesh with its texture, the joints, the clips as animations (already retargeted
// to the rest pose of `character`). Zero errors and warnings in the Khronos validator. Throws UsageError
// where `character` has no mesh (nothing was found) or its parts or the clips do not fit each other, and
// Error as checkCharacter() of check_character.h does.
std::string encodeGlb(const RiggedCharacter& character, const std::vector<Clip>& clips,
                      const ExportOptions& options = {});

}  // namespace skel
