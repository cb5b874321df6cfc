// The middle of the window: the character, and what the mouse does there.
#pragma once

#include <imgui.h>

#include <memory>
#include <optional>

#include "animator/document.h"
#include "animator/handles.h"
#include "libskel/scene/scene.h"
#include "libskel/window/window.h"

namespace skel {

class StageView {
 public:
  explicit StageView(AnimationDocument& document) : document_(document) {}

  // Fills so much of the current Dear ImGui window.
  void draw(const ImVec2& size);
  // The whole character in view, wherever the chosen clip takes it; it stays so until the view is moved or
  // zoomed.
  void fit();
  void zoomBy(double factor);
  // From the front, its left, from behind, its right: quarters of a turn.
  void lookFrom(int quarter);
  bool isSeenFrom(int quarter) const;
  const Camera& camera() const { return camera_; }
  int width() const { return width_; }
  int height() const { return height_; }

  Look look;
  bool weights = false;  // those of the chosen joint as colours
  bool handles = true;

 private:
  void followDocument();
  void frame();
  void useMouse(bool hovered);
  void drawHandles(ImDrawList* list);
  Eigen::Vector2d mouse() const;

  AnimationDocument& document_;
  Texture picture_;
  std::shared_ptr<const RiggedCharacter> shown_;
  std::unique_ptr<Scene> scene_;
  Camera camera_{.yaw_rad = 0.5, .pitch_rad = 0.12};
  // What the camera was made to show, while it shows all of it.
  struct Framed {
    std::shared_ptr<const RiggedCharacter> character;
    int clip = -1, width = 0, height = 0;
    bool operator==(const Framed&) const = default;
  };
  std::optional<Framed> framed_;
  ImVec2 corner_{};
  int width_ = 0, height_ = 0;
  int touched_ = -1;  // joint under the mouse
  std::array<Ring, 3> rings_;
  bool has_rings_ = false;
  int touched_axis_ = -1;
  std::optional<RingGrip> grip_;
  double turned_rad_ = 0;  // since the ring was taken
  bool orbits_ = false, pans_ = false;
  float dragged_px_ = 0;  // since the button went down
};

}  // namespace skel
