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

std::string jointNote(const Recognition& recognition, const std::string& body_plan) {
  const std::string missing = joined(recognition.missing);
  if (recognition.likeness < kHardlyOne)
    return "this hardly looks like one whole " + body_plan +
           (missing.empty() ? "" : "; not found: " + missing);
  if (recognition.confidence < 0.5) return doubtNote(recognition.missing);
  return missingNote(recognition.missing);
}

}  // namespace skel
