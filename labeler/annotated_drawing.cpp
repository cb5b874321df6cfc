#include "labeler/annotated_drawing.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <tuple>
#include <utility>

#include "labeler/char_cfg.h"
#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/core/sha256.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/coco_of_others.h"
#include "libskel/skeleton/motion_file.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Where others leave the middle of the trunk out, it is half way between shoulders and hips.
void addBody(AnnotatedDrawing& drawing) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int known = 0;
  bool recognized = false;
  for (const auto& [name, place] : drawing.joints) {
    if (name == "body") return;
    if (!place || !(name.ends_with("_shoulder") || name.ends_with("_hip"))) continue;
    sum += *place, ++known;
    recognized = recognized || contains(drawing.recognized, name);
  }
  if (known < 4) return;
  drawing.joints.emplace_back("body", sum / 4);
  if (recognized) drawing.recognized.push_back("body");
}

AnnotatedDrawing readCharCfg(const fs::path& path, const SkeletonTemplate& body_plan) {
  const fs::path image = path.parent_path() / "texture.png", mask = path.parent_path() / "mask.png";
  for (const fs::path& needed : {image, mask})
    if (!fs::is_regular_file(needed))
      throw InputError(path.string(), "needs " + needed.filename().string() + " beside it");
  const CharCfg cfg = parseCharCfg(readFile(path.string()), path.string());
  AnnotatedDrawing drawing{path.string(), image.string(), mask.string(), {}, {}, {}};
  if (!cfg.found_mask_sha256.empty() && sha256(readFile(mask.string())) == cfg.found_mask_sha256)
    drawing.mask.reset();
  for (const auto& [theirs, ours] : charCfgJointNames())
    for (const auto& [name, point] : cfg.joints) {
      if (name != theirs || body_plan.find(ours) < 0) continue;
      drawing.joints.emplace_back(ours, point);
      if (contains(cfg.found, name)) drawing.recognized.push_back(ours);
    }
  if (drawing.joints.empty()) throw InputError(path.string(), "none of its joints is known");
  addBody(drawing);
  return drawing;
}

AnnotatedDrawing readJoints(const AnnotatedImage& annotated, const BodyPlans& plans) {
  AnnotatedDrawing drawing{
      annotated.joints, annotated.image, annotated.mask, {}, readJointsFile(annotated.joints), {}};
  ensureJointsOf(planOf(drawing.joints, plans), drawing.joints, annotated.joints);
  return drawing;
}

// Null: it is no skeleton file, or of none of the plans.
const SkeletonTemplate* planOfSkeletonFile(const std::string& path, const BodyPlans& plans) {
  return path.ends_with(kSkeletonFileEnding) ? findPlan(templateOfSkeleton(readFile(path), path), plans)
                                             : nullptr;
}

// Nothing where it is of another figure than the first: label files are of that one. `dir`: that is read.
std::optional<AnnotatedDrawing> readSkeleton(const std::string& path, const std::string& dir,
                                             const SkeletonTemplate& body_plan) {
  const SkeletonFile file = readSkeletonFile(path, body_plan);
  if (file.figure.number != 1) return std::nullopt;
  const auto beside = [&](const std::string& name) {
    return (fs::path(path).parent_path() / name).lexically_normal().string();
  };
  AnnotatedDrawing drawing{path, beside(file.image_file), std::nullopt, {}, {}, {}};
  // A name in a file leads out only to the picture that the file was made of.
  if (file.image_sha256.empty() && !liesBelow(dir, drawing.image))
    throw InputError(path, "does not know the hash of " + drawing.image + ", which lies outside of " + dir +
                               "; find its joints anew (skel-infer)");
  if (!fs::exists(drawing.image))
    throw InputError(path, "image.file: there is no " + drawing.image +
                               "; give the picture that name again, or find its joints anew (skel-infer)");
  if (!file.image_sha256.empty() && sha256(readFile(drawing.image)) != file.image_sha256)
    throw InputError(path, drawing.image + " has changed since; find its joints anew (skel-infer)");
  if (file.mask) drawing.mask = beside(file.mask->file);
  for (const Joint& joint : file.skeleton.joints) {
    drawing.joints.emplace_back(joint.name, joint.image);
    if (joint.origin != JointOrigin::kEdited) drawing.recognized.push_back(joint.name);
  }
  return drawing;
}

}  // namespace

