#include "trainer/figures/biped_plan.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

struct Range {
  double low, high;
};

struct Proportions {
  Range head_height, head_aspect, torso, torso_aspect, leg, limb_width, arm_to_torso;
};

// By BodyKind. Heights and widths in figure heights; aspect is width to height.
constexpr Proportions kProportions[kBodyKinds] = {
    {{.40, .62}, {.80, 1.30}, {.16, .27}, {.75, 1.5}, {.13, .25}, {.035, .075}, {.75, 1.25}},  // chibi
    {{.38, .62}, {.75, 1.15}, {.18, .32}, {1.2, 2.0}, {.10, .24}, {.06, .13}, {.8, 1.25}},     // block
    {{.25, .38}, {.75, 1.15}, {.26, .36}, {.6, 1.1}, {.28, .44}, {.04, .085}, {.9, 1.3}},      // emoji
    {{.11, .19}, {.65, 1.0}, {.26, .36}, {.45, .85}, {.40, .54}, {.04, .09}, {1.0, 1.4}},      // adult
    {{.09, .19}, {.7, 1.15}, {.18, .33}, {.4, .9}, {.40, .68}, {.04, .13}, {1.1, 2.3}},        // doodle
    {{.22, .42}, {.9, 1.5}, {.32, .50}, {.8, 1.5}, {.10, .30}, {.06, .17}, {.45, .95}},        // blob
    {{.14, .32}, {.8, 1.25}, {.2, .36}, {.06, .45}, {.26, .50}, {.012, .032}, {.8, 1.7}},      // stick
    {{.17, .36}, {.72, 1.25}, {.2, .36}, {.5, 1.25}, {.25, .46}, {.03, .11}, {.8, 1.5}},       // kid
    {{.32, .52}, {.85, 1.3}, {.28, .44}, {.75, 1.25}, {.12, .30}, {.08, .17}, {.6, 1.1}},      // plush
    {{.10, .24}, {.65, 1.0}, {.28, .42}, {.7, 1.2}, {.26, .48}, {.06, .15}, {.9, 1.4}},        // hero
    {{.18, .38}, {.85, 1.25}, {.24, .42}, {.4, 1.1}, {.18, .42}, {.015, .06}, {.6, 1.6}},      // child
    {{.40, .66}, {.65, 1.35}, {.16, .34}, {.9, 1.7}, {.10, .42}, {.015, .09}, {.8, 2.2}},      // face
};

enum class ArmPose {
  kRest,
  kAway,
  kLevel,
  kUp,
  kCheer,
  kHips,
  kForward,
  kFlexed,
  kWave,
  kCrossed,
  kRandom,
  kBehindBack,
  kPocket,
  kFace,
  kChest,
  kHeadBack,  // hand behind the head
  kReach,     // stretched out to where the figure faces
  kGround,    // down between or beside the legs
  kCount
};
enum class LegPose {
  kStand,
  kSpread,
  kWalk,
  kRun,
  kCrouch,
  kSitFloor,
  kKick,
  kFloat,
  kRandom,
  kCrossed,
  kFoldBack,
  kKneel,
  kChair,
  kJump,
  kStork,
  kLunge,
  kLotus,
  kSquat,      // knees beside the body, as a frog sits
  kArabesque,  // one leg stretched far out
  kCount
};

template <typename Enum>
Enum pick(Rng& rng, std::span<const double> weights) {
  double sum = 0;
  for (const double w : weights) sum += w;
  double r = rng.uniform() * sum;
  std::size_t i = 0;
  while (i + 1 < weights.size() && r >= weights[i]) r -= weights[i++];
  return static_cast<Enum>(i);
}

// The elbow or knee of a limb from `root` to `end` with the given segment lengths, bent towards `bend`.
// A target that is out of reach is brought within it; one that is too near shortens the limb, as a limb that
// points to the viewer looks.
Vec twoBone(const Vec& root, Vec& end, double upper, double lower, const Vec& bend) {
  Vec along = end - root;
  double d = std::max(along.norm(), 1e-6);
  const double reach = upper + lower;
  if (d > .98 * reach) {
    end = root + along * (.98 * reach / d);
    along = end - root;
    d = .98 * reach;
  }
  const double shrink = std::min(1.0, std::max(.45, d / (.35 * reach)));
  upper *= shrink;
  lower *= shrink;
  const double a = std::clamp((upper * upper - lower * lower + d * d) / (2 * d), -upper, upper);
  const double h = std::sqrt(std::max(0.0, upper * upper - a * a));
  Vec n(-along.y() / d, along.x() / d);
  if (n.dot(bend) < 0) n = -n;
  return root + along * (a / d) + n * h;
}

