#include "libskel/labels/annotated_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <utility>

#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/json.h"
#include "libskel/core/sha256.h"
#include "libskel/core/text.h"
#include "libskel/image/check_image.h"
#include "libskel/image/read_image.h"
#include "libskel/image/result_picture.h"
#include "libskel/labels/label_from_joints.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kOwnJoints = "joints.json", kJointsEnding = ".joints.json";
constexpr double kFarthest_px = 1e6;  // more than pictures have; joints may lie a little beside them

bool isJointsFile(const std::string& path) {
  return fs::path(path).filename() == kOwnJoints || path.ends_with(kJointsEnding);
}

std::string viewAt(const JsonValue& joints_file) {
  const std::optional<JsonValue> view = joints_file.find("view");
  return view ? view->asString() : "";
}

LabelFile::Source sourceOf(const std::string& path) {
  return {fs::path(path).filename().string(), sha256(readFile(path))};
}

}  // namespace

std::optional<std::string> pictureOfStem(const fs::path& stem) {
  for (const std::string_view ending : kDrawingEndings)
    if (const std::string path = stem.string() + std::string(ending); fs::is_regular_file(path)) return path;
  std::optional<std::pair<std::ptrdiff_t, std::string>> first;
  std::error_code failure;
  const fs::path dir = stem.has_parent_path() ? stem.parent_path() : ".";
  for (fs::directory_iterator entry(dir, failure), end; !failure && entry != end; entry.increment(failure)) {
    const fs::path name = entry->path().filename();
    std::error_code unknown;
    if (name.stem() != stem.filename() || !entry->is_regular_file(unknown)) continue;
    const auto known = std::find(kDrawingEndings.begin(), kDrawingEndings.end(), endingOf(name.string()));
    if (known == kDrawingEndings.end()) continue;
    const std::pair found(known - kDrawingEndings.begin(), (stem.parent_path() / name).string());
    if (!first || found < *first) first = found;
  }
  if (!first) return std::nullopt;
  return first->second;
}

std::string imageOfJointsFile(const std::string& joints_file) {
  const fs::path path = joints_file;
  const std::string name = path.filename().string();
  const fs::path stem = path.parent_path() /
                        (name == kOwnJoints ? "image" : name.substr(0, name.size() - kJointsEnding.size()));
  if (const auto picture = pictureOfStem(stem)) return *picture;
  throw InputError(joints_file, "has no image beside it, " + stem.filename().string() + ".png");
}

void noteJointsFiles(const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (isJointsFile(file)) noteInput(file);
}

std::vector<AnnotatedImage> findAnnotatedImages(const std::string& dir, const OnInputError& on_error) {
  std::vector<AnnotatedImage> found;
  const std::vector<std::string> files = filesBelow(dir);
  noteJointsFiles(files);
  for (const std::string& path : files) {
    if (!isJointsFile(path)) continue;
    try {
      found.push_back({imageOfJointsFile(path), std::nullopt, path});
    } catch (const InputError& error) {
      if (!on_error) throw;
      on_error(error);
      continue;
    }
    const std::string mask = path.substr(0, path.size() - kOwnJoints.size()) + "mask.png";
    if (fs::is_regular_file(mask)) found.back().mask = mask;
  }
  std::sort(found.begin(), found.end(),
            [](const AnnotatedImage& a, const AnnotatedImage& b) { return a.image < b.image; });
  return found;
}

NamedJoints readJointsFile(const std::string& path) {
  const JsonDocument document = JsonDocument::readFile(path);
  const JsonValue root = document.root();
  root.allowOnly({"joints", "view", "facing_deg", "style", "image_size", "annotation", "derived_from",
                  "difficulty", "extras", "circumstances"});
  const JsonValue list = root.at("joints");
  NamedJoints joints;
  for (const std::string& name : list.keys()) {
    const JsonValue place = list.at(name);
    const std::string ours = name == "torso" ? "body" : name == "hip" ? "pelvis" : name;
    const std::optional<Eigen::Vector2d> point = jointPlaceAt(place);
    // Some name a joint by both names: ours counts, unless it is open.
    const auto known =
        std::find_if(joints.begin(), joints.end(), [&](const auto& joint) { return joint.first == ours; });
    if (known == joints.end())
      joints.emplace_back(ours, point);
    else if (point && (name == ours || !known->second))
      known->second = point;
  }
  if (joints.empty()) list.fail("is empty");
  return joints;
}

void ensureJointsOf(const SkeletonTemplate& body_plan, const NamedJoints& joints, const std::string& file) {
  for (const auto& [name, place] : joints)
    if (body_plan.find(name) < 0)
      throw InputError(file, "joints." + name + ": is no joint of the template " + body_plan.name);
}

