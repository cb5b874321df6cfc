// The middle of the window: the drawing with its candidates, joints and mask, and what the mouse does there.
#pragma once

#include <imgui.h>

#include <optional>
#include <set>
#include <string>

#include "labeler/document.h"
#include "libskel/window/window.h"

namespace skel {

// The last three are for the candidates' classes.
enum class Tool { kJoints, kMask, kLimbs, kTouch, kBrush, kLasso };
inline constexpr int kToolCount = 6;
inline constexpr double kLeastBrush_px = 2, kMostBrush_px = 300;  // screen, radius

class CanvasView {
 public:
  explicit CanvasView(Document& document) : document_(document) {}

  // Fills the rest of the current Dear ImGui window.
  void draw();
  // The whole drawing in view.
  void fit() { fitted_ = false; }
  void zoom(double factor) { zoomAround(view_center_, factor); }
  void growBrush(double factor);
  double& brushRadius() { return brush_screen_px_; }  // screen px
  // The candidate that keys speak of: what the mouse touched last, or what was chosen by select().
  int selected() const { return selected_; }
  bool chosen() const { return selected_ >= 0 && !touched_; }  // by select()
  void select(int candidate);
  // The drawing that is shown stands so many places farther down in the list.
  void followMoved(int places) {
    if (shown_item_ >= 0) shown_item_ += places;
  }
  // While a stroke is painted or a joint dragged.
  bool isDrawing() const { return stroke_ || dragged_joint_ >= 0; }
  // Ends a stroke that has not ended yet, so that other steps can follow.
  void cancel();

  Tool tool = Tool::kJoints;
  std::optional<JointClass> active_class =
      JointClass::kHead;                  // of brush, lasso and click; nothing: they take it away
  LayerBrush layer_brush = limbBrush(1);  // what the left button paints; the right one: the body
  bool mask_fills = false;                // areas of one colour, not what the brush goes over
  bool mask_adds = true;                  // what the left button does to the mask; the right one: the reverse

 private:
  Eigen::Vector2d imageFromScreen(const ImVec2& p) const;
  ImVec2 screenFromImage(const Eigen::Vector2d& p) const;
  void zoomAround(const ImVec2& screen, double factor);
  void fitNow();
  void followDocument();
  void updateMaskTexture();
  void updateLimbTexture();
  void navigate(bool hovered);
  void useTool(bool hovered);
  void useTouch(bool hovered);
  void useBrush(bool hovered);
  void useLasso(bool hovered);
  void useJoints(bool hovered);
  void useMask(bool hovered);
  void useLimbs(bool hovered);
  // A stroke of the round brush with either button: calls paint(from_px, to_px, radius_px, value) along it.
  template <class Value, class Paint>
  void strokeWith(bool hovered, Value left, Value right, Value& value, const Paint& paint);
  void drawPicture(ImDrawList* list);
  void drawMaskEdge(ImDrawList* list);
  void drawCandidates(ImDrawList* list);
  void drawSkeleton(ImDrawList* list);
  void drawCursor(ImDrawList* list, bool hovered);

  Document& document_;
  Texture picture_, mask_tint_, limb_tint_;
  int shown_item_ = -1;
  bool tinted_ = false;                             // mask_tint_ is of this drawing
  std::shared_ptr<const MaskVersion> tinted_mask_;  // and of this mask
  bool limbs_tinted_ = false;                       // the same of limb_tint_
  std::shared_ptr<const MaskVersion> limb_mask_;
  std::shared_ptr<const LayerMap> tinted_limbs_;

  ImVec2 view_corner_{}, view_size_{}, view_center_{};
  bool fitted_ = false;
  double zoom_ = 1;                                      // screen px per image px
  Eigen::Vector2d middle_px_ = Eigen::Vector2d::Zero();  // image point in the middle of the view
  double brush_screen_px_ = 26;                          // radius

  int selected_ = -1;
  bool touched_ = false;  // by the mouse, not by select()
  ImVec2 chosen_at_{};    // where the mouse was at select()
  int dragged_joint_ = -1;
  bool stroke_ = false;      // a step of the document is open
  bool stroke_adds_ = true;  // of a stroke on the mask
  LayerBrush stroke_part_;   // of a stroke on the limbs
  Eigen::Vector2d last_px_ = Eigen::Vector2d::Zero();
  Polygon lasso_;
  bool lassoing_ = false;
};

// The colours of a class and of a joint's side.
ImU32 imColor(std::optional<JointClass> joint_class, int alpha = 255);

}  // namespace skel
