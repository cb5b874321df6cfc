#include "libskel/pipeline/drawing_notes.h"

#include <map>

#include "libskel/core/text.h"
#include "libskel/deform/stretch.h"

namespace skel {

std::vector<std::string> figureNotes(const RiggedDrawing& drawing) {
  std::vector<std::string> notes = drawing.silhouette.warnings;
  notes.insert(notes.end(), drawing.recognition.warnings.begin(), drawing.recognition.warnings.end());
  return notes;
}

std::vector<std::string> limbNotes(const RiggedDrawing& drawing, const std::vector<Clip>& clips,
                                   const std::string& file) {
  constexpr double kSure = .5;     // who is not sure of the joints says nothing of limbs
  constexpr double kTorn = .02;    // share of the model's area that a clip stretches too far
  constexpr double kOfLimb = .01;  // of which so much is a limb's
  std::vector<std::string> notes;
  if (drawing.recognition.confidence < kSure) return notes;
  const SkeletonTemplate& body_plan = drawing.body_plan;
  const std::string remedy = "; if it is drawn before the body, paint it (skel-label " + file +
                             ", key G) and hand it back (--layers)";
  for (const int limb : drawing.layers.hidden)
    notes.push_back("the " + limbName(body_plan, limb) + " cannot be told from the body and stays with it" +
                    remedy);
  const RiggedCharacter& character = drawing.character;
  std::map<int, std::vector<int>> joints_of_limb;  // of those that are no layers
  for (std::size_t k = 0; k < body_plan.limbs.size(); ++k) {
    const int limb = static_cast<int>(k) + 1;
    if (drawing.layers.any() && (drawing.layers.limb == limb).any()) continue;
    for (const int joint : body_plan.limbs[k].joints)
      if (const int j = character.skeleton.find(body_plan.joints[std::size_t(joint)].name); j >= 0)
        joints_of_limb[limb].push_back(j);
  }
  std::map<int, std::vector<std::string>> clips_of_limb;
  for (const ClipStretch& stretch :
       clipStretches(character.mesh, character.skeleton, character.weights, clips)) {
    int most = 0;
    double share = kOfLimb;
    for (const auto& [limb, joints] : joints_of_limb) {
      double sum = 0;
      for (const int joint : joints) sum += stretch.by_joint[std::size_t(joint)];
      if (sum > share) most = limb, share = sum;
    }
    if (stretch.share > kTorn && most > 0) clips_of_limb[most].push_back(stretch.clip);
  }
  for (const auto& [limb, names] : clips_of_limb)
    notes.push_back(joined(names) + (names.size() == 1 ? " pulls the " : " pull the ") +
                    limbName(body_plan, limb) + " out of shape" + remedy);
  return notes;
}

}  // namespace skel
