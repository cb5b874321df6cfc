#include "labeler/canvas_view.h"

#include <algorithm>
#include <cmath>

#include "libskel/draw/canvas.h"
#include "libskel/draw/color.h"

namespace skel {
namespace {

constexpr double kTouch_px = 16;  // screen; how near the mouse must come to what it means
constexpr float kDot_px = 6.5f;
constexpr float kJoint_px = 9;

ImU32 imColor(const Color& color, int alpha = 255) { return IM_COL32(color.r, color.g, color.b, alpha); }

bool isDragging(int button) { return ImGui::IsMouseDown(button); }

// Without alpha, whose hidden colours would show at the edges when the picture is scaled.
Image onWhite(const Image& image) {
  Image paper = blankImage(image.width, image.height);
  blit(paper, image, 0, 0);
  return paper;
}

}  // namespace

ImU32 imColor(std::optional<JointClass> joint_class, int alpha) {
  return imColor(joint_class ? classColor(kJointClassNames[static_cast<size_t>(*joint_class)]) : kGrey,
                 alpha);
}

Eigen::Vector2d CanvasView::imageFromScreen(const ImVec2& p) const {
  return {(p.x - view_center_.x) / zoom_ + middle_px_.x(), (p.y - view_center_.y) / zoom_ + middle_px_.y()};
}

ImVec2 CanvasView::screenFromImage(const Eigen::Vector2d& p) const {
  return {view_center_.x + static_cast<float>((p.x() - middle_px_.x()) * zoom_),
          view_center_.y + static_cast<float>((p.y() - middle_px_.y()) * zoom_)};
}

void CanvasView::zoomAround(const ImVec2& screen, double factor) {
  const Eigen::Vector2d fixed = imageFromScreen(screen);
  const double old_zoom = zoom_;
  zoom_ = std::clamp(zoom_ * factor, 0.02, 60.0);
  middle_px_ = fixed + (middle_px_ - fixed) * (old_zoom / zoom_);
}

void CanvasView::growBrush(double factor) {
  brush_screen_px_ = std::clamp(brush_screen_px_ * factor, kLeastBrush_px, kMostBrush_px);
}

void CanvasView::select(int candidate) {
  selected_ = candidate;
  touched_ = false;
  chosen_at_ = ImGui::GetIO().MousePos;
  if (candidate < 0) return;
  // Into view, if it is not.
  const ImVec2 p = screenFromImage(document_.figure().centers_px[static_cast<size_t>(candidate)]);
  if (p.x < view_corner_.x || p.y < view_corner_.y || p.x > view_corner_.x + view_size_.x ||
      p.y > view_corner_.y + view_size_.y)
    middle_px_ = document_.figure().centers_px[static_cast<size_t>(candidate)];
}

void CanvasView::cancel() {
  if (stroke_ || dragged_joint_ >= 0) document_.endStep();
  stroke_ = false;
  dragged_joint_ = -1;
  lassoing_ = false;
  lasso_.clear();
}

void CanvasView::fitNow() {
  const Image& image = document_.image();
  if (image.empty() || view_size_.x < 1 || view_size_.y < 1) return;
  zoom_ = 0.94 * std::min(static_cast<double>(view_size_.x) / image.width,
                          static_cast<double>(view_size_.y) / image.height);
  middle_px_ = {(image.width - 1) / 2.0, (image.height - 1) / 2.0};
  fitted_ = true;
}

void CanvasView::followDocument() {
  if (shown_item_ != document_.current()) {
    shown_item_ = document_.current();
    if (!document_.image().empty()) picture_.upload(onWhite(document_.image()));
    selected_ = -1;
    tinted_ = false;
    limbs_tinted_ = false;
    cancel();
    fitted_ = false;
  }
  if (selected_ >= static_cast<int>(document_.figure().centers_px.size())) selected_ = -1;
  if (!fitted_) fitNow();
}

// Dims what is outside the figure; what is in the mask but apart from the figure shows red.
void CanvasView::updateMaskTexture() {
  if (tinted_ && tinted_mask_ == document_.state().mask) return;
  tinted_ = true;
  tinted_mask_ = document_.state().mask;
  const Image& image = document_.image();
  const Plane8& figure = document_.figure().silhouette.mask;
  Image tint(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      std::uint8_t* p = tint.pixel(x, y);
      const bool inside = figure.size() > 0 && figure(y, x) != 0;
      const bool apart = !inside && tinted_mask_ && tinted_mask_->pixels(y, x) != 0;
      const std::uint8_t rgba[4] = {static_cast<std::uint8_t>(apart    ? 230
                                                              : inside ? 60
                                                                       : 24),
                                    static_cast<std::uint8_t>(apart    ? 60
                                                              : inside ? 160
                                                                       : 32),
                                    static_cast<std::uint8_t>(apart    ? 60
                                                              : inside ? 255
                                                                       : 64),
                                    static_cast<std::uint8_t>(apart    ? 130
                                                              : inside ? 56
                                                                       : 165)};
      std::copy(rgba, rgba + 4, p);
    }
  mask_tint_.upload(tint, Texture::Zoomed::kSquares);
}

// Each part in its colour, limbs paler where they are one with the body, the rest of the figure grey.
void CanvasView::updateLimbTexture() {
  document_.findLimbs();
  if (limbs_tinted_ && limb_mask_ == document_.state().mask && tinted_limbs_ == document_.layers()) return;
  limbs_tinted_ = true;
  limb_mask_ = document_.state().mask;
  tinted_limbs_ = document_.layers();
  Image tint = layerPicture(tinted_limbs_ ? *tinted_limbs_ : LayerMap(), document_.figure().silhouette.mask);
  const auto body = layerColor(0);
  for (Eigen::Index i = 0; i < tint.rgba.rows(); ++i)
    if (tint.rgba(i, 3) != 0)
      tint.rgba(i, 3) =
          tint.rgba(i, 3) < 255 || (tint.rgba(i, 0) == body[0] && tint.rgba(i, 1) == body[1]) ? 60 : 150;
  limb_tint_.upload(tint, Texture::Zoomed::kSquares);
}

void CanvasView::draw() {
  view_corner_ = ImGui::GetCursorScreenPos();
  view_size_ = ImGui::GetContentRegionAvail();
  view_size_.x = std::max(view_size_.x, 1.f);
  view_size_.y = std::max(view_size_.y, 1.f);
  view_center_ = {view_corner_.x + view_size_.x / 2, view_corner_.y + view_size_.y / 2};
  followDocument();
  ImGui::InvisibleButton("canvas", view_size_,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  const bool hovered = ImGui::IsItemHovered();
  navigate(hovered);
  if (!document_.image().empty()) useTool(hovered);

  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 end{view_corner_.x + view_size_.x, view_corner_.y + view_size_.y};
  list->PushClipRect(view_corner_, end, true);
  list->AddRectFilled(view_corner_, end, IM_COL32(222, 226, 234, 255));
  if (!document_.image().empty()) {
    drawPicture(list);
    if (tool == Tool::kTouch || tool == Tool::kBrush || tool == Tool::kLasso) drawCandidates(list);
    drawSkeleton(list);
    drawCursor(list, hovered);
  }
  list->PopClipRect();
}

void CanvasView::navigate(bool hovered) {
  const ImGuiIO& io = ImGui::GetIO();
  if (hovered && io.MouseWheel != 0) zoomAround(io.MousePos, std::pow(1.15, io.MouseWheel));
  const bool right_pans = tool != Tool::kMask && tool != Tool::kLimbs;
  if (ImGui::IsItemActive() && (isDragging(2) || (right_pans && isDragging(1))))
    middle_px_ -= Eigen::Vector2d(io.MouseDelta.x, io.MouseDelta.y) / zoom_;
}

void CanvasView::useTool(bool hovered) {
  switch (tool) {
    case Tool::kJoints:
      return useJoints(hovered);
    case Tool::kMask:
      return useMask(hovered);
    case Tool::kLimbs:
      return useLimbs(hovered);
    case Tool::kTouch:
      return useTouch(hovered);
    case Tool::kBrush:
      return useBrush(hovered);
    case Tool::kLasso:
      return useLasso(hovered);
  }
}

void CanvasView::useTouch(bool hovered) {
  const ImGuiIO& io = ImGui::GetIO();
  // A hand that rests on the mouse does not take away what N has chosen.
  const ImVec2 moved{io.MousePos.x - chosen_at_.x, io.MousePos.y - chosen_at_.y};
  if (hovered && std::hypot(moved.x, moved.y) > kTouch_px / 2) {
    const int touched = document_.candidateAt(imageFromScreen(io.MousePos), kTouch_px / zoom_);
    if (touched >= 0 || touched_) selected_ = touched;
    touched_ = touched >= 0;
  }
  if (hovered && ImGui::IsMouseClicked(0)) {
    selected_ = document_.candidateAt(imageFromScreen(io.MousePos), kTouch_px / zoom_);
    if (selected_ >= 0) document_.label({selected_}, active_class);
  }
}

void CanvasView::useBrush(bool hovered) {
  const ImGuiIO& io = ImGui::GetIO();
  if (hovered && ImGui::IsMouseClicked(0)) {
    document_.beginStep();
    stroke_ = true;
    last_px_ = imageFromScreen(io.MousePos);
  }
  if (!stroke_) return;
  // Several dabs a frame: a fast mouse leaves no gaps.
  const Eigen::Vector2d now = imageFromScreen(io.MousePos);
  const double radius_px = brush_screen_px_ / zoom_;
  const int dabs = 1 + static_cast<int>((now - last_px_).norm() / (radius_px / 2));
  std::set<int> touched;
  for (int i = 1; i <= dabs; ++i)
    for (const int candidate : document_.candidatesNear(last_px_ + (now - last_px_) * i / dabs, radius_px))
      touched.insert(candidate);
  document_.label({touched.begin(), touched.end()}, active_class);
  last_px_ = now;
  if (isDragging(0)) return;
  cancel();
}

void CanvasView::useLasso(bool hovered) {
  const Eigen::Vector2d now = imageFromScreen(ImGui::GetIO().MousePos);
  if (hovered && ImGui::IsMouseClicked(0)) {
    lasso_ = {now};
    lassoing_ = true;
  }
  if (!lassoing_) return;
  if ((now - lasso_.back()).norm() * zoom_ > 3) lasso_.push_back(now);
  if (isDragging(0)) return;
  if (lasso_.size() >= 3) document_.label(document_.candidatesInside(lasso_), active_class);
  cancel();
}

void CanvasView::useJoints(bool hovered) {
  const Eigen::Vector2d now = imageFromScreen(ImGui::GetIO().MousePos);
  if (hovered && ImGui::IsMouseClicked(0)) {
    dragged_joint_ = document_.jointAt(now, 1.5 * kTouch_px / zoom_);
    if (dragged_joint_ >= 0) {
      document_.beginStep();
      last_px_ = now;
    }
  }
  if (dragged_joint_ < 0) return;
  // By as much as the mouse moves, so that a joint does not jump when it is taken at its rim.
  if (now != last_px_)
    document_.moveJoint(dragged_joint_, document_.state().joints[static_cast<size_t>(dragged_joint_)]->image +
                                            now - last_px_);
  last_px_ = now;
  if (isDragging(0)) return;
  cancel();
}

template <class Value, class Paint>
void CanvasView::strokeWith(bool hovered, Value left, Value right, Value& value, const Paint& paint) {
  const Eigen::Vector2d now = imageFromScreen(ImGui::GetIO().MousePos);
  const bool with_left = ImGui::IsMouseClicked(0), with_right = ImGui::IsMouseClicked(1);
  const bool starts = hovered && (with_left || with_right) && !stroke_;
  if (starts) {
    document_.beginStep();
    stroke_ = true;
    value = with_left ? left : right;
    last_px_ = now;
  }
  if (!stroke_) return;
  if (starts || now != last_px_) paint(last_px_, now, brush_screen_px_ / zoom_, value);
  last_px_ = now;
  if (isDragging(0) || isDragging(1)) return;
  cancel();
}

void CanvasView::useMask(bool hovered) {
  const ImGuiIO& io = ImGui::GetIO();
  if (!stroke_ && mask_fills != io.KeyShift) {
    for (const int button : {0, 1})
      if (hovered && ImGui::IsMouseClicked(button))
        document_.paintMaskArea(imageFromScreen(io.MousePos), (button == 0) == mask_adds);
    return;
  }
  strokeWith(hovered, mask_adds, !mask_adds, stroke_adds_,
             [&](const auto& from, const auto& to, double radius_px, bool add) {
               document_.paintMask(from, to, radius_px, add);
             });
}

void CanvasView::useLimbs(bool hovered) {
  strokeWith(hovered, layer_brush, limbBrush(0), stroke_part_,
             [&](const auto& from, const auto& to, double radius_px, const LayerBrush& brush) {
               document_.paintLayer(from, to, radius_px, brush);
             });
}

void CanvasView::drawPicture(ImDrawList* list) {
  const Image& image = document_.image();
  const ImVec2 low = screenFromImage({-0.5, -0.5}),
               high = screenFromImage({image.width - 0.5, image.height - 0.5});
  list->AddRectFilled({low.x + 4, low.y + 5}, {high.x + 4, high.y + 5}, IM_COL32(0, 0, 0, 24));
  list->AddRectFilled(low, high, IM_COL32_WHITE);
  list->AddImage(picture_.id(), low, high);
  // A mask of the photo before is seen at once.
  if (tool == Tool::kMask ||
      (tool == Tool::kJoints && document_.isOfEarlierPicture() && document_.state().mask)) {
    updateMaskTexture();
    list->AddImage(mask_tint_.id(), low, high);
    drawMaskEdge(list);
  } else if (tool == Tool::kLimbs && document_.figure().silhouette.found()) {
    updateLimbTexture();
    list->AddImage(limb_tint_.id(), low, high);
  } else {
    // Steps back behind the discs.
    list->AddRectFilled(low, high, IM_COL32(255, 255, 255, 70));
  }
}

// Light within dark: it shows on every ground.
void CanvasView::drawMaskEdge(ImDrawList* list) {
  constexpr float kStep_px = 1.5f;           // screen; closer corners make no other line
  constexpr std::size_t kMostAtOnce = 4096;  // corners: what ImGui draws at once has 65536 vertices at most
  for (const Polygon& polygon : document_.figure().silhouette.outline) {
    std::vector<ImVec2> points;
    for (const Eigen::Vector2d& corner : polygon) {
      const ImVec2 p = screenFromImage(corner);
      if (points.empty() || std::hypot(p.x - points.back().x, p.y - points.back().y) > kStep_px)
        points.push_back(p);
    }
    points.push_back(points.front());
    for (const auto& [color, width] :
         {std::pair(IM_COL32(0, 0, 0, 255), 4.f), std::pair(IM_COL32_WHITE, 1.8f)})
      for (std::size_t i = 0; i + 1 < points.size(); i += kMostAtOnce)
        list->AddPolyline(&points[i], static_cast<int>(std::min(kMostAtOnce + 1, points.size() - i)), color,
                          ImDrawFlags_None, width);
  }
}

void CanvasView::drawCandidates(ImDrawList* list) {
  const Figure& figure = document_.figure();
  const auto radius = [&](size_t i) {
    return static_cast<float>(figure.candidates.maxima[i].radius / figure.silhouette.grid.scale * zoom_);
  };
  const auto& labels = document_.state().labels;
  for (const int index : figure.candidates.kept) {
    const auto i = static_cast<size_t>(index);
    const ImVec2 p = screenFromImage(figure.centers_px[i]);
    list->AddCircleFilled(p, radius(i), imColor(labels[i], 62), 48);
    list->AddCircle(p, radius(i), imColor(labels[i], 170), 48, 1.5f);
  }
  for (size_t i = 0; i < labels.size(); ++i) {
    const ImVec2 p = screenFromImage(figure.centers_px[i]);
    list->AddCircleFilled(p, kDot_px, IM_COL32(255, 255, 255, 235), 20);
    list->AddCircleFilled(p, kDot_px - 1.5f, imColor(labels[i], 255), 20);
  }
  if (selected_ < 0 || tool != Tool::kTouch) return;
  const auto i = static_cast<size_t>(selected_);
  const ImVec2 p = screenFromImage(figure.centers_px[i]);
  list->AddCircle(p, std::max(radius(i), kDot_px + 3), imColor(kInk, 230), 48, 2.5f);
  list->AddCircleFilled(p, kDot_px + 2, imColor(kInk), 20);
  list->AddCircleFilled(p, kDot_px - 1, labels[i] ? imColor(labels[i]) : imColor(figure.suggestions[i]), 20);
  const std::string what = labels[i]
                               ? kJointClassNames[static_cast<size_t>(*labels[i])]
                               : std::string(kJointClassNames[static_cast<size_t>(figure.suggestions[i])]) +
                                     "? " + std::to_string(std::lround(100 * figure.certainties[i])) + " %";
  const ImVec2 size = ImGui::CalcTextSize(what.c_str());
  const ImVec2 at{p.x + 16, p.y - size.y - 12};
  list->AddRectFilled({at.x - 8, at.y - 4}, {at.x + size.x + 8, at.y + size.y + 4},
                      IM_COL32(255, 255, 255, 240), 6);
  list->AddText(at, labels[i] ? imColor(labels[i]) : imColor(kInk), what.c_str());
}

void CanvasView::drawSkeleton(ImDrawList* list) {
  const auto& joints = document_.state().joints;
  const bool strong = tool == Tool::kJoints;
  const int alpha = strong ? 255 : 120;
  for (size_t j = 0; j < joints.size(); ++j) {
    const TemplateJoint& joint = document_.bodyPlan().joints[j];
    if (!joints[j] || joint.parent < 0 || !joints[static_cast<size_t>(joint.parent)]) continue;
    list->AddLine(screenFromImage(joints[static_cast<size_t>(joint.parent)]->image),
                  screenFromImage(joints[j]->image), imColor(sideColor(joint.name), alpha),
                  strong ? 5.f : 3.f);
  }
  if (!strong) return;
  const int touched = dragged_joint_ >= 0 ? dragged_joint_
                                          : document_.jointAt(imageFromScreen(ImGui::GetIO().MousePos),
                                                              1.5 * kTouch_px / zoom_);
  for (size_t j = 0; j < joints.size(); ++j) {
    if (!joints[j]) continue;
    const ImVec2 p = screenFromImage(joints[j]->image);
    const bool is_touched = static_cast<int>(j) == touched;
    const float r = is_touched ? 1.4f * kJoint_px : kJoint_px;
    list->AddCircleFilled(p, r + 2, imColor(kWhite), 32);
    list->AddCircleFilled(p, r, imColor(sideColor(document_.bodyPlan().joints[j].name)), 32);
    // What a person has not placed yet is hollow, with a question mark where it was not found either.
    const bool guessed = joints[j]->origin == JointOrigin::kCompleted;
    if (joints[j]->origin != JointOrigin::kEdited) list->AddCircleFilled(p, r - 4, imColor(kWhite), 32);
    if (guessed) {
      const ImVec2 size = ImGui::CalcTextSize("?");
      list->AddText({p.x - size.x / 2, p.y - size.y / 2}, imColor(kInk), "?");
    }
    if (!is_touched) continue;
    std::string name = document_.bodyPlan().joints[j].name;
    std::replace(name.begin(), name.end(), '_', ' ');
    if (guessed) name += ": not found, a likely place";
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    const ImVec2 at{p.x + 18, p.y - size.y - 12};
    list->AddRectFilled({at.x - 8, at.y - 4}, {at.x + size.x + 8, at.y + size.y + 4},
                        IM_COL32(255, 255, 255, 240), 6);
    list->AddText(at, imColor(kInk), name.c_str());
  }
}

void CanvasView::drawCursor(ImDrawList* list, bool hovered) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const auto radius = static_cast<float>(brush_screen_px_);
  if (hovered && tool == Tool::kBrush) {
    list->AddCircleFilled(mouse, radius, imColor(active_class, 50), 48);
    list->AddCircle(mouse, radius, imColor(active_class), 48, 2.5f);
  }
  const auto ring = [&](ImU32 color) {
    list->AddCircle(mouse, radius, IM_COL32_WHITE, 48, 4);
    list->AddCircle(mouse, radius, color, 48, 2.5f);
  };
  if (hovered && tool == Tool::kMask) {
    const bool adds = stroke_ ? stroke_adds_ : mask_adds;
    if (!stroke_ && mask_fills != ImGui::GetIO().KeyShift) {
      list->AddCircleFilled(mouse, 4, adds ? IM_COL32(30, 140, 60, 255) : IM_COL32(210, 50, 40, 255));
      list->AddCircle(mouse, 5, IM_COL32_WHITE, 0, 1.5f);
      return;
    }
    ring(adds ? IM_COL32(30, 140, 60, 255) : IM_COL32(210, 50, 40, 255));
  }
  if (hovered && tool == Tool::kLimbs) {
    const auto rgb = brushColor(stroke_ ? stroke_part_ : layer_brush);
    ring(IM_COL32(rgb[0], rgb[1], rgb[2], 255));
  }
  if (lassoing_) {
    std::vector<ImVec2> points;
    for (const Eigen::Vector2d& p : lasso_) points.push_back(screenFromImage(p));
    list->AddPolyline(points.data(), static_cast<int>(points.size()), imColor(active_class),
                      ImDrawFlags_Closed, 3);
  }
}

}  // namespace skel
