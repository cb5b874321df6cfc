#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "infer/drawing_list.h"
#include "infer/infer_options.h"
#include "infer/keep_results.h"
#include "infer/rig_figure.h"
#include "infer/rig_request.h"
#include "infer/run_report.h"
#include "libskel/core/files.h"
#include "libskel/core/foreign_files.h"
#include "libskel/core/in_order.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
#include "libskel/core/temporary_file.h"
#include "libskel/core/text.h"
#include "libskel/image/named_drawings.h"
#include "libskel/image/result_picture.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

constexpr const char* kStandardInput = "/dev/stdin";

std::vector<RigJob> jobsOf(const InferOptions& options) {
  std::vector<std::string> sources = options.images;
  if (sources.empty()) sources.push_back(options.model_file);
  const auto former_names = std::make_shared<FormerNames>();
  std::vector<RigJob> jobs;
  for (const std::string& source : sources)
    jobs.push_back(
        {source, options.name.empty() ? fs::path(source).stem().string() : options.name, {}, former_names});
  std::vector<std::string> stems;
  for (const RigJob& job : jobs) stems.push_back(job.stem);
  if (const auto clash = nameClash(sources, stems)) {
    const bool same_folder = fs::path(clash->first).parent_path() == fs::path(clash->second).parent_path();
    throw UsageError(clash->first + " and " + clash->second + " would both write " + options.out_dir + "/" +
                     clash->name + ".*" + clash->more + "; " +
                     (same_folder
                          ? "if one is the other taken again, move the older one elsewhere, else rename one"
                          : "rename one or run them with different -o"));
  }
  return jobs;
}

// Of a run over many drawings that is stopped by Ctrl+C.
void sayHowToGoOn(const InferOptions& options) {
  const std::string start =
      isatty(STDERR_FILENO) ? "\nskel-infer: " : "skel-infer: ";  // the bar stands there
  const std::string how = options.resume ? "interrupted; the same line goes on from here"
                          : keepsResults(options)
                              ? "interrupted; the same line with --resume goes on from here"
                              : "interrupted; what is done lies in " + printable(options.out_dir) +
                                    ". The same line does all again; only a run that began with --resume "
                                    "(and without --report) goes on where it was stopped";
  sayOnInterrupt(start + how + "\n");
}

// A name that was mistyped must not cost what is there: before anything is made.
void refuseMissing(const std::vector<RigJob>& jobs) {
  for (const RigJob& job : jobs) {
    std::error_code failure;
    if (!fs::exists(job.source, failure))
      throw InputError(job.source,
                       "cannot be read: " +
                           (failure ? failure.message()
                                    : std::make_error_code(std::errc::no_such_file_or_directory).message()) +
                           (jobs.size() > 1 ? "; nothing was rigged" : ""));
  }
}

void ensureFolders(const InferOptions& options) {
  ensureWritableFolder(options.out_dir);
  if (!options.trace_dir.empty()) ensureWritableFolder(options.trace_dir);
  if (options.report_file.empty()) return;
  if (options.report_file.ends_with('/') || fs::is_directory(options.report_file))
    throw OutputError(options.report_file, "is a folder; name a file by --report");
  // A pattern of the shell puts a photo there.
  if (!options.report_file.ends_with(".html") && !options.report_file.ends_with(".htm") &&
      fs::is_regular_file(options.report_file))
    throw OutputError(options.report_file,
                      "is no page, and would be written over; name a file that ends in .html by --report");
  ensureWritableFolderOf(options.report_file);
}

// Rigs what `next` gives, until there is no more, and reports it in that order.
template <class Next, class Rig>
void rigInOrder(int threads, ProgressBar& progress, RunReport& report, const Next& next, const Rig& rig) {
  std::vector<DrawingResult> results(slotsInOrder(threads));
  std::vector<RigJob> jobs(results.size());
  parallelInOrder(threads, {.next = [&](std::size_t slot) { return next(jobs[slot]); },
                            .work = [&](std::size_t slot) { results[slot] = rig(jobs[slot]); },
                            .take =
                                [&](std::size_t slot) {
                                  progress.clear();
                                  report.add(std::move(results[slot]));
                                }});
}

