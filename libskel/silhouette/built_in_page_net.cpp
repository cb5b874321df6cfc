#include "embedded/page_net_weights.h"
#include "libskel/silhouette/page_net.h"

namespace skel {

const PageNet& builtInPageNet() {
  static const PageNet net = readyToRun(parsePageNet(embedded::page_net_weights, "built-in page net", false));
  return net;
}

bool hasBuiltInPageNet() { return true; }

}  // namespace skel
