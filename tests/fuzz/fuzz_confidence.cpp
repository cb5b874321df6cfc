// The nets that say how sure one may be: of joints and figures, of silhouettes, of what lines enclose, of
// limbs, of which way figures look. What is read gives chances, and the same file again.
#include "libskel/layers/limb_net.h"
#include "libskel/recognition/confidence_model.h"
#include "libskel/recognition/facing_net.h"
#include "libskel/recognition/silhouette_confidence.h"
#include "libskel/silhouette/loops.h"
#include "tests/fuzz/fuzz.h"

namespace skel {
namespace {

template <class Model>
void read(std::string_view text, Model parse(std::string_view, const std::string&),
          std::string format(const Model&), std::initializer_list<LogisticNet Model::*> nets) {
  mayRefuse([&] {
    const Model model = parse(text, "fuzz.json");
    const std::string written = format(model);
    require(format(parse(written, "again.json")) == written, "what is written is read as it was");
    for (const auto net : nets)
      for (const double input : {-1e9, 0., 0.5, 1e9}) {
        const LogisticNet& one = model.*net;
        const double chance = one.probability(Eigen::VectorXd::Constant(one.mean.size(), input));
        require(chance >= 0 && chance <= 1, "chances lie in [0, 1]");
      }
  });
}

}  // namespace
}  // namespace skel

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  const std::string_view text = textOf(data, size);
  read(text, parseConfidenceModel, formatConfidenceModel,
       {&ConfidenceModel::joint, &ConfidenceModel::figure});
  read(text, parseSilhouetteConfidence, formatSilhouetteConfidence, {&SilhouetteConfidence::net});
  read(text, parseLoopNet, formatLoopNet, {&LoopNet::net});
  read(text, parseLimbNet, formatLimbNet, {&LimbNet::net});
  read(text, parseFacingNet, formatFacingNet, {&FacingNet::right, &FacingNet::turned, &FacingNet::side});
  return 0;
}
