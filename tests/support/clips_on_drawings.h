// Drawings with clips, and their meshes in a clip's poses.
#pragma once

#include <string>
#include <vector>

#include "libskel/animation/sample_pose.h"
#include "libskel/classifier/weights_file.h"
#include "libskel/deform/skin_vertices.h"
#include "libskel/image/read_image.h"
#include "libskel/pipeline/rig_character.h"

namespace skel {

// As skel-infer rigs it; found() says whether there is a figure.
inline RiggedDrawing rigWithClips(const std::string& path, const std::string& body_plan,
                                  const std::vector<Clip>& clips, bool layers = true) {
  RigOptions options;
  options.mlp = defaultMlp();
  options.body_plan = loadTemplate(body_plan);
  options.clips = clips;
  options.layers = layers;
  RigInput input;
  input.image = readImage(path);
  return rigCharacter(std::move(input), options);
}

inline float heightOf(const TriangleMesh& mesh) {
  return mesh.vertices.col(1).maxCoeff() - mesh.vertices.col(1).minCoeff();
}

inline Eigen::MatrixX3f posedVertices(const RiggedCharacter& character, const Clip& clip, float time_s) {
  const Pose pose = samplePose(clip, character.skeleton, time_s);
  return skinVertices(character.mesh.vertices, character.weights,
                      posedFromRest(character.skeleton, pose, heightOf(character.mesh)));
}

}  // namespace skel
