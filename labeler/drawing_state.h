// What is known about a drawing that is being labelled, and what steps change.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/layers/layer_map.h"
#include "libskel/skeleton/joint_class.h"
#include "libskel/skeleton/motion_file.h"

namespace skel {

// A mask file as it is, or is to be, on the disk.
struct MaskVersion {
  Plane8 pixels;       // of the image's size
  std::string file;    // name, beside the image
  std::string png;     // its bytes; empty while a stroke is being drawn
  std::string sha256;  // of these
};

// Throws InputError: cannot be read, or has another size than the image.
std::shared_ptr<const MaskVersion> readMaskVersion(const std::string& path, const Image& image);
bool sameFile(const MaskVersion* a, const MaskVersion* b);
// The mask of a finished stroke, as a file.
std::shared_ptr<const MaskVersion> sealed(const MaskVersion& stroke);

// What steps change and undo brings back. Masks are shared and never change, so that copies are cheap.
struct DrawingState {
  // SHA-256 of the picture that the rest was made for: a photo that was taken again has the name of the one
  // before.
  std::string image_sha256;
  std::string body_plan;                           // of the joints, by its name
  std::shared_ptr<const MaskVersion> mask;         // null: the figure is found in the picture
  std::vector<std::optional<JointClass>> labels;   // one a candidate (CandidateSet::maxima)
  std::vector<std::optional<PlacedJoint>> joints;  // one a joint of the body plan
  std::shared_ptr<const LayerMap> layers;          // painted by hand; null: found in the picture

  bool operator==(const DrawingState&) const;
};

}  // namespace skel
