#include "libskel/jointnet/joint_net.h"

namespace skel {

const JointNets& builtInJointNets() {
  static const JointNets none({});
  return none;
}

}  // namespace skel
