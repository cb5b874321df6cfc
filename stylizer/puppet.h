// A drawing's figure as a cut-out that is dragged by its joints.
#pragma once

#include <string>
#include <vector>

#include "libskel/deform/arap.h"
#include "libskel/image/image.h"
#include "libskel/style/poses.h"
#include "stylizer/performer.h"

namespace skel {

// What can lie over each other, back to front: an arm before the body, a far leg behind the near one.
inline const std::vector<std::string> kPuppetParts = {"left_leg", "right_leg", "body",
                                                      "head",     "left_arm",  "right_arm"};

struct PuppetOptions {
  std::vector<std::string> order = kPuppetParts;  // each once
  int vertices = 1500;                            // about
};

struct Puppet {
  Eigen::MatrixX2d vertices;   // #V×2, image px of the drawing, at rest
  Eigen::MatrixX3i triangles;  // back to front
  std::vector<int> parts;      // of each triangle, an index into kPuppetParts
  Image texture;
  Eigen::MatrixX2d texture_places;  // #V×2, px of the texture
  PoseMatrix rest;                  // 2J×1, the drawing's joints in the order of the template, image px
  ArapMesh mesh;                    // its handles are the joints
};

// Throws UsageError: an order that does not name each part once.
Puppet makePuppet(const Performer& performer, const SkeletonTemplate& body_plan,
                  const PuppetOptions& options = {});

// #V×2, for joints at `pose` (2J).
Eigen::MatrixX2d posedVertices(const Puppet& puppet, const Eigen::VectorXd& pose);

}  // namespace skel
