#include "labeler/document.h"

#include <algorithm>
#include <filesystem>
#include <tuple>
#include <utility>

#include "labeler/mask_brush.h"
#include "labeler/mended_joints.h"
#include "labeler/save_drawing.h"
#include "libskel/animation/clip_library.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/natural_order.h"
#include "libskel/core/sha256.h"
#include "libskel/image/read_image.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/label_from_joints.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

// Older steps are forgotten. Masks of 600×600 px make 0.4 MB each.
constexpr size_t kMostSteps = 1000;

std::string counted(size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

// The one that it plays: all limbs move in it, so that one that comes off is seen.
std::vector<Clip> clipsOfPreview(const SkeletonTemplate& body_plan) {
  for (const Clip& clip : clipsFor(builtinClips(), body_plan))
    if (clip.name == "dance" || clip.name == "wag") return {clip};
  return {};
}

}  // namespace

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
    : options_(std::move(options)), path_(path), history_(kMostSteps) {
  const auto list = [&](std::vector<DrawingFiles> drawings) {
    for (DrawingFiles& files : drawings) items_.push_back({std::move(files), {}, {}, false, {}});
  };
  if (fs::is_directory(path)) {
    list(findDrawings(path));
  } else if (path.ends_with(kSkeletonFileEnding)) {
    skeleton_.emplace(path, options_.body_plans);
    list({skeleton_->drawing()});
  } else if (path.ends_with(kMotionFileEnding)) {
    motion_.emplace(path, options_.body_plans);
    list(motion_->drawings());
    for (size_t i = 0; i < items_.size(); ++i) {
      const DrawingJoints& joints = motion_->joints(static_cast<int>(i));
      items_[i].joints = {static_cast<int>(joints.size()), countFound(joints)};
    }
  } else {
    readImage(path);
    list({drawingFiles(path, fs::path(path).filename().string())});
  }
  bool placed_joints = false;
  FormerNames names;
  for (Item& item : items_) placed_joints = takeProgress(item, names) || placed_joints;
  const bool labelled =
      std::any_of(items_.begin(), items_.end(), [](const Item& item) { return item.classes.done > 0; });
  const bool joints = editsJointsAlone() || placed_joints || !labelled;
  subject_ = joints ? Subject::kJoints : Subject::kClasses;
  loadFirst();
}

bool Document::takeProgress(Item& item, FormerNames& names) {
  if (fs::exists(item.files.mask)) given_masks_.insert(item.files.mask);
  if (motion_) return false;
  try {
    std::string hash;
    const auto image_sha256 = [&] {
      if (hash.empty()) hash = sha256(readFile(item.files.image));
      return hash;
    };
    const LabelDocument document(item.files, image_sha256, names);
    const std::optional<LabelFile>& labels = document.opened();
    if (labels) {
      item.classes = {static_cast<int>(labels->candidates.size()), countLabels(labels->labels)};
      item.joints = jointsOf(*labels, options_.body_plans);
      item.has_shape = labels->mask || fs::exists(layersFile(item.files, 1));
    }
    const bool placed = item.joints.done > 0, mended = !skeleton_ && isMendedBeside(item.files);
    if (!placed && !mended) return false;
    if (labels && image_sha256() != labels->image.sha256) {
      // Of a photo that was taken again nobody has looked at the joints.
      item.joints.done = 0;
    } else if (const auto joints =
                   mended ? mendedJointsBeside(item.files, document, image_sha256(), options_.body_plans)
                          : std::nullopt) {
      item.joints = progressOf(joints->joints, *joints->body_plan);
      return true;
    }
    return placed;
  } catch (const InputError& error) {
    item.problem = error.what();
    return false;
  }
}

int Document::lookAgain() {
  if (!fs::is_directory(path_)) return 0;
  std::vector<DrawingFiles> drawings;
  try {
    drawings = findDrawings(path_);
  } catch (const InputError& error) {
    message_ = error.what();
    return 0;
  }
  const int before = current_;
  size_t added = 0;
  FormerNames names;
  for (DrawingFiles& files : drawings) {
    const auto place = std::lower_bound(
        items_.begin(), items_.end(), files.name,
        [](const Item& item, const std::string& name) { return comesBefore(item.files.name, name); });
    if (place != items_.end() && place->files.name == files.name) continue;
    const auto at = static_cast<int>(place - items_.begin());
    takeProgress(*items_.insert(place, {std::move(files), {}, {}, false, {}}), names);
    if (at <= current_) ++current_;
    history_.forEach([at](Step& step) { step.item += at <= step.item; });
    ++added;
  }
  if (added > 0) message_ = counted(added, "picture") + " more in the folder";
  return current_ - before;
}

