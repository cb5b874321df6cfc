#include "trainer/generated_characters.h"

#include "libskel/core/check.h"
#include "libskel/core/parallel.h"
#include "libskel/labels/label_from_joints.h"
#include "libskel/skeleton/template.h"
#include "trainer/figures/figure.h"

namespace skel {
namespace {

LabelledCharacter labelled(const Figure& figure, const std::vector<std::string>& joint_names,
                           const SkeletonTemplate& body_plan, const CandidateOptions& options) {
  Silhouette silhouette;
  silhouette.grid_mask = figure.mask;  // drawn on the working grid: a px of one is a px of the other
  const CandidateSet candidates = extractCandidates(silhouette, options);
  NamedJoints joints;
  for (std::size_t j = 0; j < joint_names.size(); ++j) joints.emplace_back(joint_names[j], figure.joints[j]);
  LabelledCharacter character{"", features(candidates), {}};
  for (const auto& label : labelFromJoints(candidates, WorkingGrid(), joints, body_plan)) {
    SKEL_CHECK(label.has_value());
    character.labels.push_back(*label);
  }
  return character;
}

}  // namespace

std::vector<LabelledCharacter> generateCharacters(int count, std::uint64_t seed, int threads,
                                                  const CandidateOptions& options,
                                                  const std::function<void()>& before_each) {
  const std::vector<std::string> joint_names = jointNames(figurePlan("biped"));
  const SkeletonTemplate body_plan = loadTemplate("biped");
  std::vector<LabelledCharacter> characters(static_cast<std::size_t>(count));
  parallelFor(characters.size(), threads, [&](std::size_t i) {
    if (before_each) before_each();
    Rng rng(seed, i);
    characters[i] = labelled(generateFigure(rng), joint_names, body_plan, options);
    characters[i].name = "generated " + std::to_string(i);
  });
  return characters;
}

}  // namespace skel
