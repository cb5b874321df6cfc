#include "embedded/joint_net_weights.h"
#include "embedded/quadruped_joint_net_weights.h"
#include "libskel/jointnet/joint_net.h"

namespace skel {

const JointNets& builtInJointNets() {
  static const JointNets nets(
      {{"biped", embedded::joint_net_weights, "built-in joint net of the biped", false},
       {"quadruped", embedded::quadruped_joint_net_weights, "built-in joint net of the quadruped", false}});
  return nets;
}

}  // namespace skel
