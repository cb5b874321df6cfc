// Who performs: a drawing, or a rigged character as it is seen from the front.
#pragma once

#include <string>

#include "libskel/image/image.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

struct Performer {
  Image image;
  Silhouette silhouette;  // of the image, found
  Skeleton skeleton;      // a biped's, in image px
};

// A drawing, which is rigged first, the .skeleton.json of one, or a .glb with the biped's joints. Throws
// InputError.
Performer readPerformer(const std::string& path);

}  // namespace skel