std::optional<LabelFile> placedLabelsBeside(const std::string& image) {
  const std::string path = labelFileFor(image);
  if (!fs::is_regular_file(path)) return std::nullopt;
  LabelFile labels = readLabelFile(path);
  return labels.hasPlacedJoint() ? std::optional(std::move(labels)) : std::nullopt;
}

std::vector<std::string> overrule(NamedJoints& joints, const LabelFile& labels) {
  std::vector<std::string> moved;
  for (const auto& [name, place] : labels.joints) {
    if (!labels.isPlaced(name)) continue;
    const auto known = std::find_if(joints.begin(), joints.end(),
                                    [&name = name](const auto& joint) { return joint.first == name; });
    if (known == joints.end()) {
      joints.emplace_back(name, place);
    } else if (known->second != place) {
      known->second = place;
      moved.push_back(name);
    }
  }
  return moved;
}

std::string overruledNote(const std::vector<std::string>& label_files) {
  return firstAndMore(label_files) +
         " places joints elsewhere than the joints file beside it; the label file counts";
}

std::optional<std::string> jointsFileBeside(const std::string& image) {
  const fs::path stem = fs::path(image).replace_extension();
  const std::string own = (stem.parent_path() / "joints.json").string(),
                    named = stem.string() + std::string(kJointsEnding);
  if (stem.filename() == "image" && fs::is_regular_file(own)) return own;
  return fs::is_regular_file(named) ? std::optional(named) : std::nullopt;
}

std::vector<std::string> jointNames(const NamedJoints& joints) {
  std::vector<std::string> names;
  for (const auto& joint : joints) names.push_back(joint.first);
  return names;
}

std::optional<Eigen::Vector2d> jointPlaceAt(const JsonValue& place) {
  if (place.isNull()) return std::nullopt;
  const std::vector<double> xy = place.asNumbers(2);
  if (!(std::abs(xy[0]) <= kFarthest_px && std::abs(xy[1]) <= kFarthest_px)) place.fail("lies in no picture");
  return Eigen::Vector2d(xy[0], xy[1]);
}

std::string readView(const std::string& joints_file) {
  return viewAt(JsonDocument::readFile(joints_file).root());
}

std::optional<int> readFacing(const std::string& joints_file) {
  const JsonDocument document = JsonDocument::readFile(joints_file);
  if (const auto facing = document.root().find("facing_deg"))
    return static_cast<int>(facing->asNumber(-180, 180));
  return viewAt(document.root()) == "front" ? std::optional(0) : std::nullopt;
}

Plane8 readMaskOf(const Image& image, const std::string& mask) {
  Plane8 pixels = readMask(mask);
  if (pixels.cols() != image.width || pixels.rows() != image.height)
    throw InputError(mask, "has " + sizeInPx(pixels.cols(), pixels.rows()) + " px, its drawing has " +
                               sizeInPx(image.width, image.height) +
                               "; give both the same size or remove the mask");
  return pixels;
}

Silhouette silhouetteOf(const std::string& image_path, const std::optional<std::string>& mask) {
  const Image image = readImage(image_path);
  Silhouette silhouette = mask ? silhouetteFromMask(readMaskOf(image, *mask)) : extractSilhouette(image);
  if (!silhouette.found()) throw InputError(mask.value_or(image_path), silhouette.reason);
  return silhouette;
}

LabelFile labelImage(const std::string& image, const std::optional<std::string>& mask,
                     const NamedJoints& joints, const SkeletonTemplate& body_plan,
                     const CandidateOptions& options, const std::vector<std::string>& recognized) {
  return labelFigure(silhouetteOf(image, mask), image, mask, joints, body_plan, options, recognized);
}

LabelFile labelFigure(const Silhouette& silhouette, const std::string& image,
                      const std::optional<std::string>& mask, const NamedJoints& joints,
                      const SkeletonTemplate& body_plan, const CandidateOptions& options,
                      const std::vector<std::string>& recognized) {
  const CandidateSet candidates = extractCandidates(silhouette, options);
  LabelFile labels;
  labels.image = sourceOf(image);
  labels.image_width = static_cast<int>(silhouette.mask.cols());
  labels.image_height = static_cast<int>(silhouette.mask.rows());
  if (mask) labels.mask = sourceOf(*mask);
  labels.grid_width = silhouette.grid.width;
  labels.grid_height = silhouette.grid.height;
  labels.candidates = candidates.maxima;
  labels.labels = labelFromJoints(candidates, silhouette.grid, joints, body_plan, recognized);
  labels.joints = joints;
  labels.recognized = recognized;
  return labels;
}

}  // namespace skel