class Sampler {
 public:
  Sampler(Rng& rng, BodyKind kind) : rng_(rng) { plan_.kind = kind; }

  BipedPlan sample() {
    sampleBody();
    sampleHead();
    sampleArms();
    sampleLegs();
    return plan_;
  }

 private:
  double in(Range r) { return rng_.uniform(r.low, r.high); }
  double in(double low, double high) { return rng_.uniform(low, high); }
  bool chance(double p) { return rng_.chance(p); }
  double gauss(double mean, double deviation) { return rng_.normal(mean, deviation); }
  bool is(BodyKind kind) const { return plan_.kind == kind; }

  void sampleBody() {
    BipedPlan& p = plan_;
    const Proportions& q = kProportions[static_cast<int>(p.kind)];
    p.head_height = in(q.head_height);
    p.head_width = p.head_height * in(q.head_aspect);
    p.torso = in(q.torso);
    const double width = p.torso * in(q.torso_aspect);
    p.leg = in(q.leg);
    p.limb_width = in(q.limb_width);
    p.arm = p.torso * in(q.arm_to_torso);
    if ((is(BodyKind::kChibi) || is(BodyKind::kBlock)) && chance(.3)) p.arm *= in(1, 1.5);

    const double v = rng_.uniform();
    p.view = v < .60 ? FigureView::kFront : v < .82 ? FigureView::kThreeQuarter : FigureView::kSide;
    p.face = chance(.5) ? 1 : -1;
    p.near_side = p.face > 0 ? kRight : kLeft;

    const bool loose = chance(is(BodyKind::kDoodle) ? .5 : .18);
    const double lean = gauss(0, loose ? .4 : .07);
    const double bend = gauss(0, chance(.7) ? .05 : .3);
    p.up = rotated(Vec(0, -1), lean);
    p.right = rotated(Vec(1, 0), lean);
    p.chest_up = rotated(p.up, bend);
    p.chest_right = rotated(p.right, bend);
    p.pelvis.setZero();
    p.middle = p.up * p.torso * .5;
    p.neck = p.middle + p.chest_up * p.torso * .5;

    // How wide the torso and the pairs of joints appear from this side.
    double spread = 1, body = 1;
    if (p.view == FigureView::kThreeQuarter) {
      spread = in(.5, .92);
      body = in(.72, 1);
    } else if (p.view == FigureView::kSide) {
      spread = in(0, .35);
      body = in(.5, .85);
    }
    double top_share = in(.72, 1.1), bottom_share = in(.62, 1.1);
    if (is(BodyKind::kHero)) bottom_share = top_share * in(.4, .85);
    if (is(BodyKind::kChild) && chance(.5)) top_share = in(.15, .6), bottom_share = in(.8, 1.5);
    if (is(BodyKind::kPlush) && chance(.5)) bottom_share = in(.95, 1.3);
    p.top = width / 2 * top_share * body;
    p.bottom = width / 2 * bottom_share * body;
    p.waist = std::min(p.top, p.bottom) * (chance(.4) ? in(.62, 1) : in(.95, 1.3));

    if (is(BodyKind::kFace)) {  // the torso is the lower part of the head
      p.bottom = p.head_width * in(.28, .46) * body;
      p.top = p.head_width * in(.4, .5) * body;
      p.waist = std::max(p.top, p.bottom) * in(.9, 1.05);
    }
    double inset = in(.6, 1.0);
    if (is(BodyKind::kFace)) inset = in(.85, 1.1);
    if ((is(BodyKind::kBlock) || is(BodyKind::kBlob)) && chance(.6)) inset = in(.75, 1.2);
    shoulder_offset_ = p.top * inset * std::min(1.0, spread / body);
    hip_offset_ = p.bottom * in(.35, .72) * std::min(1.0, spread / body);
    if (is(BodyKind::kStick) && width < .12) {
      shoulder_offset_ = std::max(shoulder_offset_ * in(0, 1), .004);
      hip_offset_ *= in(0, 1);
    }
    if (is(BodyKind::kChild)) shoulder_offset_ = std::max(shoulder_offset_, .01);
  }

