// Who a random biped is and how it stands: proportions, view, pose. Numbers only, nothing drawn yet.
#pragma once

#include <Eigen/Core>
#include <array>

#include "libskel/core/rng.h"
#include "trainer/figures/drawing.h"

namespace skel {

// Families of proportions. A family can be held back from training to measure on it.
enum class BodyKind {
  kChibi,   // large head, short limbs
  kBlock,   // large head on a wide body, hardly any legs
  kEmoji,   // a third head, a third torso, a third legs
  kAdult,   // natural
  kDoodle,  // small head, long rubber limbs
  kBlob,    // head and torso one mass
  kStick,   // limbs are lines
  kKid,     // anything between
  kPlush,   // round animal with stub limbs
  kHero,    // broad shoulders, narrow hips
  kChild,   // as children draw: a triangle or a box for a torso, thin limbs
  kFace,    // the face is the body: limbs grow out of the head
};
inline constexpr int kBodyKinds = 12;

// Sides as indices: the character's right limb is at the left of a figure that faces us.
inline constexpr int kRight = 0, kLeft = 1;
inline constexpr double sideSign(int side) { return side == kRight ? -1.0 : 1.0; }

struct LimbPlan {
  Eigen::Vector2d root, middle, end;  // shoulder, elbow, hand or hip, knee, foot
  double rubber = 0;                  // 0: bent sharply at the middle, 1: a smooth arc
  double wave = 0;                    // sideways swing of a wavy limb
  bool in_front = true;               // drawn before the torso
  bool before_head = false;           // drawn before the head
};

// Unit: about the height of the figure. +y down.
struct BipedPlan {
  BodyKind kind = BodyKind::kKid;
  FigureView view = FigureView::kFront;
  double face = 1;  // side the figure turns to in the picture: -1 left, 1 right

  double head_height = 0, head_width = 0, torso = 0, leg = 0, arm = 0, limb_width = 0;
  double top = 0, waist = 0, bottom = 0;  // half widths of the torso
  double neck_gap = 0;  // from the neck joint to the chin, negative: head over the shoulders

  Eigen::Vector2d pelvis, middle, neck, head;
  Eigen::Vector2d up, right;  // of the hips
  Eigen::Vector2d chest_up, chest_right;
  Eigen::Vector2d head_up, head_right;
  std::array<LimbPlan, 2> arms, legs;
  int near_side = kRight;  // the side that is closer to the viewer, where it matters
  bool sitting = false;
  bool on_chair = false;
};

Eigen::Vector2d rotated(const Eigen::Vector2d& v, double angle);

BipedPlan sampleBipedPlan(Rng& rng, BodyKind kind);

}  // namespace skel