void Document::loadFirst() {
  std::optional<int> first;  // unfinished
  for (int i = 0; i < static_cast<int>(items_.size()); ++i) {
    if (items_[static_cast<size_t>(i)].of(subject_).isWhole()) continue;
    load(i);
    if (!image_.empty()) return;
    if (!first) first = i;
  }
  load(first.value_or(0));
}

void Document::forgetDoubts() {
  for (Item& item : items_) item.doubts.reset();
}

const std::vector<std::string>& Document::doubts(int item) {
  Item& looked_at = items_.at(static_cast<size_t>(item));
  if (!looked_at.doubts)
    looked_at.doubts = editsJointsAlone() ? std::vector<std::string>() : doubtsOf(looked_at.files);
  return *looked_at.doubts;
}

bool Document::go(int item) {
  if (open_step_) endStep();
  if (item < 0 || item >= static_cast<int>(items_.size())) return false;
  if (!save_problem_.empty() && takeOutsideChange()) save();
  if (!save_problem_.empty()) return false;
  if (item != current_) load(item);
  return true;
}

void Document::clear() {
  image_ = {};
  image_sha256_.clear();
  found_outline_.reset();
  accepts_earlier_ = false;
  labels_ = {};
  masks_ = {mutableItem().files, given_masks_.contains(mutableItem().files.mask)};
  painted_layers_ = LayerDocument(layersFile(mutableItem().files, figureNumber()));
  figure_ = std::make_shared<Figure>();
  state_ = {};
  setBodyPlan(options_.body_plans.front().name);
  plan_is_said_ = false;
  rig_ = RigDocument();
  forgetRig();
  message_.clear();
}

void Document::load(int item) {
  current_ = item;
  clear();
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
    setBodyPlan(state_.body_plan);
    figure_ = std::make_shared<Figure>();
    saved_ = state_;
  }
  if (message_.empty()) message_ = mutableItem().problem;
}

void Document::loadDrawing() {
  const DrawingFiles& files = item().files;
  const std::string bytes = readFile(files.image);
  image_ = decodeImage(bytes, files.image);
  finishSave(files.labels);
  if (!fileChangedElsewhere().empty()) {
    outdated_ = true;
    if (skeleton_) skeleton_ = SkeletonDocument(path_, options_.body_plans);
    if (motion_) motion_ = MotionDocument(path_, options_.body_plans);
    if (motion_ && motion_->drawings().size() != items_.size())
      throw InputError(path_, "has other frames than before; open it again");
  }
  noteFiles();
  if (skeleton_) skeleton_->checkSize(image_, files.image);
  if (motion_) motion_->checkSize(current_, image_, files.image);

  state_.image_sha256 = image_sha256_ = sha256(bytes);
  FormerNames names;
  if (figureNumber() == 1)
    labels_ = LabelDocument(
        files, [this] { return image_sha256_; }, names);
  takeMended();
  saved_ = state_;
}

std::vector<std::string> Document::ownFiles() const {
  std::vector<std::string> files = {item().files.labels, item().files.mask, painted_layers_.path()};
  if (editsJointsAlone()) files.push_back(path_);
  return files;
}

void Document::noteFiles() {
  for (const std::string& file : ownFiles()) on_disk_.note(file);
}

std::string Document::fileChangedElsewhere() const {
  for (const std::string& file : ownFiles())
    if (on_disk_.hasChanged(file)) return file;
  return "";
}

bool Document::takeOutsideChange() {
  try {
    if (const std::string file = fileChangedElsewhere(); !file.empty()) readAnew(file);
    return true;
  } catch (...) {
    save_problem_ = caughtError(item().files.image).what();
    return false;
  }
}

void Document::readAnew(const std::string& changed) {
  const DrawingState mine = state_, base = saved_;
  const std::shared_ptr<const Figure> my_figure = figure_;
  const std::string said = message_;
  auto before =
      std::tuple(image_, image_sha256_, labels_, masks_, painted_layers_, skeleton_, motion_, on_disk_);
  try {
    clear();
    loadDrawing();
  } catch (...) {
    std::tie(image_, image_sha256_, labels_, masks_, painted_layers_, skeleton_, motion_, on_disk_) =
        std::move(before);
    state_ = mine;
    figure_ = my_figure;
    message_ = said;
    throw;
  }
  message_ = said + (said.empty() ? "" : "; ") + fs::path(changed).filename().string() +
             " was changed elsewhere and is read anew" + merge(mine, base, my_figure);
  count();
}