  void sampleHead() {
    BipedPlan& p = plan_;
    switch (p.kind) {
      case BodyKind::kChibi:
      case BodyKind::kBlock:
      case BodyKind::kBlob:
      case BodyKind::kPlush:
        p.neck_gap = in(-.06, .08);
        break;
      case BodyKind::kAdult:
      case BodyKind::kDoodle:
      case BodyKind::kHero:
        p.neck_gap = in(-.05, .35);
        break;
      case BodyKind::kFace:
        p.neck_gap = in(-.4, -.12);
        break;
      default:
        p.neck_gap = in(-.08, .32);
    }
    p.neck_gap *= p.head_height;
    const double tilt = gauss(0, chance(.75) ? .08 : .35);
    p.head_up = rotated(p.chest_up, tilt);
    p.head_right = rotated(p.chest_right, tilt);
    const double forward = p.view == FigureView::kFront ? 0 : p.face * in(0, .28) * p.head_height * .5;
    p.head = p.neck + p.chest_up * p.neck_gap + p.head_up * p.head_height / 2 + p.chest_right * forward;
  }

  ArmPose sampleArmPose() {
    double w[static_cast<int>(ArmPose::kCount)] = {.24, .13, .07, .07, .06,  .10, .10, .07,  .07,
                                                   .06, .08, .05, .05, .045, .08, .03, .035, .02};
    if (plan_.view != FigureView::kFront) w[static_cast<int>(ArmPose::kReach)] = .09;
    if (is(BodyKind::kChibi) || is(BodyKind::kBlock)) w[static_cast<int>(ArmPose::kCheer)] += .08;
    return pick<ArmPose>(rng_, w);
  }

