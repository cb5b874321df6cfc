// The whole pipeline for fuzzers: what must hold for any figure.
#pragma once

#include <algorithm>
#include <cmath>

#include "libskel/classifier/weights_file.h"
#include "libskel/export/write_character.h"
#include "libskel/import/read_character.h"
#include "libskel/pipeline/rig_character.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/mesh_checks.h"

namespace skel {

// Quick, to try more figures: the mesh is coarse, and the nets, which take most of the time, are asked about
// one input of 128.
inline RigOptions rigOptions(std::size_t size) {
  static const SkeletonTemplate biped = loadTemplate("biped");
  const bool nets = size % 128 == 0;
  RigOptions options;
  options.mlp = defaultMlp();
  options.body_plan = biped;
  options.recognizer = nets ? Recognizer::kTree : Recognizer::kPaper;
  options.layers = nets;
  options.inflate.spacing_px = 6;
  return options;
}

inline void requireSound(const RiggedDrawing& drawing) {
  if (!drawing.found()) {
    require(!drawing.silhouette.reason.empty(), "a figure that is not found has a reason");
    return;
  }
  const RiggedCharacter& character = drawing.character;
  require(character.mesh.vertices.allFinite(), "vertices are finite");
  for (const Joint& joint : character.skeleton.joints)
    require(joint.image.allFinite() && joint.position.allFinite(), "joints are finite: " + joint.name);
  const auto& weights = character.weights.weights;
  require(weights.rows() == character.mesh.vertices.rows() && weights.allFinite() &&
              weights.minCoeff() >= 0 && (weights.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-4f,
          "weights of a vertex are not negative and sum to 1");
  require(character.weights.joints.maxCoeff() < static_cast<int>(character.skeleton.joints.size()),
          "weights name joints");
  const CharacterFile again = decodeGlb(encodeGlb(character, drawing.clips, {.name = "fuzz"}), "fuzz.glb");
  require(again.character.skeleton.joints.size() == character.skeleton.joints.size() &&
              again.character.mesh.triangles.rows() == character.mesh.triangles.rows() &&
              again.character.weights.weights.rows() == again.character.mesh.vertices.rows() &&
              again.clips.size() == drawing.clips.size(),
          "what is written is read with the same joints, faces and clips");
}

}  // namespace skel
