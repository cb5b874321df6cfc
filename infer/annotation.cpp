#include "infer/annotation.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/json.h"
#include "libskel/core/sha256.h"
#include "libskel/image/read_image.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/labels/label_folder.h"
#include "libskel/labels/moved_in_skeleton.h"
#include "libskel/skeleton/body_plans.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

using Eigen::Vector2d;

double longSide(const Plane8& mask) {
  int x0 = static_cast<int>(mask.cols()), x1 = -1, y0 = static_cast<int>(mask.rows()), y1 = -1;
  for (int y = 0; y < mask.rows(); ++y)
    for (int x = 0; x < mask.cols(); ++x)
      if (mask(y, x)) x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
  return std::max(x1 - x0 + 1, y1 - y0 + 1);
}

bool near(const Plane8& mask, const Vector2d& p) {
  constexpr int kSlack = 2;
  const int x0 = static_cast<int>(std::nearbyint(p.x())), y0 = static_cast<int>(std::nearbyint(p.y()));
  for (int y = std::max(0, y0 - kSlack); y <= std::min<int>(static_cast<int>(mask.rows()) - 1, y0 + kSlack);
       ++y)
    for (int x = std::max(0, x0 - kSlack); x <= std::min<int>(static_cast<int>(mask.cols()) - 1, x0 + kSlack);
         ++x)
      if (mask(y, x)) return true;
  return false;
}

struct Guess {
  Vector2d point;
  double confidence;
};

// In side views which limb of a pair is the far one is a guess: the pair counts as it fits better.
void swapPairsThatFitBetter(const MeasuredDrawing& truth, const SkeletonTemplate& body_plan,
                            std::map<std::string, Guess>& guesses) {
  const auto& joints = body_plan.joints;
  for (const TemplateLimb& limb : body_plan.limbs) {
    const auto mirrored = [&](int joint) { return joints[static_cast<size_t>(joint)].mirror; };
    if (mirrored(limb.joints[0]) <= limb.joints[0]) continue;  // each pair once
    const auto cost = [&](bool swapped) {
      double sum = 0;
      for (const int joint : limb.joints) {
        for (const int at : {joint, mirrored(joint)}) {
          const auto t = truth.joints.find(joints[static_cast<size_t>(at)].name);
          const auto g = guesses.find(joints[static_cast<size_t>(swapped ? mirrored(at) : at)].name);
          if (t != truth.joints.end() && t->second && g != guesses.end())
            sum += (g->second.point - *t->second).norm();
        }
      }
      return sum;
    };
    if (cost(true) >= cost(false)) continue;
    for (const int joint : limb.joints) {
      const auto one = guesses.find(joints[static_cast<size_t>(joint)].name),
                 other = guesses.find(joints[static_cast<size_t>(mirrored(joint))].name);
      if (one != guesses.end() && other != guesses.end()) std::swap(one->second, other->second);
    }
  }
}

constexpr std::string_view kJointsEnding = ".joints.json";

// The file's name below `root` without its ending.
std::string idOf(const fs::path& file, const std::string& root, std::string_view ending) {
  const std::string name = file.lexically_relative(root).string();
  return name.substr(0, name.size() - ending.size());
}

bool isOwnFolder(const std::string& root, const std::string& id) { return fs::is_directory(root + "/" + id); }

// What its picture, joints and mask are called but for their endings.
std::string stemOf(const std::string& root, const std::string& id) {
  return root + "/" + id + (isOwnFolder(root, id) ? "/" : ".");
}

std::string labelFileOf(const std::string& root, const std::string& id) {
  return stemOf(root, id) + (isOwnFolder(root, id) ? "image.labels.json" : "labels.json");
}

// Whoever reads it says what is wrong with it.
bool holdsPlacedJoint(const std::string& label_file) {
  try {
    return readLabelFile(label_file).hasPlacedJoint();
  } catch (const InputError&) {
    return true;
  }
}

// What a person has placed in the picture that is there.
MeasuredDrawing fromLabels(const std::string& path) {
  const LabelFile labels = readLabelFile(path);
  ensureUnchanged(path, labels);
  const std::string image = besideLabelFile(path, labels.image.file);
  MeasuredDrawing drawing;
  drawing.joints_file = path;
  drawing.image = readImage(image);
  drawing.image_sha256 = labels.image.sha256;
  if (const auto mask = maskOf(path, labels)) drawing.mask = silhouetteOf(image, mask).mask;
  for (const auto& [name, place] : labels.joints)
    if (labels.isPlaced(name)) drawing.joints.emplace(name, place);
  if (const auto moved = movedInSkeleton(path, labels)) drawing.overruled_skeleton = moved->file;
  return drawing;
}

}  // namespace

