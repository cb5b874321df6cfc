#include <cstdio>

#include "libskel/core/files.h"
#include "libskel/core/text.h"
#include "stylizer/commands.h"

namespace skel {

MotionTransferOptions transferOptions(const StyleRequest& request) {
  MotionTransferOptions options;
  options.transfer.coding = request.coding;
  options.transfer.amount = request.amount;
  options.mirror = request.mirror == "auto"  ? MirrorStyle::kAutomatic
                   : request.mirror == "yes" ? MirrorStyle::kAlways
                                             : MirrorStyle::kNever;
  options.loop = request.loop;
  options.by_signatures = request.match == "signatures";
  return options;
}

void sayTransferNotes(const MotionTransferReport& report, const std::string& file) {
  for (const std::string& note : transferNotes(report))
    std::fprintf(stderr, "%s: note: %s\n", printable(file).c_str(), note.c_str());
}

ExitCode runTransfer(const TransferCommandOptions& options) {
  if (!options.force) requireNoEdits(options.output, loadTemplate("biped"));
  const std::vector<NamedMotion> content = readMotions(options.content), style = readMotions(options.style);
  const MotionTransferReport report = transferMotion(content, style, transferOptions(options.request));
  writeFile(options.output, formatMotionFile(report.motion, loadTemplate("biped")));
  std::printf("%s: %s%s\n  factored to %.2f %%; mean pose %.0f %% of the way; phase correlation %.3f\n",
              printable(options.output).c_str(), printable(report.motion.source).c_str(),
              report.mirrored ? ", mirrored" : "", 100 * report.error, 100 * report.mean_pose_moved,
              report.phase_correlation);
  sayTransferNotes(report, options.output);
  return ExitCode::kDone;
}

}  // namespace skel