  void sampleArms() {
    BipedPlan& p = plan_;
    const bool same = chance(.5);
    const ArmPose common = sampleArmPose();
    const double shared = rng_.normal();
    const double rubber = chance(.6) ? in(0, .5) : in(.6, 1.2);
    const bool wavy = chance(is(BodyKind::kDoodle) ? .2 : .04);
    const bool large_head = p.head_height > p.torso;
    const double split = in(.44, .56), drop = in(.03, large_head ? .32 : .2);
    const bool side = p.view == FigureView::kSide;
    // A side view swings both arms along the facing direction.
    const bool swings = p.view != FigureView::kFront && chance(side ? .7 : .4);

    for (const int s : {kRight, kLeft}) {
      LimbPlan& arm = p.arms[s];
      const double sign = sideSign(s);
      const auto varied = [&](double mean, double deviation) {
        return mean + deviation * (same ? .8 * shared + .6 * rng_.normal() : rng_.normal());
      };
      arm.root = p.neck - p.chest_up * p.torso * drop + p.chest_right * sign * shoulder_offset_;
      arm.rubber = rubber;
      arm.in_front = chance(.65);
      arm.before_head = chance(.45);
      const double length = p.arm * in(.95, 1.05);
      double upper = length * split, lower = length * (1 - split);
      const ArmPose pose = same ? common : sampleArmPose();

      double raise = 0, flex = 0;  // angle of the upper arm from hanging, outwards; of the forearm against it
      Vec target;
      bool reaches = false;
      const auto reach = [&](const Vec& to) {
        target = to;
        reaches = true;
        arm.in_front = true;
      };
      switch (pose) {
        case ArmPose::kRest:
          raise = varied(.12, .15), flex = varied(0, .16);
          break;
        case ArmPose::kAway:
          raise = varied(.5, .22), flex = varied(-.05, .32);
          break;
        case ArmPose::kLevel:
          raise = varied(1.45, .22), flex = varied(0, .3);
          break;
        case ArmPose::kUp:
          raise = varied(2.4, .38), flex = varied(.2, .4);
          break;
        case ArmPose::kCheer:
          raise = varied(1.9, .32), flex = varied(.8, .42);
          break;
        case ArmPose::kHips:
          raise = varied(.78, .2), flex = varied(-1.5, .35);
          break;
        case ArmPose::kForward:
          raise = varied(.25, .35), flex = varied(1.2, .5);
          if (chance(.5)) upper *= in(.5, 1), lower *= in(.55, 1);
          break;
        case ArmPose::kFlexed:
          raise = varied(1.3, .3), flex = varied(1.5, .35);
          break;
        case ArmPose::kWave:
          raise = varied(.7, .3), flex = varied(2.0, .35);
          break;
        case ArmPose::kRandom:
        case ArmPose::kCount:
          raise = in(-.5, 3), flex = in(-1.9, 1.9);
          upper *= in(.7, 1);
          lower *= in(.7, 1);
          break;
        case ArmPose::kCrossed:
          reach(p.middle + p.chest_up * p.torso * in(-.1, .25) - p.chest_right * sign * p.top * in(.1, .9));
          break;
        case ArmPose::kBehindBack:
          reach(p.pelvis + p.up * p.torso * in(-.1, .35) - p.right * sign * p.bottom * in(-.5, .6));
          arm.in_front = false;
          break;
        case ArmPose::kPocket:
          reach(p.pelvis + p.up * p.torso * in(-.25, .1) + p.right * sign * p.bottom * in(.45, 1.05));
          break;
        case ArmPose::kFace:
          reach(p.head + p.head_right * p.head_width * (sign * .2 + gauss(0, .2)) -
                p.head_up * p.head_height * in(-.2, .45));
          arm.before_head = true;
          break;
        case ArmPose::kChest:
          reach(p.middle + p.chest_up * p.torso * in(-.3, .4) + p.chest_right * sign * p.top * in(-.5, .5));
          break;
        case ArmPose::kReach: {
          const Vec ahead = rotated(p.chest_right * p.face, -p.face * (.1 + .35 * shared));
          reach(arm.root + ahead * length * in(.6, 1) + p.chest_up * length * gauss(0, .15));
          arm.in_front = s == p.near_side || chance(.6);
          break;
        }
        case ArmPose::kGround:
          reach(p.pelvis - p.up * p.leg * in(.2, .9) + p.right * sign * p.bottom * in(-.2, .8));
          break;
        case ArmPose::kHeadBack:
          reach(p.head + p.head_right * p.head_width * sign * in(.2, .55) +
                p.head_up * p.head_height * in(-.3, .35));
          arm.before_head = chance(.3);
          arm.in_front = arm.before_head;
          break;
      }
      if (reaches) {
        arm.end = target;
        arm.middle = twoBone(arm.root, arm.end, upper, lower, p.chest_right * sign - p.chest_up * .4);
      } else {
        if (swings && chance(.75)) {
          raise = sign * p.face * gauss(0, .65);
          flex = sign * p.face * in(0, 1.7);
        }
        const Vec down = -p.chest_up;
        arm.middle = arm.root + rotated(down, -sign * raise) * upper;
        arm.end = arm.middle + rotated(down, -sign * (raise + flex)) * lower;
      }
      if (side) arm.in_front = s == p.near_side || (arm.in_front && chance(.2));
      if (wavy) arm.wave = length * gauss(0, .16);
    }
  }