std::vector<std::string> findDrawings(const std::string& root) {
  std::set<std::string> folders, ids;
  const std::vector<std::string> files = filesBelow(root);
  noteSkeletonFiles(files);
  for (const fs::path file : files) {
    if (file.filename() == "image.png" || file.filename() == "joints.json")
      folders.insert(file.lexically_relative(root).parent_path().string());
    if (file.string().ends_with(kJointsEnding)) ids.insert(idOf(file, root, kJointsEnding));
  }
  for (const fs::path file : files)
    if (file.string().ends_with(kLabelFileEnding) && file.filename() != "image.labels.json" &&
        holdsPlacedJoint(file.string()))
      ids.insert(idOf(file, root, kLabelFileEnding));
  for (const std::string& folder : folders)
    if (!ids.insert(folder).second)
      throw InputError(root + "/" + folder,
                       "is one drawing as a folder with an image.png and another as a file beside it; rename "
                       "one of them");
  if (ids.empty())
    throw InputError(root,
                     "holds no folder with an image.png, no <name>.joints.json and no <name>.labels.json of "
                     "which a person has placed a joint");
  if (const std::string name = nameOfDrawing(root, ""); ids.contains("") && ids.contains(name))
    throw InputError(root, "is one drawing as a folder with an image.png and " + name +
                               " in it another of that name; rename one of them");
  return {ids.begin(), ids.end()};
}

std::string unmeasuredAmong(const std::string& root) {
  return picturesWithout("joint that a person has placed", root, [](const std::string& image) {
    const std::string labels = labelFileFor(image);
    return fs::path(image).filename() == "image.png" || jointsFileBeside(image) ||
           (fs::is_regular_file(labels) && holdsPlacedJoint(labels));
  });
}

std::string nameOfDrawing(const std::string& root, const std::string& id) {
  if (!id.empty()) return id;
  const fs::path folder = fs::weakly_canonical(root);
  return (folder.has_filename() ? folder : folder.parent_path()).filename().string();
}

void noteMeasuredFiles(const std::string& root, const std::string& id) {
  const std::string joints = stemOf(root, id) + "joints.json", labels = labelFileOf(root, id);
  for (const std::string& name : {joints, stemOf(root, id) + "mask.png", labels}) noteInput(name);
  try {
    noteInput(imageOfJointsFile(joints));
  } catch (const InputError&) {  // told where the drawing is read
  }
  if (!fs::exists(labels)) return;
  try {
    const LabelFile file = readLabelFile(labels);
    noteInput(besideLabelFile(labels, file.image.file));
    if (const auto mask = maskOf(labels, file)) noteInput(*mask);
  } catch (const InputError&) {  // told where the drawing is read
  }
}

MeasuredDrawing readMeasuredDrawing(const std::string& root, const std::string& id) {
  const bool own_folder = isOwnFolder(root, id);
  if (!own_folder && !fs::exists(root + "/" + id + std::string(kJointsEnding))) {
    MeasuredDrawing drawing = fromLabels(root + "/" + id + kLabelFileEnding);
    drawing.id = id;
    return drawing;
  }
  const std::string stem = stemOf(root, id);
  const std::string annotation = stem + "joints.json", image = imageOfJointsFile(annotation),
                    label_file = labelFileFor(image);
  std::string mask = stem + "mask.png";
  const std::optional<LabelFile> labels = placedLabelsBeside(image);
  if (labels) {
    ensureUnchanged(label_file, *labels);
    if (labels->mask) mask = besideLabelFile(label_file, labels->mask->file);
  }
  MeasuredDrawing drawing;
  drawing.id = id;
  drawing.image = readImage(image);
  drawing.image_sha256 = sha256(readFile(image));
  if (fs::exists(mask)) {
    drawing.mask = readMask(mask);
    if (drawing.mask->cols() != drawing.image.width || drawing.mask->rows() != drawing.image.height)
      throw InputError(mask, "has another size than the picture beside it");
  }
  const bool annotated = fs::exists(annotation);
  if (!annotated && !labels) return drawing;
  if (drawing.mask && (*drawing.mask == 0).all())
    throw InputError(mask, "is blank: errors are relative to the figure's size");
  drawing.joints_file = annotated ? annotation : label_file;
  NamedJoints joints;
  if (annotated) {
    joints = readJointsFile(annotation);
    drawing.side_view = readView(annotation) == "side";
  }
  if (labels && !overrule(joints, *labels).empty()) drawing.overruled = label_file;
  if (labels && !annotated)
    if (const auto moved = movedInSkeleton(label_file, *labels)) drawing.overruled_skeleton = moved->file;
  drawing.joints.insert(joints.begin(), joints.end());
  return drawing;
}

