#include "trainer/average_nets.h"

#include "libskel/cli/outputs.h"
#include "libskel/core/files.h"
#include "libskel/core/net_format.h"
#include "libskel/jointnet/joint_net.h"
#include "libskel/layers/part_net.h"
#include "trainer/writable_output.h"

namespace skel {

void bindAverageNetsOptions(CLI::App& command, AverageNetsOptions& options) {
  command.add_option("net", options.nets, "Joint nets, or part nets, trained on from one another")
      ->required()
      ->expected(2, 100)
      ->type_name("FILE");
  command.add_option("-o,--output", options.output, "Weights file to write")
      ->capture_default_str()
      ->check(outputFile());
}

namespace {

bool areAlike(const JointNet& a, const JointNet& b) {
  return a.body_plan == b.body_plan && a.joints == b.joints;
}
bool areAlike(const PartNet&, const PartNet&) { return true; }

template <typename Net>
Net meanOf(const std::vector<std::string>& files, Net (*read)(const std::string& file)) {
  Net mean = read(files.front());
  std::vector<double> sums(mean.parameters.size(), 0);
  for (const std::string& file : files) {
    const Net net = read(file);
    if (!areAlike(net, mean) || net.parameters.size() != sums.size())
      throw InputError(file, "is another kind of net than " + files.front());
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += net.parameters[i];
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    mean.parameters[i] = static_cast<float>(sums[i] / static_cast<double>(files.size()));
  quantize(mean);
  mean.provenance =
      "skel-train average: of " + std::to_string(files.size()) + " nets; the first: " + mean.provenance;
  return mean;
}

}  // namespace

ExitCode runAverageNets(const AverageNetsOptions& options) {
  constexpr std::string_view kParts = "skel-part-net";
  const bool of_parts = netFormatOf(readFile(options.nets.front())) == kParts;
  ensureWritableNet(options.output, of_parts ? kParts : "skel-joint-net");
  if (of_parts)
    writeFile(options.output, formatPartNet(meanOf<PartNet>(options.nets, [](const std::string& file) {
                return parsePartNet(readFile(file), file);
              })));
  else
    writeFile(options.output, formatJointNet(meanOf<JointNet>(options.nets, [](const std::string& file) {
                return parseJointNet(readFile(file), file);
              })));
  return ExitCode::kDone;
}

}  // namespace skel
