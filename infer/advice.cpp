#include "infer/advice.h"

#include <algorithm>

#include "libskel/recognition/silhouette_confidence.h"

namespace skel {
namespace {

// "left_hand" → "left hand"
std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

// "the left hand, the left foot and the head"
std::string listed(const std::vector<std::string>& joints) {
  std::string text;
  for (std::size_t i = 0; i < joints.size(); ++i)
    text += (i == 0 ? "the " : i + 1 == joints.size() ? " and the " : ", the ") + spoken(joints[i]);
  return text;
}

}  // namespace

std::vector<std::string> adviceOn(const RiggedDrawing& drawing, const SkeletonFile& file, bool all_figures) {
  constexpr double kRecognized = .5;
  const Silhouette& silhouette = drawing.silhouette;
  std::vector<std::string> advice;
  if (silhouette.is_sheet)
    advice.push_back(
        "The sheet of paper was taken for the figure. Lay the drawing on something plain and darker, or cut "
        "the "
        "photo down to the sheet.");
  if (!silhouette.cut_sides.empty())
    advice.push_back("The figure is cut off at the " + silhouette.cut_sides +
                     ". Step back, so that hands and feet are in the picture.");
  else if (const auto doubt = silhouetteDoubt(silhouette, builtInSilhouetteConfidence()))
    advice.push_back("Not sure where the figure ends: " + *doubt + ". A mask can be mended (skel-label).");
  const auto& joints = file.skeleton.joints;
  const bool edited = std::any_of(joints.begin(), joints.end(),
                                  [](const Joint& joint) { return joint.origin == JointOrigin::kEdited; });
  if (drawing.recognition.likeness < kRecognized && !edited) {
    if (!advice.empty()) return advice;
    advice.push_back(
        "No whole figure could be made out. Go over thin lines with a felt pen, and take the photo by day, "
        "from "
        "straight above.");
  } else if (file.confidence < kRecognized && !edited) {
    advice.push_back("Some joints may be wrong" +
                     (file.missing.empty() ? std::string() : ", most likely " + listed(file.missing)) +
                     ". Look how the figure moves; skel-label mends joints, and a drawing with the limbs "
                     "apart is found better.");
  } else if (!file.missing.empty()) {
    advice.push_back("Not seen: " + listed(file.missing) +
                     ". A likely place was taken; look whether the figure moves as it should.");
  }
  if (silhouette.figure_count > 1 && !all_figures && file.figure.number == 1)
    advice.push_back("There are " + std::to_string(silhouette.figure_count) +
                     " figures in the picture; the largest was taken.");
  if (file.figure.turned_deg != 0)
    advice.push_back("The figure was taken to be turned by " + std::to_string(file.figure.turned_deg) +
                     " degrees.");
  return advice;
}

}  // namespace skel