const char* Document::merge(const DrawingState& mine, const DrawingState& base,
                            const std::shared_ptr<const Figure>& my_figure) {
  const char* lost = "";
  if (mine.body_plan != base.body_plan) {
    state_.body_plan = mine.body_plan;
    state_.joints = mine.joints;
    plan_is_said_ = true;
  } else if (mine.body_plan != state_.body_plan) {
    if (mine.joints != base.joints) lost = ": it has another body plan now, place its joints again";
  } else {
    for (size_t j = 0; j < mine.joints.size(); ++j) {
      if (mine.joints[j] == base.joints[j]) continue;
      const auto isPlaced = [](const auto& joint) { return joint && joint->origin == JointOrigin::kEdited; };
      const bool placed_elsewhere = isPlaced(state_.joints[j]) && state_.joints[j] != base.joints[j];
      if (isPlaced(mine.joints[j]) || !placed_elsewhere) state_.joints[j] = mine.joints[j];
    }
  }
  deriveMidpoints(state_.joints, bodyPlan());
  if (!sameFile(mine.mask.get(), base.mask.get())) {
    state_.mask = mine.mask;
    state_.labels = mine.labels;
    figure_ = my_figure;
  } else if (mine.labels != base.labels) {
    const bool same = samePlaces(my_figure->candidates.maxima, figure_->candidates.maxima);
    for (size_t i = 0; same && i < mine.labels.size(); ++i)
      if (mine.labels[i] != base.labels[i]) state_.labels[i] = mine.labels[i];
    if (!same) lost = ": it has other candidates now, label them again";
  }
  if (mine.layers != base.layers) state_.layers = mine.layers;
  if (mine.image_sha256 != base.image_sha256) state_.image_sha256 = mine.image_sha256;
  return lost;
}

bool Document::dropOutdatedSteps() {
  if (!std::exchange(outdated_, false)) return false;
  history_ = UndoHistory<Step>(kMostSteps);
  return true;
}

const SkeletonTemplate* Document::otherPlan() const {
  if (editsJointsAlone()) return nullptr;
  for (const SkeletonTemplate& plan : options_.body_plans)
    if (plan.name != bodyPlan().name) return &plan;
  return nullptr;
}

void Document::setBodyPlan(const std::string& name) {
  state_.body_plan = name;
  state_.joints.assign(bodyPlan().joints.size(), std::nullopt);
}

std::string Document::planOfFiles() const {
  if (skeleton_) return skeleton_->bodyPlan();
  if (motion_) return motion_->bodyPlan();
  if (const std::optional<LabelFile>& labels = labels_.opened(); labels && !labels->joints.empty()) {
    const SkeletonTemplate* plan = planOf(*labels, options_.body_plans);
    return plan ? plan->name : "";
  }
  const std::string beside = planOfSkeletonBeside(item().files, image_sha256_);
  return findPlan(beside, options_.body_plans) ? beside : "";
}

