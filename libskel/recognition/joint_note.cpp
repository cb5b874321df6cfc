#include "libskel/recognition/joint_note.h"

#include "libskel/core/text.h"

namespace skel {

std::string missingNote(const std::vector<std::string>& missing) {
  return missing.empty() ? ""
                         : "not found: " + joined(missing) + " (placed where " +
                               (missing.size() == 1 ? "it probably is)" : "they probably are)");
}

std::string doubtNote(const std::vector<std::string>& missing) {
  return "some joints may be wrong, look at them" +
         (missing.empty() ? "" : "; not found: " + joined(missing));
}

std::vector<std::string> unsureJoints(const Recognition& recognition) {
  std::vector<std::string> unsure;
  for (const Joint& joint : recognition.skeleton.joints)
    if (joint.origin == JointOrigin::kRecognized && joint.confidence < kSureJoint)
      unsure.push_back(joint.name);
  return unsure;
}

std::string jointNote(const Recognition& recognition, const std::string& body_plan) {
  const std::string missing = joined(recognition.missing);
  if (recognition.likeness < kHardlyOne)
    return "this hardly looks like one whole " + body_plan +
           (missing.empty() ? "" : "; not found: " + missing);
  if (recognition.confidence < 0.5) return doubtNote(recognition.missing);
  const std::vector<std::string> unsure = unsureJoints(recognition);
  if (unsure.empty()) return missingNote(recognition.missing);
  return "may be wrong, look at " + std::string(unsure.size() == 1 ? "it: " : "them: ") + joined(unsure) +
         (missing.empty() ? "" : "; not found: " + missing);
}

}  // namespace skel