  void sampleLegs() {
    BipedPlan& p = plan_;
    //               stand spread walk run crouch floor kick float random crossed fold kneel chair jump stork
    //               lunge lotus squat arabesque
    double plain[] = {.32, .14, .13, .09, .05, .05, .06,  .03, .04, .03,
                      .07, .02, .04, .03, .04, .02, .015, .02, .02};
    double lively[] = {.10, .10, .14, .17, .05, .04, .12, .02, .10, .05,
                       .13, .02, .04, .06, .08, .05, .01, .02, .04};
    if (is(BodyKind::kPlush)) plain[static_cast<int>(LegPose::kSitFloor)] = .3;
    const auto pose = pick<LegPose>(rng_, is(BodyKind::kDoodle) ? lively : plain);
    p.sitting = pose == LegPose::kSitFloor || pose == LegPose::kChair || pose == LegPose::kLotus ||
                pose == LegPose::kSquat;
    p.on_chair = pose == LegPose::kChair && chance(.6);

    const double shared = rng_.normal(), split = in(.44, .56), upright = in(0, 1);
    const double rubber = chance(.75) ? p.arms[0].rubber : 0;
    const bool wavy = chance(is(BodyKind::kDoodle) ? .15 : .03);
    const int lead = chance(.5) ? kLeft : kRight;
    const double lean = std::atan2(p.up.x(), -p.up.y());
    const Vec down = rotated(-p.up, -lean * upright);
    const double stride = in(.1, .75), leap = in(.5, 1.4), bent = in(1.0, 2.6);

    for (const int s : {kRight, kLeft}) {
      LimbPlan& leg = p.legs[s];
      const double sign = sideSign(s), ahead = sign * p.face;
      const bool leads = s == lead;
      const auto varied = [&](double mean, double deviation) {
        return mean + deviation * (.8 * shared + .6 * rng_.normal());
      };
      leg.root = p.pelvis + p.right * sign * hip_offset_ + p.up * p.torso * in(-.02, .04);
      leg.rubber = rubber;
      leg.in_front = leads;
      double length = p.leg * in(.97, 1.03), raise = 0, flex = 0;
      double upper = split, lower = 1 - split;
      switch (pose) {
        case LegPose::kStand:
          raise = varied(.04, .06), flex = varied(0, .06);
          break;
        case LegPose::kSpread:
          raise = varied(.35, .2), flex = varied(-.1, .22);
          break;
        case LegPose::kWalk:
          raise = ahead * (leads ? stride : -stride * .8);
          flex = -ahead * in(0, .9) * (leads ? .3 : 1);
          break;
        case LegPose::kRun:
          raise = ahead * (leads ? leap : -leap * in(0, .8));
          flex = -ahead * in(.3, 1.9);
          break;
        case LegPose::kCrouch:
          raise = varied(.9, .25), flex = varied(-1.1, .35);
          break;
        case LegPose::kSitFloor:
          raise = varied(1.05, .35), flex = varied(-.3, .6);
          length *= in(.6, 1);
          break;
        case LegPose::kKick:
          raise = leads ? varied(.1, .12) : in(.3, 1.9);
          flex = leads ? varied(-.1, .15) : in(-2.2, .3);
          break;
        case LegPose::kFloat:
        case LegPose::kCount:
          raise = varied(-.06, .06), flex = varied(0, .06);
          break;
        case LegPose::kRandom:
          raise = in(-.5, 1.9), flex = in(-2.4, .7);
          lower *= in(.6, 1);
          break;
        case LegPose::kCrossed:
          raise = leads ? -in(.1, .45) : -in(-.1, .2);
          flex = leads ? -in(-.2, .4) : in(-.2, .3);
          break;
        case LegPose::kFoldBack:
          raise = leads ? varied(.05, .1) : in(-.6, .8);
          flex = leads ? varied(0, .1) : (chance(.6) ? -1 : 1) * in(1.2, 2.6);
          if (!leads) lower *= in(.4, 1);
          break;
        case LegPose::kKneel:
          raise = leads ? in(.6, 1.5) : in(-.1, .3);
          flex = leads ? -in(.7, 1.6) : (chance(.5) ? -1 : 1) * in(1.2, 1.9);
          break;
        case LegPose::kChair:
          raise = ahead * in(1.0, 1.6), flex = -ahead * in(.9, 1.8);
          break;
        case LegPose::kJump:
          raise = varied(.7, .3), flex = varied(-bent, .25);
          lower *= in(.6, 1);
          break;
        case LegPose::kStork:
          raise = leads ? varied(.03, .06) : in(.5, 1.2);
          flex = leads ? varied(0, .06) : -in(1.3, 2.4);
          break;
        case LegPose::kLunge:
          raise = ahead * (leads ? in(.8, 1.3) : -in(.6, 1.1));
          flex = leads ? -ahead * in(.8, 1.3) : -ahead * in(-.1, .5);
          break;
        case LegPose::kSquat:
          raise = varied(2.1, .25), flex = -varied(1.9, .3);
          length *= in(.8, 1.2);
          break;
        case LegPose::kArabesque:
          raise = leads ? varied(.02, .08) : in(1.0, 2.3);
          flex = leads ? varied(0, .06) : gauss(0, .25);
          break;
        case LegPose::kLotus:
          raise = varied(1.2, .15), flex = -in(2.0, 2.7);
          length *= in(.7, 1);
          break;
      }
      leg.middle = leg.root + rotated(down, -sign * raise) * length * upper;
      leg.end = leg.middle + rotated(down, -sign * (raise + flex)) * length * lower;
      if (wavy) leg.wave = length * gauss(0, .12);
    }
  }

  Rng& rng_;
  BipedPlan plan_;
  double shoulder_offset_ = 0, hip_offset_ = 0;
};

}  // namespace

Eigen::Vector2d rotated(const Eigen::Vector2d& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

BipedPlan sampleBipedPlan(Rng& rng, BodyKind kind) { return Sampler(rng, kind).sample(); }

}  // namespace skel
