#include "trainer/average_nets.h"

#include "libskel/cli/outputs.h"
#include "libskel/core/files.h"
#include "libskel/core/net_format.h"
#include "libskel/core/own_format.h"
#include "libskel/jointnet/joint_net.h"
#include "libskel/layers/part_net.h"
#include "libskel/silhouette/page_net.h"
#include "trainer/writable_output.h"

namespace skel {

void bindAverageNetsOptions(CLI::App& command, AverageNetsOptions& options) {
  command.add_option("net", options.nets, "Joint nets, part nets or page nets, trained on from one another")
      ->required()
      ->expected(2, 100)
      ->type_name("FILE");
  command.add_option("-o,--output", options.output, "Weights file to write")
      ->capture_default_str()
      ->check(outputFile(kAnyFormat));
}

namespace {

bool areAlike(const JointNet& a, const JointNet& b) {
  return a.body_plan == b.body_plan && a.joints == b.joints;
}
template <typename Net>
bool areAlike(const Net&, const Net&) {
  return true;
}

// `parse` and `format`: of the nets' files.
template <typename Parse, typename Format>
void writeMean(const AverageNetsOptions& options, std::string_view kind, const Parse& parse,
               const Format& format) {
  ensureWritableFile(options.output);
  keepOtherFormats(options.output, kind);
  const std::vector<std::string>& files = options.nets;
  const auto read = [&](const std::string& file) { return parse(readFile(file), file); };
  auto mean = read(files.front());
  std::vector<double> sums(mean.parameters.size(), 0);
  for (const std::string& file : files) {
    const auto net = read(file);
    if (!areAlike(net, mean) || net.parameters.size() != sums.size())
      throw InputError(file, "is another kind of net than " + files.front());
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += net.parameters[i];
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    mean.parameters[i] = static_cast<float>(sums[i] / static_cast<double>(files.size()));
  quantize(mean);
  mean.provenance =
      "skel-train average: of " + std::to_string(files.size()) + " nets; the first: " + mean.provenance;
  writeFile(options.output, format(mean));
}

}  // namespace

ExitCode runAverageNets(const AverageNetsOptions& options) {
  constexpr std::string_view kJoints = "skel-joint-net", kParts = "skel-part-net", kPages = "skel-page-net";
  const std::string kind = netFormatOf(readFile(options.nets.front()));
  const auto with = [](auto parse) {
    return [parse](const std::string& bytes, const std::string& file) { return parse(bytes, file, true); };
  };
  if (kind == kParts)
    writeMean(options, kParts, with(parsePartNet), formatPartNet);
  else if (kind == kPages)
    writeMean(options, kPages, with(parsePageNet), formatPageNet);
  else
    writeMean(options, kJoints, with(parseJointNet), formatJointNet);
  return ExitCode::kDone;
}

}  // namespace skel
