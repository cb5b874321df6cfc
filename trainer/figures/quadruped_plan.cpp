#include "trainer/figures/quadruped_plan.h"

#include <algorithm>
#include <cmath>

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

struct Range {
  double low, high;
};

struct Proportions {
  Range height, leg, leg_width, neck, neck_angle, head, head_aspect, muzzle, tail;
};

// By AnimalKind, in trunk lengths from hip to shoulder. neck_angle: radians up from the trunk's direction.
// head_aspect: height to length. muzzle in head lengths.
constexpr Proportions kProportions[kAnimalKinds] = {
    {{.50, 1.0}, {.15, .5}, {.10, .24}, {.05, .25}, {-.3, .6}, {.35, .65}, {.75, 1.1}, {0, .35}, {.1, .4}},
    {{.28, .55}, {.35, .8}, {.08, .18}, {.15, .45}, {.2, 1.2}, {.30, .60}, {.6, .95}, {.2, .7}, {.25, .8}},
    {{.26, .55}, {.25, .65}, {.07, .17}, {.08, .30}, {.1, 1.1}, {.32, .65}, {.75, 1.05}, {0, .2}, {.5, 1.3}},
    {{.30, .52}, {.60, 1.1}, {.08, .17}, {.45, .95}, {.5, 1.3}, {.38, .60}, {.4, .6}, {.2, .6}, {.3, .9}},
    {{.42, .70}, {.35, .7}, {.09, .18}, {.10, .40}, {-.1, .7}, {.35, .55}, {.55, .85}, {.1, .5}, {.4, .9}},
    {{.55, 1.0}, {.20, .55}, {.05, .12}, {.05, .30}, {0, .8}, {.24, .48}, {.6, .95}, {.1, .45}, {.05, .3}},
    {{.55, .95}, {.35, .75}, {.17, .32}, {.05, .25}, {-.1, .5}, {.45, .75}, {.8, 1.1}, {0, .2}, {.2, .6}},
    {{.32, .55}, {.70, 1.3}, {.06, .14}, {.9, 2.0}, {.8, 1.45}, {.26, .42}, {.45, .7}, {.2, .6}, {.2, .6}},
    {{.24, .45}, {.25, .65}, {.06, .14}, {.10, .35}, {.1, 1.0}, {.32, .55}, {.6, .9}, {.3, .8}, {.5, 1.1}},
    {{.50, 1.0}, {.05, .25}, {.06, .16}, {.0, .2}, {-.2, .5}, {.35, .7}, {.7, 1.0}, {.1, .6}, {.4, 1.3}},
    {{.22, .70}, {.12, .50}, {.08, .22}, {.05, 1.5}, {-.4, 1.3}, {.20, .55}, {.4, .75}, {.2, .9}, {.6, 1.9}},
    {{.40, .75}, {.12, .35}, {.12, .24}, {.15, .50}, {0, .8}, {.24, .42}, {.6, 1.0}, {0, .4}, {.08, .35}},
    {{.45, .85}, {.15, .45}, {.14, .30}, {.0, .2}, {.3, 1.3}, {.70, 1.2}, {.8, 1.15}, {0, .2}, {.1, .7}},
    {{.30, .70}, {.25, .80}, {.03, .14}, {.0, .45}, {-.1, 1.2}, {.25, .65}, {.7, 1.1}, {0, .4}, {.15, .9}},
    {{.26, .90}, {.15, .90}, {.06, .24}, {.05, .60}, {-.2, 1.3}, {.28, .70}, {.5, 1.1}, {0, .7}, {.1, 1.2}},
};

enum class Pose { kStand, kWalk, kTrot, kGallop, kLeap, kSit, kLie, kFacing };

class Sampler {
 public:
  Sampler(Rng& rng, AnimalKind kind) : rng_(rng), q_(kProportions[static_cast<int>(kind)]) { p_.kind = kind; }