void Document::takeMended() {
  const DrawingFiles& files = item().files;
  const std::optional<LabelFile>& labels = labels_.opened();
  const std::string plan = planOfFiles();
  plan_is_said_ = !plan.empty();
  if (plan_is_said_) setBodyPlan(plan);
  const std::string made_for = skeleton_ ? skeleton_->imageSha256() : labels ? labels->image.sha256 : "";
  const bool changed = !motion_ && !made_for.empty() && made_for != image_sha256_;
  if (changed && !skeleton_ &&
      (labels->mask || labels->hasPlacedJoint() || fs::exists(painted_layers_.path()))) {
    if (labels->mask) masks_.areOfEarlierPicture();
    painted_layers_.areOfEarlierPicture();
    if (labels->image_width != image_.width || labels->image_height != image_.height) {
      figure_ = figureOf(image_, nullptr, 1, options_.mlp);
      state_.labels.resize(figure_->centers_px.size());
      message_ = labels->image.file + " is another picture, of another size, than the one that was mended: " +
                 "what was made for that one is left out";
      return;
    }
  }
  if (skeleton_ && skeleton_->mask()) {
    message_ = masks_.openOf(*skeleton_, image_);
  } else if (labels && labels->mask) {
    message_ = masks_.openOf(*labels, image_);
    if (labels_.isOfFormerName()) masks_.takeDrawingsName();
  } else if (figureNumber() > 1) {
    if (fs::is_regular_file(files.mask) && mayHaveShape()) masks_.open(files.mask, image_);
  } else if (const auto given = givenMask(files)) {
    if (labels)
      message_ =
          fs::path(*given).filename().string() + " lies beside the label file, which has none: not shown";
    else
      masks_.open(*given, image_);
  }
  state_.mask = masks_.opened();
  figure_ = figureOf(image_, state_.mask.get(), figureOfMask(state_.mask.get()), options_.mlp);
  message_ = labels_.take(*figure_, options_.body_plans, message_, state_);
  if (skeleton_) takeJoints(skeleton_->skeleton(), bodyPlan(), state_.joints);
  if (motion_) state_.joints = motion_->joints(current_);
  if (const auto mended = editsJointsAlone() || changed
                              ? std::nullopt
                              : mendedJointsBeside(files, labels_, image_sha256_, options_.body_plans)) {
    setBodyPlan(mended->body_plan->name);
    state_.joints = mended->joints;
    plan_is_said_ = true;
  }
  if (!motion_ && figure_->silhouette.found())
    state_.layers = painted_layers_.read(figure_->silhouette, bodyPlan());
  if (!changed) return;
  // Joints that nobody has placed are found anew.
  if (!skeleton_ && !labels->hasPlacedJoint())
    std::fill(state_.joints.begin(), state_.joints.end(), std::nullopt);
  const bool joints =
      std::any_of(state_.joints.begin(), state_.joints.end(), [](const auto& j) { return j.has_value(); });
  if (joints || state_.mask || state_.layers) state_.image_sha256 = made_for;
  message_ = fs::path(files.image).filename().string() + " has changed since it was " +
             (skeleton_ ? "rigged: " : "labelled: ") +
             (state_.mask || state_.layers ? "Shift R finds figure and joints anew"
              : joints                     ? "Shift R finds its joints anew"
                                           : "look through the labels");
}

void Document::beginStep() {
  if (open_step_) endStep();
  open_step_ = OpenStep{state_, figure_};
}

void Document::endStep() {
  if (!open_step_) return;
  DrawingState before = std::move(open_step_->before);
  open_step_.reset();
  if (state_.mask && state_.mask->png.empty()) state_.mask = sealed(*state_.mask);
  if (state_ == before) {
    state_ = before;
    return;
  }
  if (isOfEarlierPicture() && before.image_sha256 == state_.image_sha256)
    message_ += "; but the picture has changed since: Shift R, or Enter (J) if all is right for this one";
  dropOutdatedSteps();
  const bool readable = takeOutsideChange();
  if (dropOutdatedSteps()) before = saved_;
  history_.push({current_, before, state_});
  count();
  if (readable) save();
}

void Document::label(const std::vector<int>& candidates, std::optional<JointClass> label) {
  if (!mayHaveClasses()) return;
  const StepScope scope(*this);
  for (const int candidate : candidates) state_.labels.at(static_cast<size_t>(candidate)) = label;
  if (!candidates.empty())
    message_ = counted(candidates.size(), "candidate") + ": " +
               (label ? kJointClassNames[static_cast<size_t>(*label)] : "no label");
}

void Document::acceptSuggestions() {
  if (!mayHaveClasses()) return;
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
  if (!mayHaveClasses()) return;
  const StepScope scope(*this);
  const auto labels = skel::labelFromJoints(figure_->candidates, figure_->silhouette.grid,
                                            namedJoints(state_.joints, bodyPlan()), bodyPlan());
  size_t changed = 0;
  for (size_t i = 0; i < labels.size(); ++i) {
    if (!labels[i] || labels[i] == state_.labels[i]) continue;
    state_.labels[i] = labels[i];
    ++changed;
  }
  const bool any =
      std::any_of(labels.begin(), labels.end(), [](const auto& label) { return label.has_value(); });
  if (!any) {
    message_ = "there are no joints to take labels from: press R first";
    return;
  }
  message_ = counted(changed, "label") + " changed to fit the joints";
  const Progress joints = progressOf(state_.joints, bodyPlan());
  if (const int found = joints.parts - joints.done; found > 0)
    message_ += ", of which " + std::to_string(found) +
                (found == 1 ? " was found, not placed" : " were found, not placed") +
                ": look through the labels";
}

