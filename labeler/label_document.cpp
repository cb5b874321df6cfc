#include "labeler/label_document.h"

#include <filesystem>

#include "labeler/placed_joints.h"
#include "labeler/save_drawing.h"
#include "libskel/labels/annotated_image.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

std::string leftOut(const LabelFile& labels, const BodyPlans& plans) {
  const std::string theirs = otherPlanWith(jointNames(labels.joints), plans);
  return "the label file has a " + theirs + "'s joints, not a " + plans.front().name +
         "'s: not shown, and the next step replaces them; --template " + theirs + ", or auto, shows them";
}

}  // namespace

LabelDocument::LabelDocument(DrawingFiles files, const std::function<std::string()>& image_sha256,
                             FormerNames& names)
    : files_(std::move(files)), path_(files_.labels) {
  const fs::path folder = fs::path(files_.image).parent_path();
  if (fs::is_regular_file(path_)) opened_ = readLabelFile(path_);
  if ((opened_ && !opened_->isBlank()) || !names.hasLabelsAlone(folder)) return;
  const std::string former = formerLabels(files_.image, image_sha256(), names);
  if (!former.empty()) opened_ = readLabelFile(path_ = former);
}

std::string LabelDocument::take(const Figure& figure, const BodyPlans& plans, std::string said,
                                DrawingState& state) const {
  state.labels.resize(figure.centers_px.size());
  if (!opened_) return said;
  if (isOfFormerName() && said.empty())
    said = "as in " + fs::path(path_).filename().string() + ", made when the picture was called " +
           opened_->image.file;
  if (const SkeletonTemplate* plan = planOf(*opened_, plans))
    takeJoints(*opened_, *plan, state.joints);
  else if (opened_->hasPlacedJoint())
    said = leftOut(*opened_, plans) + (said.empty() ? "" : "; ") + said;
  if (samePlaces(opened_->candidates, figure.candidates.maxima)) {
    state.labels = opened_->labels;
  } else if (figure.silhouette.found()) {
    state.labels = carriedLabels(figure, opened_->candidates, opened_->labels);
    if (said.empty()) said = "the candidates are not those of the label file: look through the labels";
  }
  return said;
}

void LabelDocument::write(const DrawingState& state, const Figure& figure, const Image& image,
                          const SkeletonTemplate& body_plan, MaskDocument& masks) const {
  LabelFile labels;
  labels.image = {std::filesystem::path(files_.image).filename().string(), state.image_sha256};
  labels.image_width = image.width;
  labels.image_height = image.height;
  labels.grid_width = figure.silhouette.grid.width;
  labels.grid_height = figure.silhouette.grid.height;
  labels.candidates = figure.candidates.maxima;
  labels.labels = state.labels;
  labels.joints = namedJoints(state.joints, body_plan);
  for (size_t j = 0; j < state.joints.size(); ++j)
    if (state.joints[j] && state.joints[j]->origin != JointOrigin::kEdited)
      labels.recognized.push_back(body_plan.joints[j].name);
  if (state.mask) labels.mask = LabelFile::Source{state.mask->file, state.mask->sha256};
  masks.write(state.mask, labels);
}

}  // namespace skel