  QuadrupedPlan sample() {
    samplePose();
    if (pose_ == Pose::kFacing) {
      sitFacing();
    } else {
      sampleTrunk();
      sampleHead();
      sampleLegs();
      sampleTail();
    }
    scaleToUnit();
    return p_;
  }

 private:
  double in(Range r) { return rng_.uniform(r.low, r.high); }
  double in(double low, double high) { return rng_.uniform(low, high); }
  bool chance(double p) { return rng_.chance(p); }
  double gauss(double mean, double deviation) { return rng_.normal(mean, deviation); }
  bool is(AnimalKind kind) const { return p_.kind == kind; }

  void samplePose() {
    const bool lively = !is(AnimalKind::kDoodle) && !is(AnimalKind::kTurtle);
    const bool sits = is(AnimalKind::kDog) || is(AnimalKind::kCat) || is(AnimalKind::kFox) ||
                      is(AnimalKind::kToy) || is(AnimalKind::kMouse) || is(AnimalKind::kAny);
    double r = rng_.uniform();
    const auto takes = [&](double share) { return (r -= share) < 0; };
    pose_ = takes(lively ? .20 : .08)   ? Pose::kWalk
            : takes(lively ? .07 : .02) ? Pose::kTrot
            : takes(lively ? .09 : .01) ? Pose::kGallop
            : takes(lively ? .03 : .01) ? Pose::kLeap
            : takes(sits ? .12 : .02)   ? Pose::kSit
            : takes(lively ? .04 : .01) ? Pose::kLie
            : takes(sits ? .06 : 0)     ? Pose::kFacing
                                        : Pose::kStand;
    // How much of the animal's length is seen: less when it stands askew.
    depth_ = chance(.25) ? in(.55, .95) : 1;
    // Legs drawn side by side rather than one before the other.
    row_ = chance(is(AnimalKind::kDoodle) ? .75 : .35);
    p_.height = in(q_.height);
    leg_ = in(q_.leg);
    p_.leg_width = in(q_.leg_width);
    p_.frontal_head =
        chance(is(AnimalKind::kToy) || is(AnimalKind::kCat) || is(AnimalKind::kDoodle) ? .55 : .25);
    p_.head_length = in(q_.head);
    p_.head_height = p_.head_length * in(q_.head_aspect);
    p_.muzzle = in(q_.muzzle);
    if (p_.frontal_head) p_.head_height = p_.head_length * in(.75, 1.15);
  }

  void sampleTrunk() {
    double tilt = gauss(0, chance(.85) ? .05 : .15);  // front up
    if (pose_ == Pose::kSit) tilt = in(.55, 1.15);
    if (pose_ == Pose::kGallop || pose_ == Pose::kLeap) tilt = gauss(.1, .2);
    p_.forward = rotated(Vec(1, 0), -tilt);
    p_.up = rotated(Vec(0, -1), -tilt);
    p_.middle.setZero();
    const double half = .5 * depth_;
    p_.rump = p_.middle - p_.forward * half;
    p_.chest = p_.middle + p_.forward * half;
    // The back may sag or arch.
    p_.middle += p_.up * gauss(0, .03);
    belly_ = p_.height * .5;
    ground_ = std::max(p_.rump.y(), p_.chest.y()) + belly_ + leg_;
    if (pose_ == Pose::kSit) ground_ = p_.rump.y() + belly_ * in(.9, 1.1);
    if (pose_ == Pose::kLie) ground_ = belly_ * in(.95, 1.05);
  }

