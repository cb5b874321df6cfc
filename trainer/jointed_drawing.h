// Drawings whose joints somebody has placed, whichever file says so.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/labels/label_file.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/template.h"

namespace skel {

struct JointedDrawing {
  std::string image;                // path
  std::optional<std::string> mask;  // path; none: the figure is found in the image
  std::string joints_file;          // where the joints stand
  NamedJoints joints;
  bool side_view = false;
  std::optional<int> facing_deg = {};  // which way the figure looks, see readFacing()
};

// All below `dir`, at any depth, sorted by the image's path: annotated ones (see findAnnotatedImages), and
// label files and skeleton files in which a person has placed a joint. Of several files that speak of
// one image the first of these kinds counts, but what a person has placed in a label file counts before a
// joints or skeleton file beside it; where the two differ, a line says so. Throws InputError if there are
// none, one cannot be read, or a picture or mask has changed since its label file or skeleton file was
// written.
std::vector<JointedDrawing> findJointedDrawings(const std::string& dir);
// Of several folders, one after the other.
std::vector<JointedDrawing> findJointedDrawings(const std::vector<std::string>& dirs);
// The same for a net of `body_plan`. Throws InputError, too, where some have the joints of another one.
std::vector<JointedDrawing> findJointedDrawings(const std::vector<std::string>& dirs,
                                                const SkeletonTemplate& body_plan);

// What stands in their pictures, masks and joints, not what they are called: "3 drawings (sha256 0123…)";
// "none".
std::string contentOf(const std::vector<JointedDrawing>& drawings);

// By the drawing's mask, or as found in the image. Throws InputError with the reason if there is none.
Silhouette silhouetteOf(const Image& image, const JointedDrawing& drawing);

}  // namespace skel
