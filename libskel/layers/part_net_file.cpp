// Weights files of the part net.
#include "libskel/convnet/fixed_net_file.h"
#include "libskel/layers/part_net.h"

namespace skel {
namespace {

constexpr FixedNetFormat kFormat = {"skel-part-net", "part net"};

}  // namespace

std::string formatPartNet(const PartNet& net) { return formatFixedNet(net, net.provenance, kFormat); }

PartNet parsePartNet(std::string_view bytes, const std::string& file, bool check_hash) {
  PartNet net = makePartNet();
  net.provenance = parseFixedNet(bytes, file, kFormat, net, check_hash);
  return net;
}

}  // namespace skel
