#include "animator/stage_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "animator/orbit.h"
#include "libskel/draw/color.h"

namespace skel {
namespace {

constexpr double kTouch_px = 14, kRing_px = 74, kRingReach_px = 8;
// Further than this is a drag, not a click.
constexpr float kClick_px = 4;
constexpr ImU32 kAxisColors[] = {IM_COL32(222, 62, 62, 255), IM_COL32(40, 160, 72, 255),
                                 IM_COL32(44, 104, 222, 255)};

ImU32 faded(ImU32 color, int alpha) { return (color & ~IM_COL32_A_MASK) | ImU32(alpha) << IM_COL32_A_SHIFT; }

}  // namespace

void StageView::fit() { framed_ = Framed(); }

void StageView::frame() {
  std::vector<Clip> shown;
  if (document_.clip()) shown.push_back(*document_.clip());
  camera_ = filmCamera(*shown_, shown, camera_.yaw_rad, camera_.pitch_rad, double(width_) / double(height_));
}

void StageView::zoomBy(double factor) {
  zoom(camera_, factor, 0, 0, std::max(1, height_));
  framed_.reset();
}

void StageView::lookFrom(int quarter) {
  camera_.yaw_rad = quarter * std::numbers::pi / 2;
  camera_.pitch_rad = 0;
  if (framed_) fit();
}

bool StageView::isSeenFrom(int quarter) const {
  constexpr double kSame_rad = 1e-3;
  const double off_rad =
      std::remainder(camera_.yaw_rad - quarter * std::numbers::pi / 2, 2 * std::numbers::pi);
  return std::abs(off_rad) < kSame_rad && std::abs(camera_.pitch_rad) < kSame_rad;
}

Eigen::Vector2d StageView::mouse() const {
  const ImVec2 p = ImGui::GetIO().MousePos;
  return {double(p.x - corner_.x) - 0.5, double(p.y - corner_.y) - 0.5};
}

void StageView::followDocument() {
  const auto& character = document_.state().character;
  if (shown_ != character) {
    const bool another_mesh = !shown_ || shown_->mesh.vertices.rows() != character->mesh.vertices.rows();
    shown_ = character;
    scene_ = std::make_unique<Scene>(*shown_, softwarePainter(shown_->mesh));
    if (another_mesh) fit();
  }
  const Framed now{shown_, document_.state().clip, width_, height_};
  if (!framed_ || *framed_ == now) return;
  frame();
  framed_ = now;
}

void StageView::draw(const ImVec2& size) {
  corner_ = ImGui::GetCursorScreenPos();
  width_ = std::max(16, int(size.x)), height_ = std::max(16, int(size.y));
  followDocument();
  ImGui::InvisibleButton("stage", {float(width_), float(height_)},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  useMouse(ImGui::IsItemHovered());

  Look shown = look;
  shown.background = {238, 241, 247};
  shown.chosen = -1;
  shown.weights_of = weights ? document_.chosen() : -1;
  picture_.upload(scene_->paint(document_.posed(), camera_, width_, height_, shown));
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddImageRounded(picture_.id(), corner_, {corner_.x + float(width_), corner_.y + float(height_)},
                        {0, 0}, {1, 1}, IM_COL32_WHITE, 8);
  list->PushClipRect(corner_, {corner_.x + float(width_), corner_.y + float(height_)}, true);
  drawHandles(list);
  list->PopClipRect();
}

void StageView::useMouse(bool hovered) {
  const ImGuiIO& io = ImGui::GetIO();
  const Projection projection(camera_, width_, height_);
  const int chosen = document_.chosen();
  has_rings_ = handles && chosen >= 0;
  if (has_rings_)
    rings_ = jointRings(document_.skeleton(), document_.posed(), chosen, projection, camera_, kRing_px);

  const bool idle = !grip_ && !orbits_ && !pans_;
  touched_ = hovered && idle ? document_.jointAt(mouse(), projection, kTouch_px) : -1;
  touched_axis_ = grip_ ? grip_->axis : -1;
  if (hovered && idle && has_rings_ && touched_ < 0)
    if (const auto found = grip(rings_, mouse(), kRingReach_px)) touched_axis_ = found->axis;

  if (hovered && ImGui::IsMouseClicked(0)) {
    dragged_px_ = 0;
    if (has_rings_ && touched_ < 0) grip_ = grip(rings_, mouse(), kRingReach_px);
    if (grip_) {
      turned_rad_ = 0;
      document_.beginStep();
    } else {
      orbits_ = true;
    }
  }
  if (hovered && (ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2))) pans_ = true;
  dragged_px_ += std::hypot(io.MouseDelta.x, io.MouseDelta.y);

  if (grip_) {
    // Shift: steps of 15 degrees.
    double angle = grip_->angleTo(mouse());
    constexpr double kStep_rad = std::numbers::pi / 12;
    if (io.KeyShift) angle = std::round(angle / kStep_rad) * kStep_rad;
    if (angle != turned_rad_) document_.turnJoint(chosen, grip_->axis, angle - turned_rad_);
    turned_rad_ = angle;
    if (!ImGui::IsMouseDown(0)) {
      grip_.reset();
      document_.endStep();
    }
  }
  if (orbits_) {
    if (dragged_px_ > kClick_px) orbit(camera_, double(io.MouseDelta.x), double(io.MouseDelta.y), height_);
    if (!ImGui::IsMouseDown(0)) {
      orbits_ = false;
      if (dragged_px_ <= kClick_px) document_.choose(document_.jointAt(mouse(), projection, kTouch_px));
    }
  }
  if (pans_) {
    framed_.reset();
    pan(camera_, double(io.MouseDelta.x), double(io.MouseDelta.y), height_);
    pans_ = ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2);
  }
  if (hovered && io.MouseWheel != 0) {
    framed_.reset();
    zoom(camera_, std::pow(1.15, double(io.MouseWheel)), mouse().x() - width_ / 2.0,
         mouse().y() - height_ / 2.0, height_);
  }
}

