// Who performs: a drawing, or a rigged character as it is seen from the front.
#pragma once

#include <string>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/layers/layer_map.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skeleton/template.h"

namespace skel {

struct Performer {
  Image image;
  Silhouette silhouette;       // of the image, found
  SkeletonTemplate body_plan;  // the biped's
  Skeleton skeleton;           // its joints, with places in the image and in the model
  LayerMap layers;
  ModelFromImage model_from_image;
  std::vector<std::string> notes;  // a clause each, for the user
};

// Of a drawing, what a person has mended.
struct MendedSource {
  std::string results = {};  // a folder that skel-infer has written to; "": none
  bool force = false;        // leave it out
};

// A drawing, which is rigged first as skel-infer does (libskel/mended/mend_places.h), the .skeleton.json of
// one, or a .glb with the biped's joints. Throws InputError, also for a figure that fits another body plan:
// films show people's motions.
Performer readPerformer(const std::string& path, const MendedSource& mended = {});

}  // namespace skel