ExitCode rigNamed(const InferOptions& options, const NamedDrawings& named) {
  const std::vector<RigJob> all = jobsOf(options);
  std::vector<std::string> sources;
  for (const RigJob& job : all) sources.push_back(job.source);
  requireNamed(options.heights, "--height", sources);
  requireNamed(options.facing, "--facing", sources);
  const RigOptions rig = rigOptions(options);
  for (const RigJob& job : all) noteInput(job.source);
  for (const RigJob& job : all) {
    noteResults(options, job, rig.clips);
    if (rig.otherwise) noteResults(options, job, rig.otherwise->clips);
  }
  refuseMissing(all);
  NamedDrawings told = named;
  if (options.quiet) {
    told = {};
    told.folders = named.folders;
  }
  for (const std::string& note : notesOf(told))
    std::fprintf(stderr, "skel-infer: note: %s\n", printable(note).c_str());
  if (!options.quiet) noteUnusedWeights(options);
  ensureFolders(options);
  const Origin run = originOfRun(options);
  if (all.size() > 1 && !options.quiet) sayHowToGoOn(options);
  RunReport report(options, rig, all.size() > 1);
  {
    ProgressBar progress("rigging", all.size(), !options.quiet);
    const std::size_t threads = std::min(threadCount(options.jobs), all.size());
    std::size_t begun = 0;
    rigInOrder(
        int(threads), progress, report,
        [&](RigJob& job) {
          if (begun == all.size()) return false;
          job = all[begun++];
          return true;
        },
        [&](const RigJob& job) { return rigOnce(options, rig, run, job, progress); });
  }
  return report.end();
}

bool isIn(const fs::path& folder, const std::string& file) {
  std::error_code not_there;
  const fs::path below = fs::canonical(file, not_there).lexically_relative(folder);
  return !not_there && !below.empty() && *below.begin() != "..";
}

// One of a list. No result is ever a drawing's file, as no drawing lies where results do: so nothing needs to
// be remembered of the files of others.
DrawingResult rigListed(const InferOptions& options, const RigOptions& rig, const Origin& run,
                        const fs::path& out_dir, RigJob job, ProgressBar& progress) {
  const NotedForNow now;
  DrawingResult other;
  other.source = job.source;
  other.origin = run;
  try {
    if (!isResultPicture(fs::path(job.source).filename().string()) && !isIn(out_dir, job.source)) {
      job.stem = stemInTree(job.source);
      noteInput(job.source);
      noteResults(options, job, rig.clips);
      return rigOnce(options, rig, run, std::move(job), progress);
    }
    other.left_out = true;
  } catch (...) {
    takeError(other);
  }
  progress.advance();
  return other;
}

ExitCode rigList(const InferOptions& options) {
  DrawingList list(options.list_file, options.null_ended,
                   options.shard.empty() ? Shard() : shardNamed(options.shard));
  const RigOptions rig = rigOptions(options);
  if (!options.quiet) noteUnusedWeights(options);
  ensureFolders(options);
  const fs::path out_dir = fs::canonical(options.out_dir);
  const Origin run = originOfRun(options);
  if (!options.quiet) sayHowToGoOn(options);
  RunReport report(options, rig, true);
  const auto former_names = std::make_shared<FormerNames>();
  {
    ProgressBar progress("rigging", options.quiet ? 0 : list.length(), !options.quiet);
    rigInOrder(
        options.jobs, progress, report,
        [&](RigJob& job) {
          const auto path = list.next();
          if (path) job = {*path, "", {}, former_names};
          return path.has_value();
        },
        [&](const RigJob& job) { return rigListed(options, rig, run, out_dir, job, progress); });
  }
  return report.end();
}

}  // namespace

ExitCode runInfer(const InferOptions& asked) {
  InferOptions options = asked;
  NamedDrawings named = drawingsOf(asked.images);
  options.images = std::move(named.drawings);
  for (std::string& image : options.images)
    if (image == "-") notePipe(image = kStandardInput);
  checkUsage(options);
  return options.list_file.empty() ? rigNamed(options, named) : rigList(options);
}

}  // namespace skel
