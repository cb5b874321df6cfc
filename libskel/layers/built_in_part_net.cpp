#include "embedded/part_net_weights.h"
#include "libskel/layers/part_net.h"

namespace skel {

const PartNet& builtInPartNet() {
  static const PartNet net = readyToRun(parsePartNet(embedded::part_net_weights, "built-in part net", false));
  return net;
}

}  // namespace skel