  void sampleHead() {
    double angle = in(q_.neck_angle);
    double neck = in(q_.neck);
    const bool grazes =
        pose_ != Pose::kSit && pose_ != Pose::kLie && chance(is(AnimalKind::kDoodle) ? .03 : .12);
    if (grazes) angle = -in(.5, 1.2);
    if (pose_ == Pose::kSit) angle -= in(.1, .6);  // the trunk already points up
    const Vec direction = rotated(p_.forward, -angle);
    p_.neck = p_.chest + p_.forward * p_.height * in(-.05, .25) + p_.up * p_.height * in(.0, .35);
    p_.neck_width = std::min(p_.height * in(.45, .9), std::max(.05, p_.head_height * in(.45, 1)));
    // The muzzle points forwards and mostly a little down.
    double nod = gauss(-.15, .3);
    if (is(AnimalKind::kHorse) || is(AnimalKind::kGiraffe)) nod = -in(.1, .9);
    if (grazes) nod = -in(.2, 1.1);
    if (p_.frontal_head) nod = gauss(0, .15);
    p_.head_forward = rotated(Vec(1, 0), -nod);
    p_.head_up = rotated(Vec(0, -1), -nod);
    const double reach = p_.head_length * in(.2, .5);
    p_.head = p_.neck + direction * (neck + reach) + p_.head_forward * p_.head_length * in(.0, .25);
    // A head that grazes reaches the ground, not below it.
    const double lowest = ground_ - p_.head_height * .5;
    if (p_.head.y() > lowest && pose_ != Pose::kLeap && pose_ != Pose::kGallop) p_.head.y() = lowest;
  }

  // A leg whose joints are given by the angles of its two halves from straight down, forwards positive.
  void byAngles(LimbPlan& leg, double upper, double lower) {
    const double length = .35 * p_.height + leg_;
    const double split = in(.42, .58);
    leg.middle = leg.root + rotated(Vec(0, 1), -upper) * length * split;
    leg.end = leg.middle + rotated(Vec(0, 1), -lower) * length * (1 - split);
  }
  // A leg that stands on the ground.
  void standing(LimbPlan& leg, double x, double bend) {
    leg.end = {x, ground_ + gauss(0, .015)};
    const Vec along = leg.end - leg.root;
    leg.middle = leg.root + along * in(.42, .58) + Vec(-along.y(), along.x()) * bend;
  }

  void sampleLegs() {
    const double rubber = chance(.5) ? in(0, .4) : in(.5, 1.1);
    const double shared = gauss(0, .05), lead = chance(.5) ? 1 : -1;
    const double apart_front = pairDistance(), apart_hind = pairDistance();
    const double inset_front = in(-.05, .15), inset_hind = in(-.05, .15);
    const double stride = in(.15, .6), flight = in(.3, 1.1);
    const bool stretched = chance(.5);
    for (const int s : {kRight, kLeft}) {
      const double side = sideSign(s);
      for (const bool is_front : {true, false}) {
        LimbPlan& leg = is_front ? p_.front[s] : p_.hind[s];
        const Vec base =
            is_front ? Vec(p_.chest - p_.forward * inset_front) : Vec(p_.rump + p_.forward * inset_hind);
        const double apart = is_front ? apart_front : apart_hind;
        leg.root = base + p_.forward * side * apart / 2 - p_.up * p_.height * in(.0, .25);
        leg.rubber = rubber;
        leg.wave = 0;
        leg.in_front = s == kRight;
        // Front legs bend their elbows backwards, hind legs their hocks.
        const double bend = is_front ? gauss(.02, .05) : gauss(-.06, .07);
        const double phase = side * lead * (is_front ? 1 : -1);
        switch (pose_) {
          case Pose::kStand:
          case Pose::kFacing:
            standing(leg, leg.root.x() + shared + gauss(0, is(AnimalKind::kDoodle) ? .04 : .06), bend * .7);
            break;
          case Pose::kWalk:
            standing(leg, leg.root.x() + phase * stride * (.35 * p_.height + leg_) * in(.6, 1.1), bend);
            if (chance(.25)) leg.end.y() -= leg_ * in(.05, .3);
            break;
          case Pose::kTrot: {
            const double swing = phase * in(.2, .8);
            byAngles(leg, swing, swing - (phase > 0 ? in(0, .9) : in(0, .6)) * (is_front ? 1 : -.3));
            break;
          }
          case Pose::kGallop:
          case Pose::kLeap: {
            const bool forwards = is_front == stretched;
            const double swing = (forwards ? flight : -flight) * in(.7, 1.15) + side * .12;
            byAngles(leg, swing, swing + (forwards ? in(-.5, .3) : in(-.6, .3)));
            break;
          }
          case Pose::kSit:
            if (is_front) {
              standing(leg, leg.root.x() + gauss(.08, .08), bend * .6);
            } else {  // folded: the knee forwards and up, the foot before the rump
              leg.root = p_.rump + p_.forward * in(.05, .2) - p_.up * p_.height * in(.0, .2);
              leg.end = {leg.root.x() + in(.15, .45), ground_ + gauss(0, .01)};
              leg.middle = (leg.root + leg.end) / 2 + Vec(in(.0, .15), -in(-.02, .15));
            }
            break;
          case Pose::kLie: {
            leg.root += p_.up * p_.height * -in(.05, .15);
            const double ahead = is_front ? in(.15, .55) : in(.05, .35);
            leg.end = {leg.root.x() + ahead, ground_ + gauss(0, .02)};
            leg.middle = (leg.root + leg.end) / 2 + Vec(in(-.15, .08), in(-.02, .06));
            break;
          }
        }
        if (pose_ == Pose::kTrot && leg.end.y() > ground_) leg.end.y() = ground_ + gauss(0, .02);
      }
    }
    if (chance(.06)) {  // one front leg is lifted
      LimbPlan& leg = p_.front[chance(.5) ? kRight : kLeft];
      if (pose_ == Pose::kStand || pose_ == Pose::kSit || pose_ == Pose::kWalk)
        byAngles(leg, in(.3, 1.2), in(-1.2, .4));
    }
  }

