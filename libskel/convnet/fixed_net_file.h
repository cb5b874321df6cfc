// Weights files of nets whose layers are fixed by the program: one line of JSON (format, version 1,
// provenance, convolutions, SHA-256 of what follows), then the weights (formatWeights()).
#pragma once

#include <string>
#include <string_view>

#include "libskel/convnet/conv_net.h"

namespace skel {

struct FixedNetFormat {
  std::string_view name;  // "skel-page-net"
  std::string_view kind;  // as complaints call it: "page net"
};

std::string formatFixedNet(const ConvNet& net, const std::string& provenance, const FixedNetFormat& format);
// Into a net of the same layers. Returns the provenance. Throws InputError.
std::string parseFixedNet(std::string_view bytes, const std::string& file, const FixedNetFormat& format,
                          ConvNet& net, bool check_hash);

}  // namespace skel
