// The figure of the tests as a .glb with one clip of its own.
#pragma once

#include "libskel/core/files.h"
#include "tests/support/figure.h"
#include "tests/support/temp_dir.h"

namespace skel {

// Nods for a second: the head turns about x by so much and back.
inline Clip nodClip(float angle_rad = 0.6f) {
  const Eigen::Quaternionf down(Eigen::AngleAxisf(angle_rad, Eigen::Vector3f::UnitX()));
  Clip clip;
  clip.name = "nod";
  clip.tracks = {
      {"head", {0, 0.5f, 1}, {Eigen::Quaternionf::Identity(), down, Eigen::Quaternionf::Identity()}}};
  return clip;
}

inline std::string figureFile(const TempDir& dir, const std::string& name = "figure.glb") {
  writeFile(dir.file(name), encodeGlb(figure(), {nodClip()}));
  return dir.file(name);
}

}  // namespace skel