void StageView::drawHandles(ImDrawList* list) {
  const Projection projection(camera_, width_, height_);
  const JointTransforms posed = document_.posed();
  const std::vector<Eigen::Vector3f> joints = posedJoints(document_.skeleton(), posed);
  const auto screen = [&](const Eigen::Vector2d& p) {
    return ImVec2(corner_.x + float(p.x()) + 0.5f, corner_.y + float(p.y()) + 0.5f);
  };
  const auto at = [&](int joint) {
    return screen(
        projection(joints[std::size_t(joint)].cast<double>()).value_or(Eigen::Vector2d(-1e4, -1e4)));
  };
  const auto disc = [&](int joint, float radius) {
    const Color c = sideColor(document_.skeleton().joints[std::size_t(joint)].name);
    list->AddCircleFilled(at(joint), radius + 2.5f, IM_COL32_WHITE);
    list->AddCircleFilled(at(joint), radius, IM_COL32(c.r, c.g, c.b, 255));
  };
  if (has_rings_) {
    rings_ = jointRings(document_.skeleton(), posed, document_.chosen(), projection, camera_, kRing_px);
    for (const bool front : {false, true})
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Ring& ring = rings_[axis];
        const bool held = touched_axis_ == int(axis);
        for (std::size_t i = 0; i < ring.points.size(); ++i) {
          if (ring.in_front[i] != front) continue;
          const ImVec2 a = screen(ring.points[i]), b = screen(ring.points[(i + 1) % ring.points.size()]);
          if (front) list->AddLine(a, b, faded(IM_COL32_WHITE, 150), held ? 8.f : 5.5f);
          list->AddLine(a, b, faded(kAxisColors[axis], front ? 255 : 90), front ? (held ? 5.5f : 3.f) : 1.5f);
        }
      }
  }
  if (document_.chosen() >= 0) disc(document_.chosen(), 7);
  if (touched_ >= 0) {
    disc(touched_, 7);
    const std::string& name = document_.skeleton().joints[std::size_t(touched_)].name;
    const ImVec2 p = at(touched_), size = ImGui::CalcTextSize(name.c_str());
    list->AddRectFilled({p.x + 14, p.y - size.y / 2 - 4}, {p.x + 26 + size.x, p.y + size.y / 2 + 4},
                        IM_COL32(255, 255, 255, 235), 6);
    list->AddText({p.x + 20, p.y - size.y / 2}, ImGui::GetColorU32(ImGuiCol_Text), name.c_str());
  }
  if (grip_) {
    char text[32];
    std::snprintf(text, sizeof text, "%+.0f\xc2\xb0", turned_rad_ * 180 / std::numbers::pi);
    const ImVec2 p = ImGui::GetIO().MousePos;
    const ImVec2 size = ImGui::CalcTextSize(text);
    list->AddRectFilled({p.x + 16, p.y + 8}, {p.x + 28 + size.x, p.y + 16 + size.y},
                        IM_COL32(255, 255, 255, 235), 6);
    list->AddText({p.x + 22, p.y + 12}, kAxisColors[grip_->axis], text);
  }
}

}  // namespace skel
