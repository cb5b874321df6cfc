#include "infer/outputs.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <system_error>

#include "infer/rig_request.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/sha256.h"
#include "libskel/core/text.h"
#include "libskel/draw/draw_skeleton.h"
#include "libskel/export/formats.h"
#include "libskel/image/sealed_png.h"
#include "libskel/image/write_image.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

// Whether the report would go where `path` goes, by whatever spelling.
bool isReport(const InferOptions& options, const std::string& path) {
  const fs::path report = options.report_file;
  if (report.filename() != fs::path(path).filename()) return false;
  return fs::weakly_canonical(fs::absolute(report)) == fs::weakly_canonical(fs::absolute(path));
}

struct Request {
  const InferOptions& options;
  const std::string& stem;
  const RiggedDrawing& drawing;
  const SkeletonFile& file;

  std::string path(const std::string& suffix) const { return options.out_dir + "/" + stem + suffix; }
};

// By which files of one drawing name each other.
std::string nameOf(const std::string& stem) { return fs::path(stem).filename().string(); }

struct OutputFile {
  std::string path;
  std::string bytes;
};

using Suffixes = std::vector<std::string>;

struct Format {
  std::string_view name;
  LastStage needs;
  std::function<Suffixes(const std::string& stem, const std::vector<Clip>& clips)> suffixes;
  std::function<std::vector<OutputFile>(const Request&)> make;
};

// A format of one file.
Format single(std::string_view name, LastStage needs, const std::string& suffix,
              std::string (*make)(const Request&)) {
  return {name, needs, [=](const std::string&, const std::vector<Clip>&) { return Suffixes{suffix}; },
          [=](const Request& r) {
            return std::vector<OutputFile>{{r.path(suffix), make(r)}};
          }};
}

std::string makeSkeletonJson(const Request& r) { return formatSkeletonFile(r.file); }

std::string makeSilhouette(const Request& r) { return encodeSealedPng(r.drawing.silhouette.mask); }

std::string makeLayers(const Request& r) {
  return encodeSealedPng(layerPicture(r.drawing.layers, r.drawing.silhouette.mask));
}

// One row a candidate: where it is, what the net saw, what it took it for, whether the rules saw it.
std::string makeFeatures(const Request& r) {
  std::string csv = "grid_x,grid_y,radius,x,y,D,head,body,hand,leg,kept\n";
  const CandidateSet& candidates = r.drawing.candidates;
  for (size_t i = 0; i < candidates.maxima.size(); ++i) {
    const JointCandidate& c = candidates.maxima[i];
    const auto row = static_cast<Eigen::Index>(i);
    const auto feature = [&](int k) { return static_cast<double>(r.drawing.features(row, k)); };
    const auto chance = [&](int k) { return static_cast<double>(r.drawing.classes(row, k)); };
    char line[160];
    std::snprintf(line, sizeof line, "%g,%g,%.6g,%.6f,%.6f,%.6f,%.4f,%.4f,%.4f,%.4f,%d\n",
                  static_cast<double>(c.x), static_cast<double>(c.y), static_cast<double>(c.radius),
                  feature(0), feature(1), feature(2), chance(0), chance(1), chance(2), chance(3),
                  std::binary_search(candidates.kept.begin(), candidates.kept.end(), static_cast<int>(i)));
    csv += line;
  }
  return csv;
}

std::string makeOverlay(const Request& r) {
  Image picture = r.drawing.image;
  drawSkeleton(picture, r.drawing.recognition.skeleton);
  return encodePng(picture);
}

// Of the library's formats.
LastStage stageOfExport(std::string_view name) {
  return name == "char_cfg" ? LastStage::kJoints : name == "obj" ? LastStage::kModel : LastStage::kClips;
}

// The pictures and lists of this tool, then what the library exports of a character.
std::vector<Format> makeFormats() {
  std::vector<Format> all = {single("json", LastStage::kModel, ".skeleton.json", makeSkeletonJson),
                             single("overlay", LastStage::kJoints, ".overlay.png", makeOverlay),
                             single("silhouette", LastStage::kSilhouette, ".silhouette.png", makeSilhouette),
                             single("layers", LastStage::kLayers, ".layers.png", makeLayers),
                             single("features", LastStage::kClasses, ".features.csv", makeFeatures)};
  for (const ExportFormat& format : exportFormats())
    all.push_back({format.name, stageOfExport(format.name), format.suffixes, [&format](const Request& r) {
                     std::vector<OutputFile> files;
                     ExportOptions options = exportOptions(nameOf(r.stem), r.options.joints);
                     options.ink_hull = r.options.ink_hull;
                     for (ExportedFile& file :
                          format.encode({r.drawing.character, r.drawing.clips, options, &r.drawing.colors(),
                                         &r.drawing.silhouette.mask, r.file.mask.has_value()}))
                       files.push_back({r.path(file.suffix), std::move(file.bytes)});
                     return files;
                   }});
  return all;
}

const std::vector<Format>& formats() {
  static const std::vector<Format> all = makeFormats();
  return all;
}

const Format& formatNamed(const std::string& name) {
  return *std::find_if(formats().begin(), formats().end(), [&](const Format& f) { return f.name == name; });
}

// The skeleton that was handed in is the one that is gone on from: it is edited in place.
bool goesOnFrom(const InferOptions& options, const std::string& path) {
  std::error_code not_there;
  return fs::equivalent(path, options.skeleton_file, not_there);
}

}  // namespace

std::vector<std::string> allFormats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) names.emplace_back(format.name);
  return names;
}

std::string formatNames() { return joined(allFormats()); }

bool writes(const InferOptions& options, const char* format) {
  return std::count(options.formats.begin(), options.formats.end(), format) > 0;
}

LastStage lastStageFor(const InferOptions& options) {
  if (!options.trace_dir.empty() || !options.report_file.empty()) return LastStage::kClips;
  // What is kept of a drawing tells how sure its joints are.
  LastStage last = tellsHashes(options) ? LastStage::kJoints : LastStage::kSilhouette;
  for (const std::string& name : options.formats) last = std::max(last, formatNamed(name).needs);
  return last;
}

void noteOutputs(const InferOptions& options, const std::string& stem, const std::vector<Clip>& clips) {
  for (const std::string& name : options.formats)
    for (const std::string& suffix : formatNamed(name).suffixes(nameOf(stem), clips))
      if (const std::string path = options.out_dir + "/" + stem + suffix; !goesOnFrom(options, path)) {
        noteOutput(path);
        if (isReport(options, path))
          throw UsageError(path + " is to be written twice, also as the report; name another --report");
      }
}

std::vector<WrittenFile> writeOutputs(const InferOptions& options, const std::string& stem,
                                      const RiggedDrawing& drawing, const SkeletonFile& file,
                                      const std::vector<std::string>& painted) {
  const Request request{options, stem, drawing, file};
  std::vector<OutputFile> files;
  for (const std::string& name : options.formats)
    for (OutputFile& made : formatNamed(name).make(request)) files.push_back(std::move(made));
  std::vector<WrittenFile> written;
  for (OutputFile& made : files) {
    if (std::find(painted.begin(), painted.end(), made.path) != painted.end()) {
      const LookAtOutputs look;
      made.bytes = readFile(made.path);
    } else {
      goesOnFrom(options, made.path) ? replaceFile(made.path, made.bytes) : writeFile(made.path, made.bytes);
    }
    written.push_back({made.path, made.bytes.size(), tellsHashes(options) ? sha256(made.bytes) : ""});
  }
  return written;
}

}  // namespace skel
