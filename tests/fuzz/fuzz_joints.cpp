// Annotations (<name>.joints.json); what is read labels the candidates of a figure.
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/label_from_joints.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/synthetic_figure.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const SkeletonTemplate body_plan = loadTemplate("biped");
  static const Silhouette figure = extractSilhouette(capsuleImage({.size = 64}));
  static const CandidateSet candidates = extractCandidates(figure, {});
  const std::string path = fileOf(textOf(data, size), "fuzz.joints.json");
  mayRefuse([&] { readView(path); });
  mayRefuse([&] {
    const NamedJoints joints = readJointsFile(path);
    require(labelFromJoints(candidates, figure.grid, joints, body_plan).size() == candidates.maxima.size(),
            "each candidate has a label or none");
  });
  return 0;
}
