#include "trainer/average_nets.h"

#include "libskel/cli/outputs.h"
#include "libskel/core/files.h"
#include "libskel/jointnet/joint_net.h"
#include "trainer/writable_output.h"

namespace skel {

void bindAverageNetsOptions(CLI::App& command, AverageNetsOptions& options) {
  command.add_option("net", options.nets, "Joint nets, trained on from one another")
      ->required()
      ->expected(2, 100)
      ->type_name("FILE");
  command.add_option("-o,--output", options.output, "Weights file to write")
      ->capture_default_str()
      ->check(outputFile());
}

ExitCode runAverageNets(const AverageNetsOptions& options) {
  ensureWritableNet(options.output, "skel-joint-net");
  JointNet mean = parseJointNet(readFile(options.nets.front()), options.nets.front());
  std::vector<double> sums(mean.parameters.size(), 0);
  for (const std::string& file : options.nets) {
    const JointNet net = parseJointNet(readFile(file), file);
    if (net.body_plan != mean.body_plan || net.joints != mean.joints || net.parameters.size() != sums.size())
      throw InputError(file, "is another kind of net than " + options.nets.front());
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += net.parameters[i];
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    mean.parameters[i] = static_cast<float>(sums[i] / static_cast<double>(options.nets.size()));
  quantize(mean);
  mean.provenance = "skel-train average: of " + std::to_string(options.nets.size()) +
                    " nets; the first: " + mean.provenance;
  writeFile(options.output, formatJointNet(mean));
  return ExitCode::kDone;
}

}  // namespace skel
