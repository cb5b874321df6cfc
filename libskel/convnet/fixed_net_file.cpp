#include "libskel/convnet/fixed_net_file.h"

#include <nlohmann/json.hpp>

#include "libskel/core/error.h"
#include "libskel/core/json.h"
#include "libskel/core/net_format.h"
#include "libskel/core/sha256.h"

namespace skel {
namespace {

constexpr int kVersion = 1;

}  // namespace

std::string formatFixedNet(const ConvNet& net, const std::string& provenance, const FixedNetFormat& format) {
  const std::string payload = formatWeights(net);
  const nlohmann::ordered_json header = {{"format", format.name},
                                         {"version", kVersion},
                                         {"provenance", provenance},
                                         {"convolutions", convolutionSizes(net)},
                                         {"sha256", sha256(payload)}};
  return header.dump() + "\n" + payload;
}

std::string parseFixedNet(std::string_view bytes, const std::string& file, const FixedNetFormat& format,
                          ConvNet& net, bool check_hash) {
  checkNetFormat(bytes, file, format.name);
  const std::size_t end = bytes.find('\n');
  if (end == std::string_view::npos)
    throw InputError(file, "not a " + std::string(format.kind) + ": it has no header line");
  const JsonDocument document = JsonDocument::parse(bytes.substr(0, end), file);
  const JsonValue root = document.root();
  root.checkFormat(format.name, kVersion);
  root.allowOnly({"format", "version", "provenance", "convolutions", "sha256"});
  const std::string provenance = root.at("provenance").asString();
  parseWeights(bytes.substr(end + 1), root, file, net, check_hash);
  return provenance;
}

}  // namespace skel
