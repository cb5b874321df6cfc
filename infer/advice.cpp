#include "infer/advice.h"

#include <algorithm>
#include <string_view>

#include "libskel/pipeline/drawing_notes.h"
#include "libskel/recognition/joint_note.h"

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

// A clause as a sentence.
std::string sentence(std::string clause) {
  if (!clause.empty() && clause[0] >= 'a' && clause[0] <= 'z') clause[0] = char(clause[0] - 'a' + 'A');
  return clause + ".";
}

// One of the warnings. What nobody has other words for stays as it is.
std::string inOtherWords(const std::string& warning, const RiggedDrawing& drawing, const SkeletonFile& file,
                         bool plan_is_chosen) {
  constexpr std::size_t kMostNamed = 5;        // joints: whoever reads of more learns nothing
  const bool first = file.figure.number == 1;  // of the picture: others have no labels of their own
  const bool photo = drawing.silhouette.evidence.has_value();  // or another page that is not tidy
  const auto starts = [&](const char* words) { return warning.starts_with(words); };
  if (starts("the sheet itself"))
    return "The sheet of paper, or what is drawn around the figure, was taken for it. Erase that from the "
           "mask: skel-label FILE, key M; of a photo: lay the drawing on something plain and darker, or cut "
           "it down to the sheet.";
  if (starts("the figure is cut by"))
    return "The figure is cut off at the " + drawing.silhouette.cut_sides +
           ". Step back, so that hands and feet are in the picture.";
  if (starts("this hardly looks like"))
    return "No whole figure could be made out" +
           (file.missing.empty() || file.missing.size() > kMostNamed
                ? ""
                : "; not seen: " + listed(file.missing)) +
           (plan_is_chosen && first && drawing.body_plan.name == "quadruped"
                ? ". It was taken for an animal on four legs; if it is none, choose Person (skel-label "
                  "FILE), and mend there what else is wrong. "
                : ". skel-label FILE mends what is wrong. ") +
           (photo ? "If the photo is dim or blurred, take it again: by day, from straight above, without "
                    "shadows; go over lines that are thin or faint with a felt pen."
                  : "Head, body, arms and legs are told best where they are apart.");
  if (starts("some joints may be wrong"))
    return "Some joints may be wrong" +
           (file.missing.empty() ? "" : ", most likely " + listed(file.missing)) +
           ". Look how the figure moves; skel-label FILE mends joints, and the mask (key M) if a part of the "
           "figure is missing or something is stuck to it. " +
           (photo ? "If a shadow lies across the figure, take the photo without it; limbs that are apart are "
                    "found better."
                  : "Limbs that are apart are found better.");
  if (starts("may be wrong"))
    return "Not sure of " + listed(unsureJoints(drawing.recognition)) +
           (file.missing.empty() ? "" : "; not seen: " + listed(file.missing)) +
           ". Look how the figure moves; skel-label FILE mends joints.";
  if (starts("not found: "))
    return "Not seen: " + listed(file.missing) +
           ". A likely place was taken; look whether the figure moves as it should.";
  if (starts("the picture shows "))
    return "There are " + std::to_string(drawing.silhouette.figure_count) +
           " figures in the picture; the largest was taken (skel-infer takes the next one with --figure 2, "
           "and each with --figure all).";
  if (starts("the figure is turned by "))
    return "The figure was taken to be turned by " + std::to_string(file.figure.turned_deg) + " degrees.";
  if (starts("what its lines enclose"))
    return sentence(warning.substr(0, warning.find(':'))) +
           " If it is, erase it from the mask: skel-label FILE, key M.";
  if (warning.ends_with(kLookAtMask) && !starts("the mask was there"))
    return "Not sure where the figure ends: " + warning.substr(0, warning.size() - kLookAtMask.size()) +
           (photo ? ". Take away shadows and what touches it, or mend the mask: skel-label FILE, key M."
                  : ". Mend the mask: skel-label FILE, key M.");
  return sentence(warning);
}

}  // namespace

std::vector<std::string> adviceOn(const RiggedDrawing& drawing, const SkeletonFile& file,
                                  const std::string& mend_file, bool plan_is_chosen) {
  std::vector<std::string> advice;
  for (const std::string& warning : file.warnings)
    advice.push_back(noteText({inOtherWords(warning, drawing, file, plan_is_chosen)}, mend_file));
  return advice;
}

}  // namespace skel
