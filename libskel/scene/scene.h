// A character in a pose as it is seen: background, shadow, body, skeleton.
#pragma once

#include <vector>

#include "libskel/deform/skin_vertices.h"
#include "libskel/export/write_character.h"
#include "libskel/scene/mesh_painter.h"

namespace skel {

struct Look {
  bool solid = true;
  bool translucent = false;  // the body is seen through
  bool wireframe = false;
  bool skeleton = false;
  Blending blending = Blending::kLinear;  // of the skin
  bool shadow = true;                     // on the ground
  bool ink = true;                        // the line that is drawn around the figure
  int weights_of = -1;                    // a joint: its weights instead of the texture, blue to yellow
  int chosen = -1;                        // a joint that is drawn larger
  Color background = kWhite;              // kClear: none
  Image picture;                          // if not empty: over the background, covering all of it
};

// The look's background alone.
Image paintBackground(const Look& look, int width, int height);
// How wide the bones of a skeleton are in a picture of that height, px.
double boneWidth(int height_px);

// What stays the same from frame to frame: the ground, the painted background.
class Scene {
 public:
  // The character outlives the scene.
  Scene(const RiggedCharacter& character, std::unique_ptr<MeshPainter> painter);

  const RiggedCharacter& character() const { return character_; }
  // Whether several threads may paint at once.
  bool isConcurrent() const { return painter_->isConcurrent(); }
  Image paint(const JointTransforms& posed_from_rest, const Camera& camera, int width, int height,
              const Look& look) const;
  float groundY() const { return ground_y_; }

 private:
  const RiggedCharacter& character_;
  std::unique_ptr<MeshPainter> painter_;
  float ground_y_ = 0;
  double edge_m_ = 0;  // of the mesh's triangles, on the whole
};

// The colour of a weight in [0, 1].
Color weightColor(double weight);

}  // namespace skel
