#include "labeler/document.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "labeler/mask_brush.h"
#include "labeler/save_drawing.h"
#include "libskel/animation/clip_library.h"
#include "libskel/classifier/features.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/labels/label_from_joints.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

// Older steps are forgotten. Masks of 600×600 px make 0.4 MB each.
constexpr size_t kMostSteps = 1000;

std::shared_ptr<const Figure> figureOf(Silhouette silhouette, const Mlp& mlp) {
  auto figure = std::make_shared<Figure>();
  figure->silhouette = std::move(silhouette);
  if (!figure->silhouette.found()) return figure;
  figure->candidates = extractCandidates(figure->silhouette);
  const ClassProbabilities classes = classify(mlp, features(figure->candidates));
  for (Eigen::Index i = 0; i < classes.rows(); ++i) {
    const JointCandidate& candidate = figure->candidates.maxima[static_cast<size_t>(i)];
    figure->centers_px.push_back(figure->silhouette.grid.imageFromGrid({candidate.x, candidate.y}));
    Eigen::Index best = 0;
    figure->certainties.push_back(classes.row(i).maxCoeff(&best));
    figure->suggestions.push_back(static_cast<JointClass>(best));
  }
  return figure;
}

// `number`: which figure of the picture, or of the mask, if that holds so many: one that was painted for a
// figure holds that one alone.
std::shared_ptr<const Figure> figureOf(const Image& image, const MaskVersion* mask, int number,
                                       const Mlp& mlp) {
  SilhouetteOptions options;
  options.figure = number;
  if (!mask) return figureOf(extractSilhouette(image, options), mlp);
  Silhouette silhouette = silhouetteFromMask(mask->pixels, options);
  if (!silhouette.found() && number > 1) silhouette = silhouetteFromMask(mask->pixels);
  return figureOf(std::move(silhouette), mlp);
}

// A candidate takes over the label of the nearest old one in whose disc it lies.
std::vector<std::optional<JointClass>> carriedLabels(
    const std::vector<Eigen::Vector2d>& centers_px, const std::vector<Eigen::Vector2d>& old_centers_px,
    const std::vector<double>& old_radii_px, const std::vector<std::optional<JointClass>>& old_labels) {
  std::vector<std::optional<JointClass>> labels;
  for (const Eigen::Vector2d& center : centers_px) {
    auto& label = labels.emplace_back();
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < old_centers_px.size(); ++i) {
      const double distance = (old_centers_px[i] - center).norm();
      if (distance > old_radii_px[i] || distance >= nearest) continue;
      nearest = distance;
      label = old_labels[i];
    }
  }
  return labels;
}

std::vector<std::optional<JointClass>> carriedLabels(
    const Figure& figure, const Figure& old_figure,
    const std::vector<std::optional<JointClass>>& old_labels) {
  std::vector<double> radii_px;
  for (const JointCandidate& candidate : old_figure.candidates.maxima)
    radii_px.push_back(candidate.radius / old_figure.silhouette.grid.scale);
  return carriedLabels(figure.centers_px, old_figure.centers_px, radii_px, old_labels);
}

bool samePlaces(const std::vector<JointCandidate>& a, const std::vector<JointCandidate>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const JointCandidate& p, const JointCandidate& q) {
                      return p.x == q.x && p.y == q.y && p.radius == q.radius;
                    });
}

std::shared_ptr<const MaskVersion> readMaskVersion(const std::string& path, const Image& image) {
  auto mask = std::make_shared<MaskVersion>();
  mask->pixels = readMaskOf(image, path);
  mask->file = fs::path(path).filename().string();
  mask->png = readFile(path);
  mask->sha256 = sha256(mask->png);
  return mask;
}

bool sameFile(const MaskVersion* a, const MaskVersion* b) {
  return a == b || (a && b && a->file == b->file && a->sha256 == b->sha256);
}

// The mask of a finished stroke, as a file.
std::shared_ptr<const MaskVersion> sealed(const MaskVersion& stroke) {
  auto mask = std::make_shared<MaskVersion>(stroke);
  mask->png = encodePng(mask->pixels);
  mask->sha256 = sha256(mask->png);
  return mask;
}

