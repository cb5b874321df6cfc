#include "labeler/label_document.h"

#include <filesystem>

#include "labeler/placed_joints.h"
#include "labeler/save_drawing.h"

namespace skel {

LabelDocument::LabelDocument(DrawingFiles files) : files_(std::move(files)) {
  if (std::filesystem::is_regular_file(files_.labels)) opened_ = readLabelFile(files_.labels);
}

std::string LabelDocument::take(const Figure& figure, const SkeletonTemplate& body_plan, std::string said,
                                DrawingState& state) const {
  state.labels.resize(figure.centers_px.size());
  if (!opened_) return said;
  takeJoints(*opened_, body_plan, state.joints);
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
