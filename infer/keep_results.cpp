#include "infer/keep_results.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include "infer/deciding_options.h"
#include "infer/outputs.h"
#include "infer/result_file.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/sha256.h"
#include "libskel/core/temporary_file.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

// Of what a person has mended, and of where it lies, which notes name. "": there is nothing.
struct MendedHash {
  std::string of_done;    // without a skeleton that is an output of this run, which is known by its own hash
  std::string of_failed;  // with that: a run that failed has no outputs
  const std::string& of(const DrawingResult& result) const {
    return result.error.empty() ? of_done : of_failed;
  }
};

MendedHash mendedHash(const InferOptions& options, const RigJob& job, const std::string& image_sha256) {
  const LookAtOutputs look;  // a silhouette that was painted in place is one of them
  std::string inputs, outputs;
  const FigureRange range = figuresAskedFor(options);
  for (int figure = range.first; figure <= range.last; ++figure) {
    const MendRequest request = mendRequest(options, job, figure, image_sha256);
    const MendedFiles files = mendedFiles(request);
    const auto isOutput = [&](const std::string& skeleton) {
      return writes(options, "json") && skeleton == request.results + kSkeletonFileEnding;
    };
    const auto add = [&](const char* what, const std::string& file, std::string& all) {
      if (!file.empty())
        all += std::to_string(figure) + what + sha256(readFile(file)) + " " +
               fs::path(file).lexically_normal().string() + "\n";
    };
    add(" skeleton ", files.skeleton, isOutput(files.skeleton) ? outputs : inputs);
    add(" labels ", files.labels, inputs), add(" mask ", files.mask, inputs);
    add(" limbs ", files.limbs, inputs), add(" back ", files.back, inputs);
    add(" facing ", files.facing, isOutput(files.facing) ? outputs : inputs);
  }
  const auto hashOf = [](const std::string& all) { return all.empty() ? "" : sha256(all); };
  return {hashOf(inputs), hashOf(inputs + outputs)};
}

// What an earlier run says. One that cannot be read says nothing: the drawing is done anew.
std::optional<DrawingResult> earlierResult(const std::string& path) {
  std::error_code unknown;
  if (!fs::exists(path, unknown)) return std::nullopt;
  try {
    const LookAtOutputs look;
    return parseResult(readFile(path), path);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool isAnother(const std::string& drawing, const std::string& source) {
  std::error_code not_there;
  return fs::exists(drawing, not_there) && !fs::equivalent(drawing, source, not_there);
}

bool areThere(const std::vector<FigureResult>& figures) {
  const LookAtOutputs look;
  for (const FigureResult& figure : figures)
    for (const WrittenFile& file : figure.outputs) {
      std::error_code not_there;
      if (fs::file_size(file.path, not_there) != file.bytes || not_there) return false;
      if (sha256(readFile(file.path)) != file.sha256) return false;
    }
  return true;
}

// The same drawing may be in a list twice, or a machine that was thought dead still at it.
class Claim {
 public:
  explicit Claim(const std::string& path) : path_(path), file_(madeFolderOf(path)) {
    if (file_.fd() < 0) fail();
  }
  void write(const std::string& text) {
    if (!writeAll(file_.fd(), text) || !file_.flush() || !file_.becomeTarget()) fail();
  }

 private:
  static const std::string& madeFolderOf(const std::string& path) {
    std::error_code failure;
    fs::create_directories(fs::path(path).parent_path(), failure);
    if (failure) throw OutputError(path, "cannot make its folder: " + failure.message());
    return path;
  }
  [[noreturn]] void fail() const {
    throw OutputError(path_, std::string("cannot be written: ") + std::strerror(errno));
  }

  std::string path_;
  TemporaryFile file_;
};

MendedHash readOnce(const InferOptions& options, RigJob& job, Origin& origin) {
  std::string bytes = readFile(job.source);
  origin.image = sha256(bytes);
  MendedHash mended = mendedHash(options, job, origin.image);
  origin.mended = mended.of_done;
  job.read = {std::move(bytes), origin.image};
  return mended;
}

bool drawingDecided(ExitCode code) { return code == ExitCode::kDone || code == ExitCode::kInput; }

DrawingResult rigAndKeep(const InferOptions& options, const RigOptions& rig, Origin origin, RigJob& job,
                         ProgressBar& progress) {
  const std::string path = options.out_dir + "/" + job.stem + kResultFileEnding;
  Claim claim(path);
  const std::optional<DrawingResult> earlier = earlierResult(path);
  if (earlier && isAnother(earlier->source, job.source))
    throw InputError(job.source, "its results would take the place of those of " + earlier->source +
                                     "; rename one of the two, or delete " + path);
  const MendedHash mended = readOnce(options, job, origin);
  if (earlier) origin.mended = mended.of(*earlier);
  if (options.resume && earlier && earlier->origin == origin && areThere(earlier->figures)) {
    DrawingResult kept = *earlier;
    if (!kept.problem.empty()) kept.error = job.source + ": " + kept.problem;
    kept.source = job.source;
    kept.image_sha256 = origin.image;
    kept.kept = true;
    for (FigureResult& figure : kept.figures) figure.mend_file = fileToMend(options, job, figure.number);
    progress.advance();
    return kept;
  }
  DrawingResult result = rigDrawing(options, rig, job, progress);
  origin.mended = mended.of(result);
  result.origin = std::move(origin);
  try {
    if (drawingDecided(result.code)) claim.write(formatResult(result, path) + "\n");
  } catch (...) {
    takeError(result);
  }
  return result;
}

}  // namespace

Origin originOfRun(const InferOptions& options) {
  if (!tellsHashes(options)) return {};
  return {"", "", optionsHash(options), sha256(options.nets), options.version};
}

DrawingResult rigOnce(const InferOptions& options, const RigOptions& rig, const Origin& run, RigJob job,
                      ProgressBar& progress) {
  DrawingResult failed;
  failed.source = job.source;
  failed.origin = run;
  try {
    if (keepsResults(options)) return rigAndKeep(options, rig, run, job, progress);
    Origin origin = run;
    if (tellsHashes(options)) readOnce(options, job, origin);
    DrawingResult result = rigDrawing(options, rig, job, progress);
    result.origin = std::move(origin);
    return result;
  } catch (...) {
    takeError(failed);
  }
  progress.advance();
  return failed;
}

}  // namespace skel
