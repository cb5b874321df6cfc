// Weights files of the page net.
#include "libskel/convnet/fixed_net_file.h"
#include "libskel/silhouette/page_net.h"

namespace skel {
namespace {

constexpr FixedNetFormat kFormat = {"skel-page-net", "page net"};

}  // namespace

std::string formatPageNet(const PageNet& net) { return formatFixedNet(net, net.provenance, kFormat); }

PageNet parsePageNet(std::string_view bytes, const std::string& file, bool check_hash) {
  PageNet net = makePageNet();
  net.provenance = parseFixedNet(bytes, file, kFormat, net, check_hash);
  return net;
}

}  // namespace skel
