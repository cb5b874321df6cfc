#include "libskel/core/error.h"
#include "libskel/layers/part_net.h"

namespace skel {

const PartNet& builtInPartNet() { throw UsageError("no part net is built in; hand one over in RigOptions"); }

}  // namespace skel