  // Between the legs of a pair along the trunk.
  double pairDistance() {
    if (row_) return in(1.1, 2.3) * std::max(p_.leg_width, .1) * in(.8, 1.3);
    return chance(.3) ? in(0, .05) : in(.03, 1.2) * std::max(p_.leg_width, .08);
  }

  void sampleTail() {
    p_.has_tail =
        chance(is(AnimalKind::kSheep) || is(AnimalKind::kToy) || is(AnimalKind::kElephant) ? .6 : .9);
    const double length = in(q_.tail);
    p_.tail[0] = p_.rump - p_.forward * p_.height * in(.3, .5) + p_.up * p_.height * in(-.05, .4);
    if (!p_.has_tail) {
      noTail();
      return;
    }
    p_.tail_width = std::max(.012, is(AnimalKind::kLizard)  ? p_.height * in(.3, .8)
                                   : is(AnimalKind::kFox)   ? in(.08, .3)
                                   : is(AnimalKind::kHorse) ? in(.05, .18)
                                                            : in(.015, .1));
    const double rise = chance(.08)                                      ? in(1.2, 2.4)  // over the back
                        : is(AnimalKind::kLizard)                        ? gauss(0, .3)
                        : is(AnimalKind::kHorse) || is(AnimalKind::kCow) ? gauss(-.8, .6)
                                                                         : gauss(.3, .8);
    const double turn = gauss(0, .7);
    const Vec first = rotated(-p_.forward, std::clamp(rise, -1.5, 2.4));
    p_.tail[1] = p_.tail[0] + first * length * .5;
    p_.tail[2] = p_.tail[1] + rotated(first, turn) * length * .5;
    for (Vec& t : p_.tail) t.y() = std::min(t.y(), ground_ + .02);
  }

  // The joints lie where a tail would begin.
  void noTail() {
    p_.tail[0] = p_.rump;
    p_.tail[1] = p_.tail[2] = p_.rump - p_.forward * p_.height * .25;
  }