void Document::moveJoint(int joint, const Eigen::Vector2d& image_px) {
  if (image_.empty() || !(figure_->silhouette.found() || editsJointsAlone())) return;
  const StepScope scope(*this);
  // Within the picture, to the hundredth of a pixel that skeleton files keep.
  const Eigen::Vector2d low(0, 0), high(image_.width - 1, image_.height - 1);
  const Eigen::Vector2d place = (image_px.cwiseMax(low).cwiseMin(high) * 100).array().round() / 100;
  state_.joints.at(static_cast<size_t>(joint)) = PlacedJoint{place, 1, JointOrigin::kEdited};
  deriveMidpoints(state_.joints, bodyPlan());
  forgetRig();
  message_ = bodyPlan().joints[static_cast<size_t>(joint)].name + " placed by hand";
  std::replace(message_.begin(), message_.end(), '_', ' ');
}

bool Document::acceptJoints() {
  if (isOfEarlierPicture() && (state_.mask || state_.layers) && !std::exchange(accepts_earlier_, true)) {
    message_ = "of the picture before: " + earlierParts("") +
               "; look, then Enter again if all fits this one; Shift R finds all anew";
    return false;
  }
  const StepScope scope(*this);
  if (isOfEarlierPicture()) state_.image_sha256 = image_sha256_;
  size_t accepted = 0;
  for (size_t j = 0; j < state_.joints.size(); ++j) {
    auto& joint = state_.joints[j];
    if (!joint || bodyPlan().joints[j].derived) continue;
    ++accepted;
    joint = PlacedJoint{joint->image, 1, JointOrigin::kEdited};
  }
  message_ = accepted > 0 ? counted(accepted, "joint") + ": right as they are"
                          : "there are no joints: press R first";
  return true;
}

void Document::rigAnew() {
  if (image_.empty()) return;
  const StepScope scope(*this);
  const bool earlier = isOfEarlierPicture();
  const std::string what = earlierParts("joints");
  if (earlier && !forgetEarlier()) return;
  if (!editsJointsAlone()) plan_is_said_ = false;
  if (!skeleton_)
    std::fill(state_.joints.begin(), state_.joints.end(), std::nullopt);
  else if (earlier)
    for (auto& joint : state_.joints)
      if (joint) joint = PlacedJoint{joint->image, 0, JointOrigin::kCompleted};
  forgetRig();
  takeModel();
  if (earlier)
    message_ = what + " were those of the picture before: found anew, Ctrl Z brings them back; " + message_;
  else if (skeleton_)
    message_ += "; joints placed by hand stay, as a skeleton file needs all its joints";
}

void Document::takeOtherPlan() {
  const SkeletonTemplate* other = otherPlan();
  if (!other || image_.empty() || !figure_->silhouette.found()) return;
  const StepScope scope(*this);
  setBodyPlan(other->name);
  plan_is_said_ = true;
  state_.layers = nullptr;
  forgetRig();
  takeModel();
  message_ = "taken for a " + other->name + ": " + message_;
}

std::string Document::earlierParts(const std::string& also) const {
  std::string parts = also;
  for (const auto& [there, name] :
       {std::pair(state_.mask != nullptr, "mask (M)"), std::pair(state_.layers != nullptr, "limbs (G)")})
    if (there) parts += (parts.empty() ? "" : ", ") + std::string(name);
  return parts;
}

bool Document::forgetEarlier() {
  if (state_.mask && !replaceMask(nullptr)) {
    message_ = "no figure is found in this picture (" + message_ + "): paint it (M)";
    return false;
  }
  state_.labels.assign(figure_->centers_px.size(), std::nullopt);
  state_.layers = nullptr;
  state_.image_sha256 = image_sha256_;
  return true;
}

void Document::takeJointsOfFrameBefore() {
  if (!motion_ || image_.empty()) return;
  if (current_ == 0) {
    message_ = "this is the first frame";
    return;
  }
  const StepScope scope(*this);
  const Eigen::Vector2d high(image_.width - 1, image_.height - 1);
  const DrawingJoints& before = motion_->joints(current_ - 1);
  for (size_t j = 0; j < before.size(); ++j) {
    auto& joint = state_.joints[j];
    if (!before[j] || (joint && joint->origin == JointOrigin::kEdited)) continue;
    joint = PlacedJoint{before[j]->image.cwiseMin(high), 0, JointOrigin::kCompleted};
  }
  forgetRig();
  message_ = "joints as in the frame before: drag them";
}

