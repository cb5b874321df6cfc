#include "infer/outputs.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <system_error>

#include "infer/rig_request.h"
#include "libskel/core/files.h"
#include "libskel/core/text.h"
#include "libskel/draw/draw_skeleton.h"
#include "libskel/export/formats.h"
#include "libskel/image/write_image.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

struct Request {
  const InferOptions& options;
  const std::string& stem;
  const RiggedDrawing& drawing;
  const SkeletonFile& file;

  std::string path(const std::string& suffix) const { return options.out_dir + "/" + stem + suffix; }
};

struct OutputFile {
  std::string path;
  std::string bytes;
};

struct Format {
  std::string_view name;
  std::function<std::vector<OutputFile>(const Request&)> make;
};

std::vector<OutputFile> makeSkeletonJson(const Request& r) {
  return {{r.path(".skeleton.json"), formatSkeletonFile(r.file)}};
}

std::vector<OutputFile> makeSilhouette(const Request& r) {
  return {{r.path(".silhouette.png"), encodePng(r.drawing.silhouette.mask)}};
}

std::vector<OutputFile> makeLayers(const Request& r) {
  return {{r.path(".layers.png"), encodePng(layerPicture(r.drawing.layers, r.drawing.silhouette.mask))}};
}

// One row a candidate: where it is, what the net saw, what it took it for, whether the rules saw it.
std::vector<OutputFile> makeFeatures(const Request& r) {
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
  return {{r.path(".features.csv"), csv}};
}

std::vector<OutputFile> makeOverlay(const Request& r) {
  Image picture = r.drawing.image;
  drawSkeleton(picture, r.drawing.character.skeleton);
  return {{r.path(".overlay.png"), encodePng(picture)}};
}

// The pictures and lists of this tool, then what the library exports of a character.
std::vector<Format> makeFormats() {
  std::vector<Format> all = {{"json", makeSkeletonJson},
                             {"overlay", makeOverlay},
                             {"silhouette", makeSilhouette},
                             {"layers", makeLayers},
                             {"features", makeFeatures}};
  for (const ExportFormat& format : exportFormats())
    all.push_back({format.name, [&format](const Request& r) {
                     std::vector<OutputFile> files;
                     const ExportOptions options{.name = r.stem, .naming = kNamingNames.at(r.options.naming)};
                     for (ExportedFile& file : format.encode({r.drawing.character, r.drawing.clips, options,
                                                              &r.drawing.image, &r.drawing.silhouette.mask}))
                       files.push_back({r.path(file.suffix), std::move(file.bytes)});
                     return files;
                   }});
  return all;
}

const std::vector<Format>& formats() {
  static const std::vector<Format> all = makeFormats();
  return all;
}

}  // namespace

std::vector<std::string> allFormats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) names.emplace_back(format.name);
  return names;
}

std::string formatNames() { return joined(allFormats()); }

std::vector<std::string> writeOutputs(const InferOptions& options, const std::string& stem,
                                      const RiggedDrawing& drawing, const SkeletonFile& file) {
  const Request request{options, stem, drawing, file};
  std::vector<OutputFile> files;
  for (const std::string& name : options.formats) {
    const auto format =
        std::find_if(formats().begin(), formats().end(), [&](const Format& f) { return f.name == name; });
    for (OutputFile& made : format->make(request)) files.push_back(std::move(made));
  }
  std::vector<std::string> inputs = options.images;
  for (const std::string& other :
       {options.mask_file, options.layers, options.model_file, options.weights_file, options.joint_net_file})
    inputs.push_back(other);
  for (const OutputFile& made : files)
    for (const std::string& input : inputs)
      if (std::error_code none; fs::equivalent(made.path, input, none))
        throw UsageError(made.path +
                         " would be written over, but it is an input; name another folder with -o");
  std::vector<std::string> paths;
  for (const OutputFile& made : files) {
    writeFile(made.path, made.bytes);
    paths.push_back(made.path);
  }
  return paths;
}

}  // namespace skel
