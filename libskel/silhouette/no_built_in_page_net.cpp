#include "libskel/core/error.h"
#include "libskel/silhouette/page_net.h"

namespace skel {

const PageNet& builtInPageNet() {
  throw UsageError("no page net is built in; hand one over in SilhouetteOptions");
}

bool hasBuiltInPageNet() { return false; }

}  // namespace skel