bool Document::replaceMask(std::shared_ptr<const MaskVersion> mask) {
  auto figure = figureOf(image_, mask.get(), figureOfMask(mask.get()), options_.mlp);
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

bool Document::mayHaveShape() {
  if (figureNumber() == 1) return true;
  const fs::path mask = item().files.mask, stem = mask.parent_path() / mask.stem().stem();
  const std::optional<std::string> drawing = pictureOfStem(stem);
  if (!drawing) return true;
  message_ = "mask and limbs of figure " + std::to_string(figureNumber()) + " have the name of " +
             fs::path(*drawing).filename().string() + "'s: give that another name";
  return false;
}

int Document::figureOfMask(const MaskVersion* mask) const {
  return mask && mask->file == fs::path(item().files.mask).filename() ? 1 : figureNumber();
}

bool Document::mayHaveClasses() {
  if (figureNumber() == 1) return true;
  message_ = "classes are of the first figure of a picture, this is figure " + std::to_string(figureNumber());
  return false;
}

void Document::paintMask(const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px, double radius_px,
                         bool add) {
  changeMask(add, [&](Plane8& mask, std::uint8_t value) {
    return paintLine(mask, from_px, to_px, radius_px, value);
  });
}

void Document::paintMaskArea(const Eigen::Vector2d& at_px, bool add) {
  changeMask(add, [&](Plane8& mask, std::uint8_t value) { return paintArea(mask, image_, at_px, value); });
}

void Document::changeMask(bool add, const std::function<bool(Plane8& mask, std::uint8_t value)>& paint) {
  if (image_.empty() || !mayHaveShape()) return;
  const StepScope scope(*this);
  auto mask = std::make_shared<MaskVersion>();
  if (state_.mask && figureOfMask(state_.mask.get()) == 1)
    mask->pixels = state_.mask->pixels;
  else if (figure_->silhouette.found())
    mask->pixels = figure_->silhouette.mask;
  else
    mask->pixels = Plane8::Zero(image_.height, image_.width);
  mask->file = fs::path(item().files.mask).filename().string();
  if (!paint(mask->pixels, add ? 255 : 0)) return;
  if (replaceMask(std::move(mask)))
    message_ = std::string(add ? "added to the figure" : "erased from the figure") +
               "; R finds the joints anew that you have not placed";
}

void Document::acceptMask() {
  if (image_.empty() || !figure_->silhouette.found() || !mayHaveShape()) return;
  if (isOfEarlierPicture()) {
    acceptJoints();
    return;
  }
  message_ = "the figure: right as it is";
  if (state_.mask) {  // that lay there before: with a label file of this picture, it has been looked at
    if (takeOutsideChange()) save();
    return;
  }
  const StepScope scope(*this);
  auto mask = std::make_shared<MaskVersion>();
  mask->pixels = figure_->silhouette.mask;
  mask->file = fs::path(item().files.mask).filename().string();
  replaceMask(std::move(mask));
}

void Document::forgetMask() {
  if (!state_.mask) return;
  const StepScope scope(*this);
  if (replaceMask(nullptr)) message_ = "the figure is found in the picture again";
}

void Document::paintLayer(const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px, double radius_px,
                          const LayerBrush& brush) {
  if (image_.empty() || !figure_->silhouette.found()) return;
  if (motion_) {
    message_ = "parts of the figure are painted in drawings, not in motions";
    return;
  }
  if (!mayHaveShape()) return;
  const StepScope scope(*this);
  // One that lies there although no figure was found when the drawing was opened.
  if (!state_.layers && !painted_layers_.saved())
    state_.layers = painted_layers_.read(figure_->silhouette, bodyPlan());
  findLimbs();
  const Plane8& mask = figure_->silhouette.mask;
  auto map = layers() ? std::make_shared<LayerMap>(*layers()) : std::make_shared<LayerMap>();
  Plane8 stroke = Plane8::Zero(mask.rows(), mask.cols());
  paintLine(stroke, from_px, to_px, radius_px, 1);
  if (!paintPart(*map, stroke, mask, brush)) return;
  state_.layers = std::move(map);
  rigged_.reset();
  message_ = brush.limb == 0 ? "that is the " + brushName(brush, bodyPlan())
                             : brushName(brush, bodyPlan()) + ": before the body";
}

void Document::cutLimb(int limb) {
  if (limb < 1 || limb > 4 || motion_ || image_.empty() || !figure_->silhouette.found() || !mayHaveShape())
    return;
  const StepScope scope(*this);
  findLimbs();
  if (!layers() || layers()->part.size() == 0) return;
  auto map = std::make_shared<LayerMap>(*layers());
  const bool apart = !map->has(limb);
  cutOut(*map, limb, apart);
  const std::string name = brushName(limbBrush(limb), bodyPlan());
  if (apart && !map->has(limb)) {
    message_ = "nothing is known of the " + name + ": paint it";
    return;
  }
  state_.layers = std::move(map);
  rigged_.reset();
  message_ = name + (apart ? ": before the body, cut out" : ": one piece with the body");
}

void Document::forgetLayers() {
  if (!state_.layers) return;
  const StepScope scope(*this);
  state_.layers = nullptr;
  rigged_.reset();
  message_ = "limbs before the body are found in the picture again";
}

void Document::findLimbs() {
  if (image_.empty() || motion_ || !figure_->silhouette.found()) return;
  if (letsNetsChoose()) findJoints();  // whose limbs they are
  if (layers()) return;
  auto found = std::make_shared<LayerMap>();
  try {
    rig_.setInput(knowsAllJoints() ? inputWithJoints() : rigInput());
    rig_.setOptions(rigOptions());
    *found = rig_.layers();
  } catch (...) {
    message_ = caughtError(item().files.image).what();
  }
  found_layers_ = std::move(found);
}

void Document::forgetRig() {
  rigged_.reset();
  found_layers_.reset();
  looked_for_joints_ = false;
}

bool Document::wantsJoints() const {
  return !looked_for_joints_ && !editsJointsAlone() && figure_->silhouette.found() &&
         std::none_of(state_.joints.begin(), state_.joints.end(),
                      [](const auto& joint) { return joint.has_value(); });
}

void Document::findJoints() {
  if (!wantsJoints()) return;
  looked_for_joints_ = true;
  // Nobody has acted on what was said of the drawing.
  const std::string said = std::exchange(message_, "");
  takeModel();
  if (!said.empty()) message_ = said + "; " + message_;
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
  if (state_.layers)
    input.layers = {layerPicture(*state_.layers, figure_->silhouette.mask), painted_layers_.path()};
  return input;
}

RigOptions Document::rigOptions() const {
  RigOptions options;
  options.mlp = options_.mlp;
  options.body_plan = bodyPlan();
  options.recognizer = options_.recognizer;
  options.silhouette.figure =
      std::min(figureOfMask(state_.mask.get()), std::max(1, figure_->silhouette.figure_count));
  options.clips = clipsOfPreview(bodyPlan());
  if (letsNetsChoose()) {
    options.body_plan = options_.body_plans[0];
    options.clips = clipsOfPreview(options.body_plan);
    options.otherwise = {options_.body_plans[1], clipsOfPreview(options_.body_plans[1])};
  }
  return options;
}

bool Document::letsNetsChoose() const {
  return options_.body_plans.size() > 1 && !plan_is_said_ &&
         std::none_of(state_.joints.begin(), state_.joints.end(),
                      [](const auto& joint) { return joint && joint->origin == JointOrigin::kEdited; });
}

void Document::takeModel() {
  RigInput input = rigInput();
  for (size_t j = 0; j < state_.joints.size(); ++j)
    if (state_.joints[j] && state_.joints[j]->origin == JointOrigin::kEdited)
      input.placed.emplace_back(bodyPlan().joints[j].name, state_.joints[j]->image);
  if (!build(std::move(input))) return;
  if (rigged_->body_plan.name != state_.body_plan) setBodyPlan(rigged_->body_plan.name);
  takeJoints(rigged_->recognition.skeleton, bodyPlan(), state_.joints);
  const std::vector<std::string>& missing = rigged_->recognition.missing;
  message_ = "rigged";
  if (!missing.empty()) message_ += ": look at " + missing.front();
  if (missing.size() == 2) message_ += " and " + missing.back();
  if (missing.size() > 2) message_ += " and " + std::to_string(missing.size() - 1) + " other joints";
  std::replace(message_.begin(), message_.end(), '_', ' ');
}

bool Document::build(RigInput input) {
  try {
    rig_.setInput(std::move(input));
    rig_.setOptions(rigOptions());
    std::shared_ptr<const RiggedDrawing> rigged = rig_.rigged();
    if (!rigged->found()) {
      message_ = rigged->silhouette.reason;
      return false;
    }
    rigged_ = std::move(rigged);
  } catch (...) {
    message_ = caughtError(item().files.image).what();
    return false;
  }
  if (!state_.layers) found_layers_ = std::make_shared<LayerMap>(rigged_->layers);
  return true;
}

void Document::rigAsItIs() {
  if (image_.empty() || !knowsAllJoints()) return;
  build(inputWithJoints());
}

bool Document::knowsAllJoints() const {
  return std::all_of(state_.joints.begin(), state_.joints.end(),
                     [](const auto& joint) { return joint.has_value(); });
}

RigInput Document::inputWithJoints() const {
  RigInput input = rigInput();
  input.skeleton = presetSkeleton(bodyPlan(), {0, 0}, {1, 1});
  placeJoints(state_.joints, bodyPlan(), *input.skeleton);
  return input;
}

template <class Travel>
bool Document::throughHistory(const Travel& travel) {
  if (open_step_) endStep();
  if (!takeOutsideChange() || dropOutdatedSteps()) return false;
  const bool done = travel();
  dropOutdatedSteps();
  return done;
}

bool Document::undo() {
  return throughHistory(
      [&] { return history_.undo([&](const Step& step) { return travel(step, step.before, "undone"); }); });
}

bool Document::redo() {
  return throughHistory([&] {
    return history_.redo([&](const Step& step) { return travel(step, step.after, "done again"); });
  });
}

bool Document::travel(const Step& step, const DrawingState& target) {
  if (!go(step.item)) return false;
  if (outdated_) {
    message_ = "this drawing was changed elsewhere: steps from before cannot be undone";
    return false;
  }
  const bool same_mask = sameFile(state_.mask.get(), target.mask.get());
  const bool same_joints = state_.joints == target.joints;
  const bool same_layers = state_.layers == target.layers;
  const auto mask = same_mask ? state_.mask : target.mask;
  state_ = target;
  state_.mask = mask;
  if (!same_mask)
    figure_ = figureOf(image_, state_.mask.get(), figureOfMask(state_.mask.get()), options_.mlp);
  if (!same_mask || !same_joints) forgetRig();
  if (!same_layers) rigged_.reset();
  count();
  save();
  return true;
}

bool Document::travel(const Step& step, const DrawingState& target, const char* done) {
  const bool elsewhere = step.item != current_;
  if (!travel(step, target)) return false;
  travelled_ = worksOf(step.before, step.after);
  message_ = std::string(done) + ": " +
             describeStep(step.before, step.after, planNamed(step.after.body_plan, options_.body_plans)) +
             (elsewhere ? " of " + item().files.name : "");
  return true;
}

void Document::count() {
  Item& item = mutableItem();
  if (editsJointsAlone())
    item.joints = {static_cast<int>(state_.joints.size()), countFound(state_.joints)};
  else
    item.joints = progressOf(state_.joints, bodyPlan());
  if (isOfEarlierPicture()) item.joints.done = 0;
  item.classes = {static_cast<int>(state_.labels.size()), countLabels(state_.labels)};
  // A mask that was given is nobody's work here.
  const bool own_mask = state_.mask && (labels_.opened() || state_.mask != masks_.opened());
  item.has_shape = !editsJointsAlone() && (own_mask || state_.layers);
  if (figure_->silhouette.found()) item.problem.clear();
}

void Document::save() {
  try {
    writeFiles();
    saved_ = state_;
    save_problem_.clear();
    mutableItem().doubts.reset();
  } catch (...) {
    save_problem_ = caughtError(item().files.image).what();
  }
  noteFiles();
}

std::string Document::foundOutline() {
  const std::string& known = skeleton_->foundOutline();
  if (isOfEarlierPicture()) return known;
  if (!state_.mask) return figure_->silhouette.found() ? outlineHash(figure_->silhouette) : "";
  if (image_sha256_ == skeleton_->imageSha256() && !known.empty()) return known;
  if (!found_outline_) {
    SilhouetteOptions options;
    options.figure = figureNumber();
    const Silhouette found = extractSilhouette(image_, options);
    found_outline_ = found.found() ? outlineHash(found) : "";
  }
  return *found_outline_;
}

void Document::writeFiles() {
  painted_layers_.write(state_.layers, figure_->silhouette.mask);
  const bool same_mask = state_.mask == masks_.opened();
  if (figureNumber() > 1) masks_.writeAlone(state_.mask);
  if (skeleton_)
    skeleton_->write({state_, figure_->silhouette, foundOutline(), same_mask,
                      state_.mask ? masks_.path(*state_.mask) : "",
                      rigged_ ? &rigged_->recognition.skeleton : nullptr});
  if (motion_) motion_->write(current_, state_.joints);
  if (figureNumber() > 1) return;  // label files are of the first figure
  if (editsJointsAlone()) {
    // Who only moves joints has no use for a label file.
    const bool labelled = countLabels(state_.labels) > 0 || !same_mask;
    if (!figure_->silhouette.found() || (!labelled && !fs::is_regular_file(item().files.labels))) return;
  }
  labels_.write(state_, *figure_, image_, bodyPlan(), masks_);
}

}  // namespace skel
