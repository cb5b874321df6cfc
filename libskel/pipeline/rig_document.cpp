#include "libskel/pipeline/rig_document.h"

#include <algorithm>
#include <utility>

#include "libskel/core/error.h"
#include "libskel/pipeline/rig_memory.h"
#include "libskel/pipeline/same_inputs.h"
#include "libskel/skeleton/check_skeleton.h"
#include "libskel/skeleton/mark_placed.h"

namespace skel {
RigDocument::RigDocument(RigOptions options)
    : options_(std::move(options)), memory_(std::make_unique<RigMemory>()) {}
RigDocument::~RigDocument() = default;
RigDocument::RigDocument(RigDocument&&) noexcept = default;
RigDocument& RigDocument::operator=(RigDocument&&) noexcept = default;

void RigDocument::note(RigPart part) {
  memory_->changes.note(part);
  joints_alone_ = part == RigPart::kSkeleton && (joints_alone_ || rigged_);
  rigged_.reset();
}

void RigDocument::setOptions(RigOptions options) {
  for (const RigPart part : changes(options_, options)) note(part);
  options_ = std::move(options);
}

void RigDocument::setInput(RigInput input) {
  if (input.figures) throw UsageError("RigInput::figures must be null where a RigDocument keeps the input");
  setImage(std::move(input.image));
  input_.file = std::move(input.file);
  setMask(std::move(input.mask));
  if (input.model || input_.model) note(RigPart::kModel);
  input_.model = std::move(input.model);
  if (!same(input.back, input_.back)) note(RigPart::kBack);
  input_.back = std::move(input.back);
  setLayers(std::move(input.layers));
  setSkeleton(std::move(input.skeleton), input.turned_deg);
  if (input.placed != input_.placed) note(RigPart::kSkeleton);
  input_.placed = std::move(input.placed);
}

void RigDocument::setImage(Image image) {
  if (same(image, input_.image)) return;
  const bool other = !input_.image.empty();
  note(RigPart::kImage);
  input_.image = std::move(image);
  if (!other) return;
  input_.file.clear();
  setMask(std::nullopt);
  setLayers(std::nullopt);
  setSkeleton(std::nullopt);
  input_.placed.clear();
}

void RigDocument::setMask(std::optional<Plane8> mask) {
  if (same(mask, input_.mask)) return;
  note(RigPart::kMask);
  input_.mask = std::move(mask);
}

void RigDocument::setLayers(std::optional<NamedPicture> layers) {
  if (same(layers, input_.layers)) return;
  note(RigPart::kLayers);
  input_.layers = std::move(layers);
}

void RigDocument::setSkeleton(std::optional<Skeleton> skeleton, int turned_deg) {
  if (same(skeleton, input_.skeleton) && turned_deg == input_.turned_deg) return;
  note(RigPart::kSkeleton);
  input_.skeleton = std::move(skeleton);
  input_.turned_deg = turned_deg;
}

void RigDocument::moveJoint(const std::string& name, const Eigen::Vector2d& image_px) {
  checkJointPlace(name, image_px, "RigDocument::moveJoint()");
  Skeleton skeleton;
  int turned_deg = input_.turned_deg;
  if (input_.skeleton && input_.placed.empty()) {
    skeleton = *input_.skeleton;
  } else {
    const std::shared_ptr<const RiggedDrawing> drawing = rigged();
    skeleton = drawing->recognition.skeleton;
    turned_deg = drawing->recognition.turned_deg;
  }
  const int index = skeleton.find(name);
  if (index < 0) throw UsageError("\"" + name + "\" is no joint of this figure");
  Joint& joint = skeleton.joints[static_cast<std::size_t>(index)];
  joint.image = image_px;
  joint.confidence = 1;
  joint.origin = JointOrigin::kEdited;
  if (const SkeletonTemplate& plan = planNamed(skeleton.template_name, options_);
      plan.name == skeleton.template_name)
    followPlaced(skeleton, plan);
  input_.placed.clear();  // they are where they were placed
  note(RigPart::kSkeleton);
  setSkeleton(std::move(skeleton), turned_deg);
}

std::shared_ptr<const RiggedDrawing> RigDocument::rigged() {
  if (rigged_) return rigged_;
  joints_alone_ = false;
  rigged_ =
      std::make_shared<RiggedDrawing>(rigCharacter(input_, options_, memory_.get(), options_.last, false));
  drawn_plan_ = rigged_->found() ? rigged_->recognition.skeleton.template_name : "";
  return rigged_;
}

std::shared_ptr<const RiggedDrawing> RigDocument::draft() {
  if (!joints_alone_ || !input_.skeleton || options_.last < LastStage::kModel ||
      input_.skeleton->template_name != drawn_plan_)
    return rigged();
  return std::make_shared<RiggedDrawing>(rigCharacter(input_, options_, memory_.get(), options_.last, true));
}

LayerMap RigDocument::layers() {
  if (rigged_) return rigged_->layers;
  joints_alone_ = false;  // what is kept is no longer of one figure
  return rigCharacter(input_, options_, memory_.get(), std::min(options_.last, LastStage::kLayers), false)
      .layers;
}

}  // namespace skel
