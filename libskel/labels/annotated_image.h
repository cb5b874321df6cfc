// Pictures with known joints: `image.png`, `mask.png` and `joints.json` in a folder of their own, or
// `<stem>.png`, `<stem>.mask.png` and `<stem>.joints.json` side by side.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "libskel/candidates/candidates.h"
#include "libskel/core/error.h"
#include "libskel/core/json.h"
#include "libskel/image/image.h"
#include "libskel/labels/label_file.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/template.h"

namespace skel {

struct AnnotatedImage {
  std::string image;                // path
  std::optional<std::string> mask;  // path; none: the figure is found in the image
  std::string joints;               // path
};

// The picture of any kind whose name without its ending that is: the first by the order of kDrawingEndings;
// one whose ending is in small letters counts before all others.
std::optional<std::string> pictureOfStem(const std::filesystem::path& stem);

// The picture that a joints file is for, of any kind, whether its ending is in small letters or capitals.
// Throws InputError if there is none.
std::string imageOfJointsFile(const std::string& joints_file);

// Is told why a drawing is left out.
using OnInputError = std::function<void(const InputError&)>;

// As noteSkeletonFiles() does for skeleton files. Throws OverwriteError.
void noteJointsFiles(const std::vector<std::string>& files);

// All below `dir`, at any depth, sorted by path. Throws InputError: no such folder, a folder that cannot be
// read, joints without an image. `on_error`, if given, is told of the latter, and the others are found.
std::vector<AnnotatedImage> findAnnotatedImages(const std::string& dir, const OnInputError& on_error = {});

// Joints by the names of the biped template; a file may also call `body` "torso" and `pelvis` "hip".
// Throws InputError that names file, JSON path and reason.
NamedJoints readJointsFile(const std::string& path);

// Throws InputError: a joint of `file` that is none of the plan's.
void ensureJointsOf(const SkeletonTemplate& body_plan, const NamedJoints& joints, const std::string& file);

// One of its places, px; null: none. Throws InputError where it lies in no picture.
std::optional<Eigen::Vector2d> jointPlaceAt(const JsonValue& place);

// Whether it lies on one of the picture's pixels.
inline bool isInPicture(const Eigen::Vector2d& place_px, const Image& image) {
  return place_px.minCoeff() >= -0.5 && place_px.x() <= image.width - 0.5 &&
         place_px.y() <= image.height - 0.5;
}

// The label file beside a picture, `<stem>.labels.json`, if a person has placed a joint in it: that is a
// later word than a joints file beside it. Throws InputError: it cannot be read.
std::optional<LabelFile> placedLabelsBeside(const std::string& image);

// Puts what a person has placed in `labels` into `joints`. Says which of those that are named there lay
// elsewhere.
std::vector<std::string> overrule(NamedJoints& joints, const LabelFile& labels);

// One line about label files that do so.
std::string overruledNote(const std::vector<std::string>& label_files);

// The joints file beside a picture, if there is one.
std::optional<std::string> jointsFileBeside(const std::string& image);

std::vector<std::string> jointNames(const NamedJoints& joints);

// What such a file says of the view: "front", "three-quarter" or "side"; "" if nothing. Throws InputError.
std::string readView(const std::string& joints_file);

// Which way its figure looks: 0 to the viewer, 45 half and 90 all the way to the right of the picture,
// negative to the left, beyond 90 seen from behind. Nothing where it does not say. Throws InputError.
std::optional<int> readFacing(const std::string& joints_file);

// Throws InputError also where its size is not that of the image.
Plane8 readMaskOf(const Image& image, const std::string& mask);

// The figure by its mask, or as found in the image. Throws InputError with the reason if there is none.
Silhouette silhouetteOf(const std::string& image, const std::optional<std::string>& mask);

// Labels that can be saved beside the image: its candidates, labelled from `joints`, or not at all if those
// are empty; those of them that are `recognized` label nothing (label_from_joints.h). Throws InputError.
LabelFile labelImage(const std::string& image, const std::optional<std::string>& mask,
                     const NamedJoints& joints, const SkeletonTemplate& body_plan,
                     const CandidateOptions& options = {}, const std::vector<std::string>& recognized = {});
// The same of its silhouetteOf().
LabelFile labelFigure(const Silhouette& silhouette, const std::string& image,
                      const std::optional<std::string>& mask, const NamedJoints& joints,
                      const SkeletonTemplate& body_plan, const CandidateOptions& options = {},
                      const std::vector<std::string>& recognized = {});

}  // namespace skel