std::string otherPlanOf(const MeasuredDrawing& drawing, const SkeletonTemplate& body_plan) {
  std::vector<std::string> visible;
  for (const auto& [name, place] : drawing.joints)
    if (place) visible.push_back(name);
  const std::string other = otherPlanWith(visible, {body_plan});
  return other == body_plan.name ? "" : other;
}

void turnClockwise(MeasuredDrawing& drawing, int quarters) {
  for (int turn = 0; turn < quarters; ++turn) {
    const Image upright = std::move(drawing.image);
    Image turned(upright.height, upright.width);
    for (int y = 0; y < upright.height; ++y)
      for (int x = 0; x < upright.width; ++x)
        std::copy_n(upright.pixel(x, y), 4, turned.pixel(upright.height - 1 - y, x));
    drawing.image = std::move(turned);
    if (drawing.mask) drawing.mask = Plane8(drawing.mask->transpose().rowwise().reverse());
    for (auto& joint : drawing.joints)
      if (joint.second) joint.second = Vector2d(upright.height - 1 - joint.second->y(), joint.second->x());
  }
}

bool isTransparent(const Image& image) { return (image.rgba.col(3) < 128).any(); }

Score score(const MeasuredDrawing& truth, const Recognition* recognition, const Plane8& silhouette_mask,
            const SkeletonTemplate& body_plan) {
  Score result;
  std::vector<std::string> scored;
  for (const TemplateJoint& joint : body_plan.joints)
    if (!joint.derived) scored.push_back(joint.name);
  const auto isEnd = [&](const std::string& name) {
    return std::any_of(body_plan.limbs.begin(), body_plan.limbs.end(), [&](const TemplateLimb& limb) {
      return body_plan.joints[static_cast<size_t>(limb.joints[2])].name == name;
    });
  };
  for (const std::string& name : scored) {
    const auto t = truth.joints.find(name);
    if (t == truth.joints.end() || !t->second) continue;
    ++result.annotated;
    if (isEnd(name)) result.limbs = 0;
  }
  if (truth.mask) result.inside = result.iou = 0;
  if (!recognition) return result;
  const double size = longSide(truth.mask ? *truth.mask : silhouette_mask);
  result.confidence = recognition->confidence;
  result.likeness = recognition->likeness;
  std::map<std::string, Guess> guesses;
  for (const Joint& joint : recognition->skeleton.joints)
    guesses[joint.name] = {joint.image, joint.confidence};
  if (truth.side_view) swapPairsThatFitBetter(truth, body_plan, guesses);

  double sum = 0, worst = 0;
  int within05 = 0, within10 = 0, within15 = 0, ends = 0, right_ends = 0, guessed = 0, inside = 0;
  for (const std::string& name : scored) {
    const auto guess = guesses.find(name);
    if (guess != guesses.end()) ++guessed, inside += truth.mask && near(*truth.mask, guess->second.point);
    const auto t = truth.joints.find(name);
    if (t == truth.joints.end() || !t->second) continue;
    const double error = guess == guesses.end() ? 1 : (guess->second.point - *t->second).norm() / size;
    sum += error;
    result.taken_over += guess != guesses.end() && isSamePlace(guess->second.point, *t->second);
    within05 += error <= 0.05;
    within10 += error <= 0.10;
    within15 += error <= 0.15;
    if (isEnd(name)) ++ends, right_ends += error <= 0.15;
    if (guess != guesses.end() && guess->second.confidence >= 0.8)
      ++result.sure, result.sure_right += error <= 0.10;
    if (error > worst) worst = error, result.worst_joint = name;
  }
  const double count = std::max(result.annotated, 1);
  result.pck05 = within05 / count;
  result.pck10 = within10 / count;
  result.error = sum / count;
  result.usable = within15 == result.annotated;
  if (ends) result.limbs = static_cast<double>(right_ends) / ends;
  if (!truth.mask) return result;
  if (guessed) result.inside = static_cast<double>(inside) / guessed;
  if (silhouette_mask.rows() == truth.mask->rows() && silhouette_mask.cols() == truth.mask->cols()) {
    const auto a = silhouette_mask > 0, b = *truth.mask > 0;
    const auto both = (a && b).count(), any = (a || b).count();
    result.iou = any ? static_cast<double>(both) / static_cast<double>(any) : 0;
  }
  return result;
}

}  // namespace skel