bool isCoco(const std::string& path) {
  const std::string name = fs::path(path).filename().string();
  if (!name.ends_with(".json") || name == "joints.json") return false;
  for (const char* ending : {kLabelFileEnding, kSkeletonFileEnding, ".joints.json", kMotionFileEnding})
    if (name.ends_with(ending)) return false;
  const JsonDocument document = JsonDocument::readFile(path);
  return isCoco(document.root());
}

const SkeletonTemplate& planOf(const NamedJoints& joints, const BodyPlans& plans) {
  const SkeletonTemplate* plan = planWith(jointNames(joints), plans);
  return plan ? *plan : plans.front();
}

std::vector<AnnotatedDrawing> findAnnotatedDrawings(const std::string& dir, const BodyPlans& plans,
                                                    const OnInputError& on_error,
                                                    std::set<std::string>* passed_over) {
  std::vector<AnnotatedDrawing> drawings, exports;
  const auto attempt = [&](const auto& step) {
    try {
      step();
    } catch (const InputError& error) {
      if (!on_error) throw;
      on_error(error);
    }
  };
  std::set<std::string> annotated;  // pictures, also those whose annotation is wrong
  for (const AnnotatedImage& files : findAnnotatedImages(dir, on_error)) {
    annotated.insert(fs::path(files.image).lexically_normal().string());
    attempt([&] { drawings.push_back(readJoints(files, plans)); });
  }
  for (const fs::path file : filesBelow(dir)) {
    if (file.filename() == "char_cfg.yaml")
      attempt([&] { drawings.push_back(readCharCfg(file, plans.front())); });
    if (isCoco(file.string()))
      for (AnnotatedDrawing& drawing : readCoco(file.string(), plans, on_error))
        (drawing.is_export ? exports : drawings).push_back(std::move(drawing));
  }
  for (const AnnotatedDrawing& drawing : drawings)
    annotated.insert(fs::path(drawing.image).lexically_normal().string());
  std::set<std::string> with_skeleton;
  for (const std::string& file : filesBelow(dir))
    attempt([&] {
      const SkeletonTemplate* body_plan = planOfSkeletonFile(file, plans);
      if (!body_plan) return;
      auto drawing = readSkeleton(file, dir, *body_plan);
      if (!drawing || annotated.contains(drawing->image)) return;
      with_skeleton.insert(drawing->image);
      drawings.push_back(std::move(*drawing));
    });
  for (AnnotatedDrawing& drawing : exports) {
    const std::string image = fs::path(drawing.image).lexically_normal().string();
    if (annotated.contains(image) || with_skeleton.contains(image) || fs::exists(labelFileFor(image))) {
      if (passed_over) passed_over->insert(drawing.source);
    } else {
      drawings.push_back(std::move(drawing));
    }
  }
  std::sort(drawings.begin(), drawings.end(), [](const AnnotatedDrawing& a, const AnnotatedDrawing& b) {
    return std::tie(a.image, a.source) < std::tie(b.image, b.source);
  });
  for (size_t i = 1; i < drawings.size(); ++i)
    if (drawings[i].image == drawings[i - 1].image)
      throw InputError(drawings[i].image,
                       "is annotated twice, in " + drawings[i - 1].source + " and in " + drawings[i].source);
  return drawings;
}

Plane8 maskFromPolygons(const std::vector<Polygon>& polygons, int width, int height) {
  struct Edge {
    Eigen::Vector2d a, b;
    double top, bottom;  // rows y with top <= y < bottom cross it
  };
  std::vector<Edge> edges;
  for (const Polygon& polygon : polygons)
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double top = std::ceil(std::min(a.y(), b.y())), bottom = std::ceil(std::max(a.y(), b.y()));
      if (top < bottom) edges.push_back({a, b, top, bottom});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.top < b.top; });
  Plane8 mask = Plane8::Zero(height, width);
  std::vector<const Edge*> open;  // those that the row crosses
  std::vector<double> crossings;
  auto next = edges.begin();
  for (int y = 0; y < height; ++y) {
    for (; next != edges.end() && next->top <= y; ++next) open.push_back(&*next);
    std::erase_if(open, [&](const Edge* edge) { return edge->bottom <= y; });
    crossings.clear();
    for (const Edge* edge : open) {
      const Eigen::Vector2d &a = edge->a, &b = edge->b;
      crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(crossings.begin(), crossings.end());
    for (size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const int first = static_cast<int>(std::ceil(std::clamp(crossings[i], 0.0, double(width))));
      const int last = static_cast<int>(std::ceil(std::clamp(crossings[i + 1], 0.0, double(width))));
      if (last > first) mask.row(y).segment(first, last - first) = 255;
    }
  }
  return mask;
}

}  // namespace skel