std::string counted(size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

NamedJoints namedJoints(const std::vector<std::optional<PlacedJoint>>& joints,
                        const SkeletonTemplate& body_plan) {
  NamedJoints named;
  if (std::none_of(joints.begin(), joints.end(), [](const auto& joint) { return joint.has_value(); }))
    return named;
  for (size_t j = 0; j < joints.size(); ++j) {
    if (joints[j])
      named.emplace_back(body_plan.joints[j].name, joints[j]->image);
    else if (!body_plan.joints[j].derived)
      named.emplace_back(body_plan.joints[j].name, std::nullopt);
  }
  return named;
}

// Joints half way between two others follow them, unless a person has placed them.
void deriveMidpoints(std::vector<std::optional<PlacedJoint>>& joints, const SkeletonTemplate& body_plan) {
  for (size_t j = 0; j < joints.size(); ++j) {
    const auto& derived = body_plan.joints[j].derived;
    if (!derived || derived->rule != DerivationRule::kMidpoint) continue;
    if (joints[j] && joints[j]->origin == JointOrigin::kEdited) continue;
    const auto& a = joints[static_cast<size_t>(derived->from[0])];
    const auto& b = joints[static_cast<size_t>(derived->from[1])];
    if (a && b)
      joints[j] = PlacedJoint{(a->image + b->image) / 2, std::min(a->confidence, b->confidence),
                              JointOrigin::kDerived};
  }
}

// Puts the skeleton's joints where those are that are known.
void placeJoints(const std::vector<std::optional<PlacedJoint>>& joints, const SkeletonTemplate& body_plan,
                 Skeleton& skeleton) {
  for (Joint& joint : skeleton.joints) {
    const auto& place = joints[static_cast<size_t>(body_plan.find(joint.name))];
    if (!place) continue;
    joint.image = place->image;
    joint.confidence = place->confidence;
    joint.origin = place->origin;
  }
}

int countLabels(const std::vector<std::optional<JointClass>>& labels) {
  return static_cast<int>(
      std::count_if(labels.begin(), labels.end(), [](const auto& label) { return label.has_value(); }));
}

// Joints that nobody has to look for any more.
int countFound(const std::vector<std::optional<PlacedJoint>>& joints) {
  return static_cast<int>(std::count_if(joints.begin(), joints.end(), [](const auto& joint) {
    return joint && joint->origin != JointOrigin::kCompleted;
  }));
}

Progress progressOf(const LabelFile& labels) {
  return {static_cast<int>(labels.candidates.size()), countLabels(labels.labels)};
}

// Of what a label file of a drawing says about joints.
Progress jointsOf(const LabelFile& labels, const SkeletonTemplate& body_plan) {
  Progress progress;
  for (const auto& [name, place] : labels.joints) {
    const int j = body_plan.find(name);
    if (j < 0 || !place || body_plan.joints[static_cast<size_t>(j)].derived) continue;
    ++progress.parts;
    progress.done += labels.isPlaced(name);
  }
  return progress;
}

std::string besideFile(const std::string& file, const std::string& name) {
  return (fs::path(file).parent_path() / name).lexically_normal().string();
}

int nearest(const std::vector<std::optional<Eigen::Vector2d>>& points, const Eigen::Vector2d& to,
            double radius) {
  int best = -1;
  for (size_t i = 0; i < points.size(); ++i) {
    if (!points[i] || (*points[i] - to).norm() > radius) continue;
    best = static_cast<int>(i);
    radius = (*points[i] - to).norm();
  }
  return best;
}

// A file that says where joints are in a picture must mean this picture.
template <class Claim>
void checkSize(const Image& image, const std::string& image_path, const Claim& claim,
               const std::string& claim_path, const std::string& place) {
  const auto size = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  if (claim.image_width != image.width || claim.image_height != image.height)
    throw InputError(claim_path, place + ": has " + size(claim.image_width, claim.image_height) + " px, " +
                                     image_path + " has " + size(image.width, image.height) +
                                     "; find the joints anew");
}

bool isInside(const Eigen::Vector2d& p, const Polygon& polygon) {
  bool inside = false;
  for (size_t i = 0, k = polygon.size() - 1; i < polygon.size(); k = i++) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[k];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

}  // namespace

bool DrawingState::operator==(const DrawingState& other) const {
  const bool same_mask = mask == other.mask || (mask && other.mask && mask->file == other.mask->file &&
                                                (mask->pixels == other.mask->pixels).all());
  const bool same_layers =
      layers == other.layers || (layers && other.layers && layers->limb.size() == other.layers->limb.size() &&
                                 (layers->limb == other.layers->limb).all());
  return same_mask && same_layers && labels == other.labels && joints == other.joints;
}

// Makes an action a step of its own unless one is open.
class Document::StepScope {
 public:
  explicit StepScope(Document& document) : document_(document), outermost_(!document.open_step_) {
    if (outermost_) document_.beginStep();
  }
  ~StepScope() {
    if (outermost_) document_.endStep();
  }
  StepScope(const StepScope&) = delete;
  StepScope& operator=(const StepScope&) = delete;

 private:
  Document& document_;
  bool outermost_;
};

Document::Document(const std::string& path, DocumentOptions options)
    : options_(std::move(options)), path_(path) {
  if (fs::is_directory(path)) {
    for (DrawingFiles& files : findDrawings(path)) items_.push_back({std::move(files), {}, {}, {}});
  } else if (path.ends_with(kSkeletonFileEnding)) {
    skeleton_file_ = readSkeletonFile(path, options_.body_plan);
    items_.push_back({drawingFiles(besideFile(path, skeleton_file_->image_file),
                                   fs::path(skeleton_file_->image_file).filename().string()),
                      {},
                      {},
                      {}});
  } else if (path.ends_with(kMotionFileEnding)) {
    motion_file_ = readMotionFile(path, options_.body_plan);
    for (const MotionFrame& frame : motion_file_->frames) {
      if (frame.image_file.empty())
        throw InputError(path, "has frames without a picture; it was computed, mend what it was made from");
      items_.push_back({drawingFiles(besideFile(path, frame.image_file), frame.image_file),
                        {static_cast<int>(frame.joints.size()), countFound(frame.joints)},
                        {},
                        {}});
    }
  } else {
    readImage(path);
    items_.push_back({drawingFiles(path, fs::path(path).filename().string()), {}, {}, {}});
  }
  for (Item& item : items_) {
    if (fs::exists(item.files.mask)) given_masks_.insert(item.files.mask);
    if (motion_file_ || !fs::is_regular_file(item.files.labels)) continue;
    try {
      const LabelFile labels = readLabelFile(item.files.labels);
      item.classes = progressOf(labels);
      item.joints = jointsOf(labels, options_.body_plan);
    } catch (const InputError& error) {
      item.problem = error.what();
    }
  }
  const auto any = [&](Subject subject) {
    return std::any_of(items_.begin(), items_.end(),
                       [&](const Item& item) { return item.of(subject).done > 0; });
  };
  const bool joints = skeleton_file_ || motion_file_ || any(Subject::kJoints) || !any(Subject::kClasses);
  subject_ = joints ? Subject::kJoints : Subject::kClasses;
  const auto unfinished = std::find_if(items_.begin(), items_.end(),
                                       [&](const Item& item) { return !item.of(subject_).isWhole(); });
  load(unfinished == items_.end() ? 0 : static_cast<int>(unfinished - items_.begin()));
}

int Document::figureNumber() const { return skeleton_file_ ? skeleton_file_->figure.number : 1; }

bool Document::go(int item) {
  if (open_step_) endStep();
  if (item < 0 || item >= static_cast<int>(items_.size())) return false;
  if (!save_problem_.empty()) save();
  if (!save_problem_.empty()) return false;
  if (item != current_) load(item);
  return true;
}

void Document::load(int item) {
  current_ = item;
  image_ = {};
  image_sha256_.clear();
  figure_ = std::make_shared<Figure>();
  state_ = {};
  state_.joints.resize(options_.body_plan.joints.size());
  opened_mask_ = saved_mask_ = nullptr;
  saved_layers_ = nullptr;
  forgetRig();
  message_.clear();
  try {
    loadDrawing();
    mutableItem().problem = figure_->silhouette.found() ? "" : figure_->silhouette.reason;
    count();
  } catch (...) {
    mutableItem().problem = caughtError(this->item().files.image).what();
    // What cannot be read must not be written over: nothing can be done here.
    image_ = {};
    state_.mask = nullptr;
    state_.layers = nullptr;
    state_.labels.clear();
    state_.joints.assign(options_.body_plan.joints.size(), std::nullopt);
    figure_ = std::make_shared<Figure>();
  }
  if (message_.empty()) message_ = mutableItem().problem;
}

void Document::loadDrawing() {
  const DrawingFiles& files = item().files;
  const std::string bytes = readFile(files.image);
  image_ = decodeImage(bytes, files.image);
  image_sha256_ = sha256(bytes);
  finishSave(files.labels);

  if (skeleton_file_) checkSize(image_, files.image, *skeleton_file_, path_, "image");
  if (motion_file_)
    checkSize(image_, files.image, motion_file_->frames[static_cast<size_t>(current_)], path_,
              "frames[" + std::to_string(current_) + "].image");

  std::optional<LabelFile> labels;
  if (fs::is_regular_file(files.labels)) labels = readLabelFile(files.labels);
  if (skeleton_file_ && skeleton_file_->mask) {
    loadSkeletonsMask();
  } else if (labels && labels->mask) {
    saved_mask_ = readMaskVersion(besideLabelFile(files.labels, labels->mask->file), image_);
    if (saved_mask_->sha256 != labels->mask->sha256)
      message_ = labels->mask->file + " has changed since it was labelled: look through the labels";
  } else if (const auto given = givenMask(files); !labels && given) {
    saved_mask_ = readMaskVersion(*given, image_);
  }
  if (!opened_mask_) opened_mask_ = saved_mask_;
  state_.mask = opened_mask_;
  figure_ = figureOf(image_, state_.mask.get(), figureNumber(), options_.mlp);
  state_.labels.resize(figure_->centers_px.size());
  if (labels) {
    if (labels->image.sha256 != image_sha256_)
      message_ = labels->image.file + " has changed since it was labelled: look through the labels";
    for (const auto& [name, place] : labels->joints)
      if (const int j = options_.body_plan.find(name); j >= 0 && place)
        state_.joints[static_cast<size_t>(j)] = PlacedJoint{*place, 1, JointOrigin::kEdited};
    for (const std::string& name : labels->recognized)
      if (const int j = options_.body_plan.find(name); j >= 0)
        state_.joints[static_cast<size_t>(j)]->origin = JointOrigin::kRecognized;
    if (samePlaces(labels->candidates, figure_->candidates.maxima)) {
      state_.labels = labels->labels;
    } else if (figure_->silhouette.found()) {
      const WorkingGrid& grid = figure_->silhouette.grid;
      std::vector<Eigen::Vector2d> centers_px;
      std::vector<double> radii_px;
      for (const JointCandidate& candidate : labels->candidates) {
        centers_px.push_back(grid.imageFromGrid({candidate.x, candidate.y}));
        radii_px.push_back(candidate.radius / grid.scale);
      }
      state_.labels = carriedLabels(figure_->centers_px, centers_px, radii_px, labels->labels);
      if (message_.empty())
        message_ = "the candidates are not those of the label file: look through the labels";
    }
  }
  if (skeleton_file_) {
    for (const Joint& joint : skeleton_file_->skeleton.joints)
      state_.joints[static_cast<size_t>(options_.body_plan.find(joint.name))] =
          PlacedJoint{joint.image, joint.confidence, joint.origin};
  }
  if (motion_file_) state_.joints = motion_file_->frames[static_cast<size_t>(current_)].joints;
  readLayers();
}

void Document::loadSkeletonsMask() {
  const DrawingFiles& files = item().files;
  const std::string path = besideFile(path_, skeleton_file_->mask->file);
  auto mask = std::make_shared<MaskVersion>(*readMaskVersion(path, image_));
  if (mask->sha256 != skeleton_file_->mask->sha256)
    message_ = path + " has changed since the skeleton was found: look through the joints";
  std::error_code not_there;
  // Label files speak of masks in their own folder only: with labels a mask from elsewhere is saved there.
  const bool beside = fs::equivalent(path, besideFile(files.image, mask->file), not_there);
  if (!beside) mask->file = fs::path(files.mask).filename().string();
  if (!beside && fs::exists(files.mask) && readFile(files.mask) != mask->png)
    throw InputError(files.mask,
                     "is not the mask that " + path_ + " was made with, " + path + "; take one of them away");
  opened_mask_ = mask;
  if (beside || fs::exists(files.mask)) saved_mask_ = mask;
}

void Document::beginStep() {
  if (open_step_) endStep();
  open_step_ = OpenStep{state_, figure_};
}

void Document::endStep() {
  if (!open_step_) return;
  const DrawingState before = std::move(open_step_->before);
  open_step_.reset();
  if (state_.mask && state_.mask->png.empty()) state_.mask = sealed(*state_.mask);
  if (state_ == before) {
    state_ = before;
    return;
  }
  undo_.push_back({current_, before, state_});
  if (undo_.size() > kMostSteps) undo_.pop_front();
  redo_.clear();
  count();
  save();
}

void Document::label(const std::vector<int>& candidates, std::optional<JointClass> label) {
  const StepScope scope(*this);
  for (const int candidate : candidates) state_.labels.at(static_cast<size_t>(candidate)) = label;
  if (!candidates.empty())
    message_ = counted(candidates.size(), "candidate") + ": " +
               (label ? kJointClassNames[static_cast<size_t>(*label)] : "no label");
}

void Document::acceptSuggestions() {
  const StepScope scope(*this);
  size_t accepted = 0;
  for (size_t i = 0; i < state_.labels.size(); ++i) {
    if (state_.labels[i]) continue;
    state_.labels[i] = figure_->suggestions[i];
    ++accepted;
  }
  message_ = counted(accepted, "suggestion") + " accepted";
}

void Document::labelFromJoints() {
  const StepScope scope(*this);
  const auto labels =
      skel::labelFromJoints(figure_->candidates, figure_->silhouette.grid,
                            namedJoints(state_.joints, options_.body_plan), options_.body_plan);
  size_t changed = 0;
  for (size_t i = 0; i < labels.size(); ++i) {
    if (!labels[i] || labels[i] == state_.labels[i]) continue;
    state_.labels[i] = labels[i];
    ++changed;
  }
  const bool any =
      std::any_of(labels.begin(), labels.end(), [](const auto& label) { return label.has_value(); });
  message_ = any ? counted(changed, "label") + " changed to fit the joints"
                 : "there are no joints to take labels from: press R first";
}

void Document::moveJoint(int joint, const Eigen::Vector2d& image_px) {
  if (image_.empty() || !(figure_->silhouette.found() || skeleton_file_ || motion_file_)) return;
  const StepScope scope(*this);
  // Within the picture, to the hundredth of a pixel that skeleton files keep.
  const Eigen::Vector2d low(0, 0), high(image_.width - 1, image_.height - 1);
  const Eigen::Vector2d place = (image_px.cwiseMax(low).cwiseMin(high) * 100).array().round() / 100;
  state_.joints.at(static_cast<size_t>(joint)) = PlacedJoint{place, 1, JointOrigin::kEdited};
  deriveMidpoints(state_.joints, options_.body_plan);
  forgetRig();
  message_ = options_.body_plan.joints[static_cast<size_t>(joint)].name + " placed by hand";
  std::replace(message_.begin(), message_.end(), '_', ' ');
}

void Document::acceptJoints() {
  const StepScope scope(*this);
  size_t accepted = 0;
  for (size_t j = 0; j < state_.joints.size(); ++j) {
    auto& joint = state_.joints[j];
    if (!joint || options_.body_plan.joints[j].derived) continue;
    ++accepted;
    joint = PlacedJoint{joint->image, 1, JointOrigin::kEdited};
  }
  message_ = accepted > 0 ? counted(accepted, "joint") + ": right as they are"
                          : "there are no joints: press R first";
}

void Document::forgetJoints() {
  if (skeleton_file_) {
    message_ = "a skeleton file needs all its joints";
    return;
  }
  const StepScope scope(*this);
  std::fill(state_.joints.begin(), state_.joints.end(), std::nullopt);
  forgetRig();
  message_ = "all joints forgotten: R finds them anew";
}

void Document::takeJointsOfFrameBefore() {
  if (!motion_file_ || image_.empty()) return;
  if (current_ == 0) {
    message_ = "this is the first frame";
    return;
  }
  const StepScope scope(*this);
  const Eigen::Vector2d high(image_.width - 1, image_.height - 1);
  const auto& before = motion_file_->frames[static_cast<size_t>(current_) - 1].joints;
  for (size_t j = 0; j < before.size(); ++j) {
    auto& joint = state_.joints[j];
    if (!before[j] || (joint && joint->origin == JointOrigin::kEdited)) continue;
    joint = PlacedJoint{before[j]->image.cwiseMin(high), 0, JointOrigin::kCompleted};
  }
  forgetRig();
  message_ = "joints as in the frame before: drag them";
}

bool Document::replaceMask(std::shared_ptr<const MaskVersion> mask) {
  auto figure = figureOf(image_, mask.get(), figureNumber(), options_.mlp);
  if (!figure->silhouette.found()) {
    message_ = "that would leave no figure: " + figure->silhouette.reason;
    return false;
  }
  // From what was there before the whole stroke, so that labels do not wander off in many small moves.
  state_.labels = carriedLabels(*figure, *open_step_->figure, open_step_->before.labels);
  figure_ = std::move(figure);
  state_.mask = std::move(mask);
  forgetRig();
  return true;
}

void Document::paintMask(const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px, double radius_px,
                         bool add) {
  if (image_.empty()) return;
  const StepScope scope(*this);
  auto mask = std::make_shared<MaskVersion>();
  if (state_.mask)
    mask->pixels = state_.mask->pixels;
  else if (figure_->silhouette.found())
    mask->pixels = figure_->silhouette.mask;
  else
    mask->pixels = Plane8::Zero(image_.height, image_.width);
  mask->file = fs::path(item().files.mask).filename().string();
  if (!paintLine(mask->pixels, from_px, to_px, radius_px, add ? 255 : 0)) return;
  if (replaceMask(std::move(mask))) message_ = add ? "added to the figure" : "erased from the figure";
}

void Document::forgetMask() {
  if (!state_.mask) return;
  const StepScope scope(*this);
  if (replaceMask(nullptr)) message_ = "the figure is found in the picture again";
}

void Document::paintLayer(const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px, double radius_px,
                          int limb) {
  if (image_.empty() || !figure_->silhouette.found()) return;
  if (motion_file_) {
    message_ = "limbs before the body are painted in drawings, not in motions";
    return;
  }
  const StepScope scope(*this);
  // One that lies there although no figure was found when the drawing was opened.
  if (!state_.layers && !saved_layers_) readLayers();
  findLimbs();
  const Plane8& mask = figure_->silhouette.mask;
  auto map = std::make_shared<LayerMap>();
  if (const auto known = layers(); known && known->any())
    map->limb = known->limb;
  else
    map->limb = Plane8::Zero(mask.rows(), mask.cols());
  const bool changed = paintLine(map->limb, from_px, to_px, radius_px, static_cast<std::uint8_t>(limb));
  map->limb = (mask != 0).select(map->limb, 0);
  if (!changed) return;
  state_.layers = std::move(map);
  rigged_.reset();
  message_ = limb == 0 ? "that is the body" : limbName(options_.body_plan, limb) + ": before the body";
}

void Document::forgetLayers() {
  if (!state_.layers) return;
  const StepScope scope(*this);
  state_.layers = nullptr;
  rigged_.reset();
  message_ = "limbs before the body are found in the picture again";
}

void Document::findLimbs() {
  if (layers() || image_.empty() || motion_file_ || !figure_->silhouette.found()) return;
  auto found = std::make_shared<LayerMap>();
  try {
    RigInput input = rigInput();
    if (std::all_of(state_.joints.begin(), state_.joints.end(),
                    [](const auto& j) { return j.has_value(); })) {
      input.skeleton = presetSkeleton(options_.body_plan, {0, 0}, {1, 1});
      placeJoints(state_.joints, options_.body_plan, *input.skeleton);
    }
    RigOptions options = rigOptions();
    options.last = LastStage::kLayers;
    *found = rigCharacter(std::move(input), options).layers;
  } catch (...) {
    message_ = caughtError(item().files.image).what();
  }
  found_layers_ = std::move(found);
}

std::string Document::layersPath() const { return layersFile(item().files, figureNumber()); }

void Document::readLayers() {
  const std::string path = layersPath();
  if (motion_file_ || !figure_->silhouette.found() || !fs::is_regular_file(path)) return;
  state_.layers = saved_layers_ = std::make_shared<LayerMap>(
      layersOfPicture(readImage(path), figure_->silhouette, options_.body_plan, path));
}

void Document::forgetRig() {
  rigged_.reset();
  found_layers_.reset();
  looked_for_joints_ = false;
}

bool Document::wantsJoints() const {
  return !looked_for_joints_ && !skeleton_file_ && !motion_file_ && figure_->silhouette.found() &&
         std::none_of(state_.joints.begin(), state_.joints.end(),
                      [](const auto& joint) { return joint.has_value(); });
}

void Document::findJoints() {
  if (!wantsJoints()) return;
  looked_for_joints_ = true;
  takeModel();
  count();
}

void Document::rig() {
  if (image_.empty()) return;
  const StepScope scope(*this);
  takeModel();
}

RigInput Document::rigInput() const {
  RigInput input;
  input.image = image_;
  if (state_.mask) input.mask = state_.mask->pixels;
  if (state_.layers) input.layers = {layerPicture(*state_.layers, figure_->silhouette.mask), layersPath()};
  return input;
}

RigOptions Document::rigOptions() const {
  RigOptions options;
  options.mlp = options_.mlp;
  options.body_plan = options_.body_plan;
  options.recognizer = options_.recognizer;
  options.silhouette.figure = std::min(figureNumber(), std::max(1, figure_->silhouette.figure_count));
  // The one clip that the preview plays.
  for (const Clip& clip : clipsFor(builtinClips(), options_.body_plan))
    if (clip.name == "wave" || clip.name == "wag") options.clips = {clip};
  return options;
}

void Document::takeModel() {
  RigInput input = rigInput();
  for (size_t j = 0; j < state_.joints.size(); ++j)
    if (state_.joints[j] && state_.joints[j]->origin == JointOrigin::kEdited)
      input.placed.emplace_back(options_.body_plan.joints[j].name, state_.joints[j]->image);
  try {
    auto rigged = std::make_unique<RiggedDrawing>(rigCharacter(std::move(input), rigOptions()));
    if (!rigged->found()) {
      message_ = rigged->silhouette.reason;
      return;
    }
    rigged_ = std::move(rigged);
  } catch (...) {
    message_ = caughtError(item().files.image).what();
    return;
  }
  for (const Joint& joint : rigged_->recognition.skeleton.joints)
    state_.joints[static_cast<size_t>(options_.body_plan.find(joint.name))] =
        PlacedJoint{joint.image, joint.confidence, joint.origin};
  if (!state_.layers) found_layers_ = std::make_shared<LayerMap>(rigged_->layers);
  const std::vector<std::string>& missing = rigged_->recognition.missing;
  message_ = "rigged";
  if (!missing.empty()) message_ += ": look at " + missing.front();
  if (missing.size() == 2) message_ += " and " + missing.back();
  if (missing.size() > 2) message_ += " and " + std::to_string(missing.size() - 1) + " other joints";
  std::replace(message_.begin(), message_.end(), '_', ' ');
}

bool Document::undo() { return travel(undo_, redo_, &Step::before); }
bool Document::redo() { return travel(redo_, undo_, &Step::after); }

bool Document::travel(std::deque<Step>& from, std::deque<Step>& to, DrawingState Step::*target) {
  if (open_step_) endStep();
  if (from.empty() || !go(from.back().item)) return false;
  const Step step = std::move(from.back());
  from.pop_back();
  const bool same_mask = sameFile(state_.mask.get(), (step.*target).mask.get());
  const bool same_joints = state_.joints == (step.*target).joints;
  const bool same_layers = state_.layers == (step.*target).layers;
  const auto mask = same_mask ? state_.mask : (step.*target).mask;
  state_ = step.*target;
  state_.mask = mask;
  if (!same_mask) figure_ = figureOf(image_, state_.mask.get(), figureNumber(), options_.mlp);
  if (!same_mask || !same_joints) forgetRig();
  if (!same_layers) rigged_.reset();
  message_ = &from == &undo_ ? "undone" : "done again";
  to.push_back(step);
  count();
  save();
  return true;
}

Progress Document::jointProgress() const {
  if (skeleton_file_ || motion_file_)
    return {static_cast<int>(state_.joints.size()), countFound(state_.joints)};
  Progress progress;
  for (size_t j = 0; j < state_.joints.size(); ++j) {
    if (!state_.joints[j] || options_.body_plan.joints[j].derived) continue;
    ++progress.parts;
    progress.done += state_.joints[j]->origin == JointOrigin::kEdited;
  }
  return progress;
}

void Document::count() {
  Item& item = mutableItem();
  item.joints = jointProgress();
  item.classes = {static_cast<int>(state_.labels.size()), countLabels(state_.labels)};
  if (figure_->silhouette.found()) item.problem.clear();
}

void Document::save() {
  try {
    writeFiles();
    save_problem_.clear();
  } catch (...) {
    save_problem_ = caughtError(item().files.image).what();
  }
}

void Document::writeFiles() {
  const DrawingFiles& files = item().files;
  writeLayers();
  if (skeleton_file_) writeSkeletonFile();
  if (motion_file_) writeMotionFile();
  if (skeleton_file_ || motion_file_) {
    // Who only moves joints has no use for a label file.
    const bool labelled = countLabels(state_.labels) > 0 || state_.mask != opened_mask_;
    if (!figure_->silhouette.found() || (!labelled && !fs::is_regular_file(files.labels))) return;
  }
  LabelFile labels;
  labels.image = {fs::path(files.image).filename().string(), image_sha256_};
  labels.image_width = image_.width;
  labels.image_height = image_.height;
  labels.grid_width = figure_->silhouette.grid.width;
  labels.grid_height = figure_->silhouette.grid.height;
  labels.candidates = figure_->candidates.maxima;
  labels.labels = state_.labels;
  labels.joints = namedJoints(state_.joints, options_.body_plan);
  for (size_t j = 0; j < state_.joints.size(); ++j)
    if (state_.joints[j] && state_.joints[j]->origin != JointOrigin::kEdited)
      labels.recognized.push_back(options_.body_plan.joints[j].name);
  if (state_.mask) labels.mask = LabelFile::Source{state_.mask->file, state_.mask->sha256};

  const bool mended = state_.mask && state_.mask != saved_mask_ &&
                      state_.mask->file == fs::path(files.mask).filename().string();
  if (mended) {
    saveWithMask(files.labels, labels, state_.mask->png);
    saved_mask_ = state_.mask;
    return;
  }
  writeLabelFile(files.labels, labels);
  // A mask that was undone altogether; one that had been there before stays.
  if (!state_.mask && saved_mask_ && besideLabelFile(files.labels, saved_mask_->file) == files.mask &&
      !given_masks_.contains(files.mask)) {
    removeFile(files.mask);
    saved_mask_ = nullptr;
  }
}

void Document::writeSkeletonFile() {
  SkeletonFile file = *skeleton_file_;
  placeJoints(state_.joints, options_.body_plan, file.skeleton);
  for (Joint& joint : file.skeleton.joints) {
    const auto& place = state_.joints[static_cast<size_t>(options_.body_plan.find(joint.name))];
    if (!place) continue;
    if (place->origin == JointOrigin::kEdited) std::erase(file.missing, joint.name);
    // Joints that were found anew must not look as if somebody had moved them.
    if (rigged_)
      for (const Joint& lifted : rigged_->recognition.skeleton.joints)
        if (lifted.name == joint.name && lifted.image == joint.image) joint.position = lifted.position;
  }
  if (const Silhouette& silhouette = figure_->silhouette; silhouette.found()) {
    file.figure.number = std::min(figureNumber(), silhouette.figure_count);
    file.figure.sha256 = outlineHash(silhouette);
  }
  if (!state_.mask)
    file.mask.reset();
  else if (file.mask && state_.mask == opened_mask_)
    file.mask->sha256 = state_.mask->sha256;  // it may have changed since
  else
    file.mask = SkeletonFile::Mask{pathSeenFrom(path_, besideFile(item().files.image, state_.mask->file)),
                                   state_.mask->sha256};
  // What was said of joints before somebody moved them is stale.
  if (std::any_of(file.skeleton.joints.begin(), file.skeleton.joints.end(),
                  [](const Joint& joint) { return joint.origin == JointOrigin::kEdited; }))
    file.warnings.clear();
  replaceFile(path_, formatSkeletonFile(file));
}

void Document::writeLayers() {
  if (state_.layers == saved_layers_) return;
  const std::string path = layersPath();
  if (state_.layers)
    replaceFile(path, encodePng(layerPicture(*state_.layers, figure_->silhouette.mask)));
  else
    removeFile(path);
  saved_layers_ = state_.layers;
}

void Document::writeMotionFile() {
  motion_file_->frames[static_cast<size_t>(current_)].joints = state_.joints;
  replaceFile(path_, formatMotionFile(*motion_file_, options_.body_plan));
}

int Document::mostUnsure() const {
  int best = -1;
  for (size_t i = 0; i < state_.labels.size(); ++i)
    if (!state_.labels[i] &&
        (best < 0 || figure_->certainties[i] < figure_->certainties[static_cast<size_t>(best)]))
      best = static_cast<int>(i);
  return best;
}

int Document::candidateAt(const Eigen::Vector2d& image_px, double radius_px) const {
  const int centre = nearest({figure_->centers_px.begin(), figure_->centers_px.end()}, image_px, radius_px);
  if (centre >= 0) return centre;
  int best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  for (const int index : figure_->candidates.kept) {
    const auto i = static_cast<size_t>(index);
    const double distance = (figure_->centers_px[i] - image_px).norm();
    const double disc_px = figure_->candidates.maxima[i].radius / figure_->silhouette.grid.scale;
    if (distance > disc_px || distance >= best_distance) continue;
    best = index;
    best_distance = distance;
  }
  return best;
}

int Document::jointAt(const Eigen::Vector2d& image_px, double radius_px) const {
  std::vector<std::optional<Eigen::Vector2d>> points;
  for (const auto& joint : state_.joints)
    points.push_back(joint ? std::optional<Eigen::Vector2d>(joint->image) : std::nullopt);
  return nearest(points, image_px, radius_px);
}

std::vector<int> Document::candidatesNear(const Eigen::Vector2d& image_px, double radius_px) const {
  std::vector<int> found;
  for (size_t i = 0; i < figure_->centers_px.size(); ++i)
    if ((figure_->centers_px[i] - image_px).norm() <= radius_px) found.push_back(static_cast<int>(i));
  return found;
}

std::vector<int> Document::candidatesInside(const Polygon& lasso) const {
  std::vector<int> found;
  for (size_t i = 0; i < figure_->centers_px.size(); ++i)
    if (isInside(figure_->centers_px[i], lasso)) found.push_back(static_cast<int>(i));
  return found;
}

}  // namespace skel