  // Sits and looks at us: the front legs before the body, the hind feet beside them.
  void sitFacing() {
    p_.frontal_head = true;
    p_.forward = Vec(0, -1);  // the trunk stands up
    p_.up = Vec(-1, 0);
    const double tall = in(.6, 1.1), width = p_.height * in(.8, 1.2);
    p_.height = width;
    p_.middle.setZero();
    p_.rump = Vec(0, tall * .35);
    p_.chest = Vec(0, -tall * .35);
    ground_ = tall * .35 + width * .35;
    p_.neck = p_.chest;
    p_.neck_width = width * in(.4, .8);
    p_.head_forward = Vec(1, 0);
    p_.head_up = rotated(Vec(0, -1), gauss(0, .1));
    p_.head = p_.chest + p_.head_up * (p_.head_height * in(.35, .6));
    p_.head.x() += gauss(0, .03);
    const double feet = in(.12, .32) * width, haunch = in(.4, .62) * width;
    for (const int s : {kRight, kLeft}) {
      const double side = sideSign(s);
      LimbPlan& front = p_.front[s];
      front.root = p_.chest + Vec(side * width * in(.2, .32), tall * in(.05, .15));
      front.end = {side * feet, ground_ + gauss(0, .01)};
      front.middle = (front.root + front.end) / 2 + Vec(side * in(0, .04), 0);
      front.in_front = true;
      LimbPlan& hind = p_.hind[s];
      hind.root = p_.rump + Vec(side * width * in(.2, .35), -tall * in(.0, .1));
      hind.end = {side * (haunch + in(.0, .15)), ground_ + gauss(0, .015)};
      hind.middle = Vec(side * (haunch + in(.05, .2)), (hind.root.y() + hind.end.y()) / 2 + gauss(0, .03));
      hind.in_front = chance(.5);
    }
    const double side = chance(.5) ? 1 : -1, length = in(q_.tail);
    p_.has_tail = chance(.8);
    p_.tail[0] = p_.rump + Vec(side * width * .3, width * .2);
    p_.tail_width = in(.03, .12);
    p_.tail[1] = p_.tail[0] + Vec(side * (.1 + length * .4), -in(-.1, .2) * length);
    p_.tail[2] = p_.tail[1] + Vec(side * length * in(-.1, .3), -in(.1, .5) * length);
    if (!p_.has_tail) noTail();
    p_.muzzle = 0;
  }

  void scaleToUnit() {
    Vec low = Vec::Constant(1e9), high = -low;
    const auto take = [&](const Vec& p, double r) {
      low = low.cwiseMin(p - Vec::Constant(r));
      high = high.cwiseMax(p + Vec::Constant(r));
    };
    take(p_.rump, p_.height / 2);
    take(p_.chest, p_.height / 2);
    take(p_.head, p_.head_length / 2);
    for (const auto* pair : {&p_.front, &p_.hind})
      for (const LimbPlan& leg : *pair) take(leg.end, 0), take(leg.middle, 0);
    if (p_.has_tail) take(p_.tail[2], 0);
    const double scale = 1 / (high - low).maxCoeff();
    for (double* v :
         {&p_.height, &p_.leg_width, &p_.neck_width, &p_.head_length, &p_.head_height, &p_.tail_width})
      *v *= scale;
    for (Vec* v : {&p_.rump, &p_.middle, &p_.chest, &p_.neck, &p_.head}) *v *= scale;
    for (auto* pair : {&p_.front, &p_.hind})
      for (LimbPlan& leg : *pair) leg.root *= scale, leg.middle *= scale, leg.end *= scale;
    for (Vec& t : p_.tail) t *= scale;
  }

  Rng& rng_;
  const Proportions& q_;
  QuadrupedPlan p_;
  Pose pose_ = Pose::kStand;
  double leg_ = 0, depth_ = 1, belly_ = 0, ground_ = 0;
  bool row_ = false;
};

}  // namespace

QuadrupedPlan sampleQuadrupedPlan(Rng& rng, AnimalKind kind) { return Sampler(rng, kind).sample(); }

}  // namespace skel
