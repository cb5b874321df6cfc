// Weights files of the part net.
#include <nlohmann/json.hpp>

#include "libskel/core/error.h"
#include "libskel/core/json.h"
#include "libskel/core/sha256.h"
#include "libskel/layers/part_net.h"

namespace skel {
namespace {

constexpr std::string_view kFormat = "skel-part-net";
constexpr int kVersion = 1;

}  // namespace

std::string formatPartNet(const PartNet& net) {
  const std::string payload = formatWeights(net);
  const nlohmann::ordered_json header = {{"format", kFormat},
                                         {"version", kVersion},
                                         {"provenance", net.provenance},
                                         {"convolutions", convolutionSizes(net)},
                                         {"sha256", sha256(payload)}};
  return header.dump() + "\n" + payload;
}

PartNet parsePartNet(std::string_view bytes, const std::string& file, bool check_hash) {
  const std::size_t end = bytes.find('\n');
  if (end == std::string_view::npos) throw InputError(file, "not a part net: it has no header line");
  const JsonDocument document = JsonDocument::parse(bytes.substr(0, end), file);
  const JsonValue root = document.root();
  root.checkFormat(kFormat, kVersion);
  root.allowOnly({"format", "version", "provenance", "convolutions", "sha256"});
  PartNet net = makePartNet();
  net.provenance = root.at("provenance").asString();
  parseWeights(bytes.substr(end + 1), root, file, net, check_hash);
  return net;
}

}  // namespace skel
