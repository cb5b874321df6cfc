#include <cstdio>
#include <filesystem>

#include "libskel/core/text.h"
#include "libskel/style/poses.h"
#include "stylizer/commands.h"

namespace skel {

ExitCode runDatabase(const DatabaseOptions& options) {
  if (options.task == "add") {
    if (options.motions.empty()) throw UsageError("database add: name the motion files to add");
    for (const std::string& motion : options.motions) {
      const SkeletonTemplate plan = loadTemplate("biped");
      posesOf(readMotion(motion), plan, motion);  // says what no command could use
      const DatabaseEntry entry = addToDatabase(options.folder, motion, options.action, options.force);
      std::printf("%s: %s, %d frames, %d key frames\n", printable(entry.file).c_str(),
                  printable(entry.action).c_str(), entry.frames, entry.keys);
    }
    return ExitCode::kDone;
  }
  if (!options.motions.empty()) throw UsageError("database " + options.task + " takes the folder alone");
  if (!std::filesystem::is_directory(options.folder)) throw InputError(options.folder, "is no folder");
  const std::vector<DatabaseEntry> entries = readDatabase(options.folder);
  if (options.task == "list") {
    for (const DatabaseEntry& e : entries)
      std::printf("%-12s %-32s %5d frames %4d keys  %s\n", printable(e.action).c_str(),
                  printable(e.file).c_str(), e.frames, e.keys, printable(e.source).c_str());
    return ExitCode::kDone;
  }
  const std::vector<std::string> problems = checkDatabase(options.folder);
  for (const std::string& problem : problems) std::fprintf(stderr, "%s\n", messageLine(problem).c_str());
  std::printf("%d motions, %d problems\n", int(entries.size()), int(problems.size()));
  return problems.empty() ? ExitCode::kDone : ExitCode::kInput;
}

}  // namespace skel
