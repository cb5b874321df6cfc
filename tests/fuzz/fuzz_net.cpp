// Weights files of convolutional nets. The files of whole nets are too large to change at random: a seed is
// the line of JSON and some bytes, which are repeated to as many as the net wants.
#include <algorithm>
#include <cmath>

#include "libskel/convnet/conv_kernels.h"
#include "libskel/jointnet/joint_net.h"
#include "libskel/layers/part_net.h"
#include "libskel/silhouette/page_net.h"
#include "tests/fuzz/fuzz.h"

namespace skel {
namespace {

std::size_t payloadOf(const std::string& file) { return file.size() - file.find('\n') - 1; }

template <class Parse>
void read(std::string_view bytes, std::size_t payload, const Parse& parse) {
  const std::size_t end = bytes.find('\n');
  std::string whole(bytes);
  if (end != std::string_view::npos && end + 1 < bytes.size() && bytes.size() - end - 1 <= payload) {
    const std::string pattern = whole.substr(end + 1);
    while (whole.size() < end + 1 + payload) whole += pattern;
    whole.resize(end + 1 + payload);
  }
  for (const bool check_hash : {true, false})
    mayRefuse([&] {
      const ConvNet& net = parse(whole, check_hash);
      for (const float parameter : net.parameters) require(std::isfinite(parameter), "parameters are finite");
    });
}

}  // namespace
}  // namespace skel

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const std::size_t page = payloadOf(formatPageNet(makePageNet())),
                           part = payloadOf(formatPartNet(makePartNet())),
                           joint = payloadOf(formatJointNet(makeJointNet("biped", {"head", "body"})));
  const std::string_view bytes = textOf(data, size), head = bytes.substr(0, bytes.find('\n'));
  if (head.find("skel-page-net") != head.npos)
    read(bytes, page, [](const std::string& b, bool check) { return parsePageNet(b, "fuzz.bin", check); });
  else if (head.find("skel-part-net") != head.npos)
    read(bytes, part, [](const std::string& b, bool check) { return parsePartNet(b, "fuzz.bin", check); });
  else
    read(bytes, joint, [](const std::string& b, bool check) { return parseJointNet(b, "fuzz.bin", check); });
  return 0;
}
