// Who a random animal on four legs is and how it stands, seen from the side. Numbers only, nothing drawn yet.
#pragma once

#include <Eigen/Core>
#include <array>

#include "libskel/core/rng.h"
#include "trainer/figures/biped_plan.h"

namespace skel {

// Families of proportions.
enum class AnimalKind {
  kPig,       // round, short legs, hardly any neck
  kDog,       // a muzzle, hanging ears
  kCat,       // round head, pointed ears, long tail
  kHorse,     // long neck, long head, long legs
  kCow,       // heavy body, horns
  kSheep,     // a cloud on thin legs
  kElephant,  // thick legs, a trunk
  kGiraffe,   // a neck as long as the rest
  kFox,       // pointed muzzle, bushy tail
  kMouse,     // hardly any legs, large ears, thin tail
  kLizard,    // low, with a thick tail; dinosaurs
  kTurtle,    // a shell
  kToy,       // the head as large as the body
  kDoodle,    // as children draw: a box or an egg, legs like sticks side by side
  kAny,       // anything between
};
inline constexpr int kAnimalKinds = 15;

// Unit: about the long side of the figure. +y down; the animal faces +x.
struct QuadrupedPlan {
  AnimalKind kind = AnimalKind::kAny;

  double height = 0;      // of the trunk: belly to back
  double leg_width = 0;   // at the root
  double neck_width = 0;  // at the middle
  double head_length = 0, head_height = 0;
  double muzzle = 0;  // beyond the head's round part, in head lengths
  double tail_width = 0;

  Eigen::Vector2d rump, middle,
      chest;                    // middles of the trunk over the hind legs, half way, over the front legs
  Eigen::Vector2d forward, up;  // along the trunk and across it
  Eigen::Vector2d neck, head;   // where the neck leaves the trunk, and the middle of the head
  Eigen::Vector2d head_forward, head_up;
  std::array<LimbPlan, 2> front, hind;
  std::array<Eigen::Vector2d, 3> tail;  // root, middle, tip
  bool has_tail = true;
  bool frontal_head = false;  // the head looks out of the picture
};

QuadrupedPlan sampleQuadrupedPlan(Rng& rng, AnimalKind kind);

}  // namespace skel
