#include "trainer/figures/biped_painter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "trainer/figures/limb_path.h"
#include "trainer/figures/painting.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;
enum class Hand { kNone, kBall, kMitten, kFingers, kRays, kClaw, kPointing };
enum class Foot { kNone, kOutwards, kSideways, kDown, kToes };

class Painter {
 public:
  Painter(Rng& rng, const BipedPlan& plan) : rng_(rng), p_(plan) {}

  PaintedBiped paint() {
    sampleStyle();
    sampleLimbs();
    joints_.head = p_.head;
    paintBehind();
    for (const int s : {kRight, kLeft}) {
      if (!p_.arms[s].in_front) paintArm(s);
    }
    const bool legs_over_torso = p_.sitting ? chance(.85) : chance(.25);
    if (!legs_over_torso) paintLegs();
    paintTorso();
    if (legs_over_torso) paintLegs();
    paintClothes();
    for (const int s : {kRight, kLeft}) {
      if (p_.arms[s].in_front && !p_.arms[s].before_head) paintArm(s);
    }
    paintHead();
    for (const int s : {kRight, kLeft}) {
      if (p_.arms[s].in_front && p_.arms[s].before_head) paintArm(s);
    }
    paintHeldByBoth();
    paintDetails();

    PaintedBiped out{std::move(scene_), {}};
    out.joints[0] = joints_.head;
    out.joints[1] = p_.middle;
    for (const int s : {kRight, kLeft}) {
      const int first = s == kLeft ? 2 : 8;
      for (int k = 0; k < 3; ++k) {
        out.joints[first + k] = joints_.arm[s][k];
        out.joints[first + 3 + k] = joints_.leg[s][k];
      }
    }
    return out;
  }

 private:
  bool chance(double p) { return rng_.chance(p); }
  double in(double low, double high) { return rng_.uniform(low, high); }
  double gauss(double mean, double deviation) { return rng_.normal(mean, deviation); }
  double sign() { return chance(.5) ? 1 : -1; }
  bool is(BodyKind kind) const { return p_.kind == kind; }

  Colour randomColour(double low = 40, double high = 245) { return skel::randomColour(rng_, low, high); }
  Ink ink(const Colour& fill) const { return partInk(style_, fill, rim_colour_, rim_width_); }

  void sampleStyle() {
    const double r = rng_.uniform();
    style_ = r < .40 ? Style::kFlat : r < .70 ? Style::kCartoon : r < .93 ? Style::kPaper : Style::kHollow;
    if (is(BodyKind::kStick) && style_ == Style::kHollow) style_ = Style::kPaper;
    const double dark = in(0, 90);
    rim_colour_ = {std::uint8_t(dark), std::uint8_t(dark), std::uint8_t(dark + 10)};
    switch (style_) {
      case Style::kFlat:
        rim_width_ = 0;
        break;
      case Style::kCartoon:
        rim_width_ = in(.004, .016);
        break;
      case Style::kPaper:
        rim_width_ = in(.004, .014);
        break;
      case Style::kHollow:
        rim_width_ = in(.011, .030);
        break;
    }
    skin_ = randomColour();
    hair_ = chance(.2) ? skin_ : randomColour(15, 220);
    top_ = chance(.2) ? skin_ : randomColour();
    trousers_ = chance(.25) ? top_ : randomColour();
    shoes_ = chance(.3) ? trousers_ : randomColour(15, 245);
    accent_ = randomColour();
    if (style_ == Style::kPaper) {
      const Colour paper = randomColour(200, 250);
      for (Colour* c : {&skin_, &hair_, &top_, &trousers_, &shoes_, &accent_}) {
        if (chance(.8)) *c = paper;
      }
    }
  }

  void sampleLimbs() {
    limb_radius_ = std::max(kThinnest, p_.limb_width * .5 * in(.8, 1.15));
    const bool thin = is(BodyKind::kStick) || (is(BodyKind::kChild) && chance(.5));
    hand_ = static_cast<Hand>(weighted({.2, .34, .22, .1, thin ? .25 : .03, .03, .05}));
    foot_ = static_cast<Foot>(weighted({.18, .40, .30, .07, .05}));
    if (p_.view == FigureView::kSide && foot_ == Foot::kOutwards) foot_ = Foot::kSideways;
    hand_size_ = in(.9, 1.9) * (thin ? 1.6 : 1);
    arm_taper_ = in(.6, 1.25);
    sleeve_ = chance(.45) ? in(.2, 1) : 0;
    sleeve_width_ = in(.95, 1.75);
    if (chance(.1)) {  // a robe's
      sleeve_ = in(.5, .95);
      sleeve_width_ = in(1.6, 3);
    }
    glove_ = chance(.1) ? in(.12, .4) : 0;

    leg_radius_ = std::max(kThinnest, limb_radius_ * in(1, 1.8));
    if (p_.view != FigureView::kSide) {
      const double hips = (p_.legs[kLeft].root - p_.legs[kRight].root).norm() / 2;
      leg_radius_ = std::min(leg_radius_, std::max(hips * 1.3, limb_radius_));
    }
    leg_taper_ = in(.55, 1.05);
    flare_ = chance(.2) ? in(1, 2.2) : 1;  // of trouser legs
    trouser_length_ = chance(.3) ? in(.15, .9) : 1;
    trouser_width_ = chance(.3) ? in(1, 1.7) : 1;
    boot_ = chance(.14) ? in(.2, .5) : 0;
    boot_width_ = in(1.0, 1.8);
    foot_length_ = chance(.08) ? in(2.3, 3.6) : in(.6, 2.3);
    foot_height_ = in(.65, 1.2);
  }

  int weighted(std::initializer_list<double> weights) {
    double sum = 0;
    for (const double w : weights) sum += w;
    double r = rng_.uniform() * sum;
    int i = 0;
    for (const double w : weights) {
      if (r < w || i + 1 == static_cast<int>(weights.size())) break;
      r -= w;
      ++i;
    }
    return i;
  }

  // ---- behind the body

  void paintBehind() {
    const double T = p_.torso, H = p_.head_height, L = p_.leg;
    if (p_.on_chair) paintSeat();
    if (chance(.025)) paintBoard();
    if (chance(.08)) {  // cape
      const Vec hem = p_.pelvis - p_.up * L * in(-.2, 1);
      const bool wind = chance(.35);
      const double w = p_.top * in(1.1, 2.6), skew = wind ? sign() * in(.6, 1.8) * w : gauss(0, .4) * w;
      scene_.begin(ink(accent_), PartOwner::kAppendix);
      scene_.polygon({p_.neck + p_.chest_right * p_.top * .8, p_.neck - p_.chest_right * p_.top * .8,
                      hem + p_.right * (skew - w), hem - p_.up * in(-.05, .05) + p_.right * skew,
                      hem + p_.right * (skew + w)});
    }
    if (chance(is(BodyKind::kPlush) ? .35 : .07)) paintTail();
    if (chance(.1)) paintWings();
    if (chance(.07)) {  // backpack, shell, tank
      const double off = p_.view == FigureView::kFront ? gauss(0, .15) : -p_.face * in(.4, 1.2);
      scene_.begin(ink(accent_));
      scene_.ellipse(p_.middle + p_.chest_up * T * in(-.1, .25) + p_.chest_right * p_.top * off,
                     Vec(p_.top * in(.5, 1.3), T * in(.25, .6)) * (chance(.3) ? in(1.1, 1.7) : 1),
                     angleOf(p_.chest_right), in(2, 5));
    }
    if (chance(.03)) {  // spikes from the back
      const int n = 2 + rng_.below(5);
      const double length = T * in(.4, 1), from = in(-.3, .4), step = in(.2, .5);
      scene_.begin(ink(accent_));
      for (const double s : {-1., 1.}) {
        for (int k = 0; k < n; ++k) {
          const Vec d = rotated(p_.chest_right * s, -s * (from + step * k));
          scene_.line(p_.middle + p_.chest_up * T * .3,
                      p_.middle + p_.chest_up * T * .3 + d * (length + p_.top), limb_radius_ * in(.5, 1),
                      kThinnest);
        }
      }
    }
    if (chance(.17)) {  // long hair
      const double l = in(.2, 1.1) * T + H * .3, w = p_.head_width * in(.43, .6), tip = w * in(.4, 1.4);
      const Vec end = p_.head - p_.head_up * (H * .3 + l) + p_.head_right * gauss(0, .12) * w;
      scene_.begin(ink(hair_), PartOwner::kHair);
      scene_.polygon({p_.head + p_.head_right * w, p_.head - p_.head_right * w, end - p_.head_right * tip,
                      end - p_.head_up * in(0, .3) * l * .3, end + p_.head_right * tip});
    }
    if (chance(.08)) {  // pony tail, hair in the wind
      const Vec d = rotated(p_.head_right * -p_.face, in(-.9, .9));
      const double l = H * in(.5, 1.7);
      scene_.begin(ink(hair_), PartOwner::kHair);
      scene_.path(flowing(p_.head + p_.head_up * H * .2 + d * p_.head_width * .4,
                          p_.head + d * (p_.head_width * .5 + l * .5) + p_.head_up * H * in(-.1, .3),
                          p_.head + d * (p_.head_width * .5 + l) + p_.head_up * H * in(-.8, .2)),
                  radiiThrough(H * in(.04, .16), H * in(.06, .24), H * in(.02, .16)));
    }
    if (chance(.03)) {  // ends of a scarf
      const Vec d = rotated(p_.chest_right * sign(), in(-.5, .9));
      const double l = T * in(.4, 1.3);
      scene_.begin(ink(accent_), PartOwner::kAppendix);
      scene_.path(flowing(p_.neck, p_.neck + d * l * .5 + p_.chest_up * l * gauss(0, .2),
                          p_.neck + d * l + p_.chest_up * l * gauss(0, .3)),
                  radiiThrough(limb_radius_ * .6, limb_radius_ * in(.5, 1.3), limb_radius_ * in(.5, 1.6)));
    }
  }

  // A box, a stool, a chair with a back.
  void paintSeat() {
    const double L = p_.leg, w = std::max(p_.bottom, .05) * in(1, 1.8);
    const Vec top = p_.pelvis - p_.up * leg_radius_ * in(.5, 1.2) - p_.right * p_.face * w * in(0, .6);
    const Vec floor = top - p_.up * L * in(.45, .75);
    const double thick = L * in(.04, .12), leg = std::max(kThinnest, L * in(.02, .06));
    scene_.begin(ink(accent_));
    if (chance(.4)) {
      scene_.polygon({top - p_.right * w, top + p_.right * w, floor + p_.right * w, floor - p_.right * w});
    } else {
      scene_.line(top - p_.right * w, top + p_.right * w, thick, thick);
      for (const double s : {-1., 1.})
        scene_.line(top + p_.right * s * w * .9, floor + p_.right * s * w * in(.8, 1.1), leg, leg);
    }
    if (chance(.4)) {
      const Vec edge = top - p_.right * p_.face * w;
      scene_.line(edge, edge + p_.up * p_.torso * in(.3, 1), thick, thick);
    }
  }

  // Under the feet: skateboard, surfboard, skis, ground, a cloud.
  void paintBoard() {
    const Vec &a = p_.legs[kRight].end, &b = p_.legs[kLeft].end;
    const Vec low = a.dot(p_.up) < b.dot(p_.up) ? a : b;
    const Vec middle(((a + b) / 2).x(), low.y() + leg_radius_ * in(.3, 1.2));
    const double half = std::max((a - b).norm() * .5, .08) * in(1, 2);
    scene_.begin(ink(accent_));
    scene_.ellipse(middle, {half, half * in(.05, .3)}, gauss(0, .12), in(2, 5));
    if (chance(.3)) {
      for (const double s : {-.7, .7}) scene_.disc(middle + Vec(s * half, half * .15), half * in(.08, .18));
    }
  }

  void paintTail() {
    const double T = p_.torso;
    const Vec d = rotated(p_.right * sign(), in(-.9, .9)), a = p_.pelvis + p_.up * T * in(0, .2);
    const double l = T * in(.4, 1.8);
    scene_.begin(ink(skin_), PartOwner::kAppendix);
    if (chance(.25)) {  // as a lizard's: as thick as the hips, down to the ground
      const double side = p_.view == FigureView::kFront ? sign() : -p_.face;
      const Vec tip =
          p_.pelvis + p_.right * side * (p_.bottom + T * in(.5, 1.6)) - p_.up * p_.leg * in(.1, 1);
      scene_.path(
          flowing(p_.pelvis, p_.pelvis + p_.right * side * (p_.bottom + l * .3) - p_.up * p_.leg * in(.1, .6),
                  tip),
          radiiThrough(p_.bottom * in(.4, .9), p_.bottom * in(.2, .5), kThinnest));
      return;
    }
    if (chance(.25)) {
      scene_.disc(a + d * p_.bottom * in(.8, 1.1), T * in(.08, .2));
      return;
    }
    const double r = limb_radius_;
    scene_.path(
        flowing(a, a + d * l * .5 + p_.up * l * gauss(0, .2), a + d * l * .8 + p_.up * l * in(-.3, .9)),
        radiiThrough(r * in(.4, 1.1), r * in(.3, 1.5), r * in(.1, 1.3)));
  }

  void paintWings() {
    const double T = p_.torso, l = T * in(.5, 1.8), w = l * in(.3, .8), from = in(-.6, .9);
    const int n = 1 + rng_.below(3), kind = weighted({.5, .3, .2});
    const Vec base = p_.middle + p_.chest_up * T * in(.05, .35);
    const Colour colour = randomColour(120, 250);
    for (const double s : {-1., 1.}) {
      if (p_.view == FigureView::kSide && s == p_.face) continue;
      scene_.begin(ink(colour), PartOwner::kAppendix);
      for (int k = 0; k < n; ++k) {
        const Vec d = rotated(p_.chest_right * s, -s * (from - k * in(.45, 1)));
        const Vec side = leftOf(d);
        if (kind == 0) {  // leaf
          scene_.ellipse(base + d * l * .55, {l * .55, w * .5}, angleOf(d));
        } else if (kind == 1) {  // triangle with a jagged edge
          scene_.polygon({base, base + d * l + side * w * .6, base + d * l * .75 + side * w * .1,
                          base + d * l * .8 - side * w * .5, base + d * l * .4 - side * w * .3});
        } else {  // feathers
          const int feathers = 3 + rng_.below(3);
          for (int f = 0; f < feathers; ++f) {
            const Vec e = rotated(d, s * f * .28);
            scene_.line(base, base + e * l * (1 - .12 * f), w * .12, w * .16);
          }
        }
        if (n > 1 && kind != 0) break;
      }
    }
  }

  // ---- limbs

  // The seam of a limb at the body, painted over so that no line parts them.
  void hideSeam(const LimbPath& path, double radius, const Colour& colour, PartOwner owner) {
    if (rim_width_ == 0 || style_ == Style::kHollow || !chance(.5)) return;
    const Vec towards = normalised(p_.middle - path[0]);
    Ink i = ink(colour);
    i.rim_width = 0;
    i.inside_only = true;
    scene_.begin(i, owner);
    scene_.line(path[1], path[0] + towards * radius, radius * .9, radius * .8);
  }

  void paintArm(int s) {
    const LimbPlan& arm = p_.arms[s];
    const PartOwner owner = s == kLeft ? PartOwner::kLeftArm : PartOwner::kRightArm;
    const LimbPath path = limbPath(arm);
    const double r = limb_radius_, end_r = std::max(kThinnest, r * arm_taper_);
    const bool far = p_.view == FigureView::kSide && s != p_.near_side && chance(.5);
    const auto shade = [&](Colour c) {
      if (far) {
        for (auto& v : c) v = static_cast<std::uint8_t>(v * .8);
      }
      return c;
    };
    const Vec direction = normalised(path[kLimbPoints - 1] - path[kLimbPoints - 2]);
    const bool prop_behind = chance(.4);
    const bool has_prop = chance(.15);
    Vec hand = arm.end;
    const Colour lower = sleeve_ > .8 ? top_ : skin_;

    if (has_prop && prop_behind) paintProp(hand, direction);
    if (sleeve_ <= .8) {
      scene_.begin(ink(shade(lower)), owner);
      scene_.path(path, radiiThrough(r, r, end_r));
      hand += paintHand(hand, direction, end_r, sideSign(s));
    } else {
      scene_.begin(ink(shade(glove_ > 0 ? accent_ : skin_)), owner);
      hand += paintHand(hand, direction, end_r, sideSign(s));
    }
    if (glove_ > 0) paintPart(path, 1 - glove_, 1, end_r * 1.25, end_r * 1.15, shade(accent_), owner);
    if (sleeve_ > 0) {
      paintPart(path, 0, std::min(1.0, sleeve_), r * std::min(sleeve_width_, 1.2), r * sleeve_width_,
                shade(top_), owner);
    }
    hideSeam(path, r, sleeve_ > 0 ? top_ : skin_, owner);
    if (chance(shoulder_pads_)) {
      scene_.begin(ink(accent_), owner);
      scene_.ellipse(path[0], {r * in(1.3, 2.6), r * in(1, 2)}, in(0, kPi), in(2, 4));
    }
    if (has_prop && !prop_behind) paintProp(hand, direction);
    joints_.arm[s] = {arm.root, arm.middle, hand};
  }

  // A stretch of a limb in another colour: a sleeve, a glove, a boot, a trouser leg.
  void paintPart(const LimbPath& path, double from, double to, double radius_from, double radius_to,
                 const Colour& colour, PartOwner owner) {
    constexpr int kPoints = 6;
    std::array<Vec, kPoints> centres;
    std::array<double, kPoints> radii;
    for (int i = 0; i < kPoints; ++i) {
      const double t = from + (to - from) * i / (kPoints - 1);
      const double at = t * (kLimbPoints - 1);
      const int k = std::min(static_cast<int>(at), kLimbPoints - 2);
      centres[i] = path[k] + (path[k + 1] - path[k]) * (at - k);
      radii[i] = std::max(kThinnest, radius_from + (radius_to - radius_from) * i / (kPoints - 1));
    }
    scene_.begin(ink(colour), owner);
    scene_.path(centres, radii);
  }

  // Adds the hand to the current part; returns where its joint lies, seen from the end of the arm.
  Vec paintHand(const Vec& wrist, const Vec& d, double r, double outwards) {
    const double size = r * hand_size_;
    switch (hand_) {
      case Hand::kNone:
        return -d * r * in(-.3, .6);
      case Hand::kBall:
        scene_.disc(wrist + d * r * hand_size_ * .5, size);
        return d * size * in(.2, .6);
      case Hand::kMitten: {
        const double l = size * 1.6;
        scene_.ellipse(wrist + d * l * .6, {l, size}, angleOf(d));
        const Vec thumb = rotated(d, outwards * in(.6, 1.3) * sign());
        scene_.line(wrist + d * l * .3, wrist + d * l * .3 + thumb * l, r * .5, r * .4);
        return d * l * in(.2, .6);
      }
      case Hand::kFingers: {
        scene_.disc(wrist + d * r * .5, size * .75);
        const int n = 3 + rng_.below(3);
        const double fan = in(.5, 1.1), l = in(1.8, 3.2), w = std::max(kThinnest, r * .38);
        for (int k = 0; k < n; ++k) {
          const Vec v = rotated(d, (k / (n - 1.0) - .5) * 2 * fan);
          scene_.line(wrist + d * r * .5, wrist + d * r * .5 + v * size * l * in(.7, 1), w, w * .8);
        }
        return d * size * in(.2, .8);
      }
      case Hand::kRays: {
        const int n = 3 + rng_.below(4);
        const double fan = in(.6, 1.5), l = std::max(.03, size * in(1.5, 4));
        for (int k = 0; k < n; ++k) {
          scene_.line(wrist, wrist + rotated(d, (k / (n - 1.0) - .5) * 2 * fan) * l, kThinnest, kThinnest);
        }
        return d * l * in(0, .3);
      }
      case Hand::kClaw:
        for (const double a : {-.6, .6}) {
          scene_.line(wrist, wrist + rotated(d, a) * size * 1.5, r * .7, r * .5);
          scene_.line(wrist + rotated(d, a) * size * 1.5, wrist + rotated(d, a * .3) * size * 3, r * .5,
                      r * .3);
        }
        return d * size * in(.2, .8);
      case Hand::kPointing:
        scene_.disc(wrist + d * r * .5, size);
        scene_.line(wrist + d * r * .5, wrist + d * size * 2.6, std::max(kThinnest, r * .4),
                    std::max(kThinnest, r * .35));
        return d * size * in(.2, .6);
    }
    return Vec::Zero();
  }

  void paintProp(const Vec& hand, const Vec& d) {
    const double w = std::max(p_.limb_width, .03), A = p_.arm;
    const Vec v = rotated(d, gauss(0, 1.2));
    scene_.begin(ink(accent_));
    switch (weighted({.22, .18, .14, .1, .12, .08, .06, .1})) {
      case 0: {  // stick
        double l = A * in(.4, 1.6), below = l * in(0, .4);
        if (chance(.25)) {  // a staff, a spear, a broom: to the ground
          l = A * in(.5, 2);
          below = A * in(.5, 1.6);
        }
        scene_.line(hand - v * below, hand + v * l, std::max(kThinnest, w * in(.1, .4)),
                    std::max(kThinnest, w * in(.1, .5)));
        break;
      }
      case 1:  // ball
        scene_.disc(hand + d * w * in(0, 1.5), w * in(.6, 2.5));
        break;
      case 2: {                                                            // box, bag, phone, book
        const double half = chance(.3) ? A * in(.25, .8) : w * in(.4, 2);  // or a crate, a map, a board
        scene_.ellipse(hand + d * (chance(.5) ? half * in(0, 1) : w * in(0, 1)), {half, half * in(.5, 1.8)},
                       angleOf(v), chance(.7) ? 6 : 2);
        break;
      }
      case 3: {  // shield
        const double half = A * in(.25, .6);
        scene_.ellipse(hand + d * half * in(-.3, .2), {half, half * in(.7, 1.3)}, angleOf(p_.chest_right),
                       in(2, 4));
        if (chance(.6)) {
          scene_.begin(ink(randomColour()));
          scene_.disc(hand, half * in(.2, .6));
        }
        break;
      }
      case 4: {  // sword
        const double l = A * in(.7, 1.8), b = w * in(.15, .4);
        scene_.polygon({hand - leftOf(v) * b, hand + v * l * .85 - leftOf(v) * b, hand + v * l,
                        hand + v * l * .85 + leftOf(v) * b, hand + leftOf(v) * b});
        scene_.line(hand + v * w * .4 - leftOf(v) * w, hand + v * w * .4 + leftOf(v) * w, w * .2, w * .2);
        scene_.line(hand, hand - v * w * .9, w * .2, w * .25);
        break;
      }
      case 5: {  // wand with a star, flower
        const double l = A * in(.3, .9), star = w * in(.5, 1.1);
        scene_.line(hand - v * l * in(0, .3), hand + v * l, kThinnest, kThinnest);
        const double turn = in(0, 1);
        std::array<Vec, 10> corners;
        for (int k = 0; k < 10; ++k) {
          corners[k] = hand + v * l + rotated(v, turn + k * kPi / 5) * star * (k % 2 ? .5 : 1.2);
        }
        scene_.polygon(corners);
        break;
      }
      case 6: {  // umbrella, balloon
        const double l = A * in(.8, 1.6), large = chance(.3) ? in(1.2, 2) : 1;
        const Vec up = rotated(p_.chest_up, gauss(0, .3));
        scene_.line(hand, hand + up * l, kThinnest, kThinnest);
        scene_.ellipse(hand + up * l, Vec(A * in(.2, .5), A * in(.15, .4)) * large, angleOf(p_.chest_right));
        break;
      }
      case 7: {  // tool: a handle with a head
        const double l = A * in(.5, 1.3);
        scene_.line(hand - v * l * in(0, .4), hand + v * l, std::max(kThinnest, w * in(.12, .25)),
                    std::max(kThinnest, w * in(.12, .25)));
        scene_.ellipse(hand + v * l, {w * in(.4, 1), w * in(.6, 1.8)}, angleOf(v), in(2, 6));
        break;
      }
    }
  }

  void paintHeldByBoth() {
    if (!chance(.06)) return;
    const Vec a = joints_.arm[kRight][2], b = joints_.arm[kLeft][2];
    const Vec v = normalised(b - a);
    const double w = std::max(p_.limb_width, .04);
    scene_.begin(ink(accent_));
    const double kind = rng_.uniform();
    if (kind < .25) {  // guitar, broom, saw, rope: beyond both hands
      const double over = p_.torso * in(.1, .8), r = w * in(.1, .4);
      scene_.line(a - v * over, b + v * over * in(0, 1), r, r);
      if (chance(.6))
        scene_.ellipse(a, {p_.torso * in(.15, .4), p_.torso * in(.1, .3)}, angleOf(v), in(2, 5));
    } else if (kind < .55) {  // bar with weights
      const double over = w * in(.5, 2.5), half = w * in(.8, 2);
      scene_.line(a - v * over, b + v * over, w * .2, w * .2);
      for (const Vec& q : {Vec(a - v * over), Vec(b + v * over)}) {
        scene_.ellipse(q, {half * in(.2, .5), half}, angleOf(v), 5);
      }
    } else {  // box
      const double half = (b - a).norm() * .5;
      const double large = chance(.3) ? in(1.2, 2) : 1;
      scene_.ellipse((a + b) / 2, Vec(std::max(half, w), std::max(half * in(.4, 1), w)) * large, angleOf(v),
                     in(2, 6));
    }
  }

  void paintLegs() {
    const int first = p_.legs[kLeft].in_front ? kRight : kLeft;
    for (const int s : {first, 1 - first}) paintLeg(s);
  }

  void paintLeg(int s) {
    const LimbPlan& leg = p_.legs[s];
    const PartOwner owner = s == kLeft ? PartOwner::kLeftLeg : PartOwner::kRightLeg;
    const LimbPath path = limbPath(leg);
    const double r = leg_radius_, end_r = std::max(kThinnest, r * leg_taper_);
    const Vec d = normalised(path[kLimbPoints - 1] - path[kLimbPoints - 2]);
    const bool bare = trouser_length_ < 1;

    // The shoe first: trousers fall over it.
    scene_.begin(ink(foot_ == Foot::kToes || foot_ == Foot::kNone ? skin_ : shoes_), owner);
    const Vec foot = leg.end + paintFoot(leg.end, d, end_r, sideSign(s));
    if (boot_ > 0) {
      paintPart(path, 1 - boot_, 1, end_r * boot_width_, end_r * std::min(boot_width_, 1.3), shoes_, owner);
    }
    scene_.begin(ink(bare ? skin_ : trousers_), owner);
    const double hem = bare ? end_r : end_r * flare_;
    LimbRadii radii = radiiThrough(r, (r + end_r) / 2, end_r);
    for (int i = kLimbPoints - 4; i < kLimbPoints; ++i)
      radii[i] += (hem - end_r) * (i - kLimbPoints + 4) / 3.;
    if (boot_ > 0) {
      constexpr int kCut = kLimbPoints - 3;
      scene_.path(std::span(path).first(kCut), std::span(radii).first(kCut));
    } else {
      scene_.path(path, radii);
    }
    if (bare) {
      const double w = r + (end_r - r) * trouser_length_;
      paintPart(path, 0, trouser_length_, r * std::min(trouser_width_, 1.15), w * trouser_width_, trousers_,
                owner);
    }
    hideSeam(path, r, trousers_, owner);
    // Where the leg is seen to begin is a little below where it turns.
    const bool short_legs = p_.leg < .32;
    const Vec hip = path[0] + (path[2] - path[0]) * in(0, short_legs ? .9 : .4);
    joints_.leg[s] = {hip, leg.middle, foot};
  }

  Vec paintFoot(const Vec& ankle, const Vec& d, double r, double outwards) {
    const double towards = foot_ == Foot::kOutwards ? outwards : foot_ == Foot::kSideways ? p_.face : 0;
    if (towards != 0 || foot_ == Foot::kToes) {
      Vec tip = leftOf(d);
      if (tip.dot(p_.right) * (towards != 0 ? towards : outwards) < 0) tip = -tip;
      tip += d * gauss(0, .15);
      const double h = r * foot_height_;
      const Vec q = ankle + tip * r * foot_length_;
      if (foot_ == Foot::kToes) {
        scene_.line(ankle + d * h * .1, q + d * h * .2, h, h * .8);
        for (int k = 0; k < 3; ++k)
          scene_.disc(q + rotated(tip, (k - 1) * .8) * h * .9, std::max(kThinnest, h * .35));
      } else if (chance(.3)) {
        scene_.polygon({ankle + d * h * .8 - tip * r * .8, q + d * h * .8, q, ankle - d * h * .5});
      } else {
        scene_.line(ankle + d * h * .1, q + d * h * .2, h, h * in(.6, 1.2));
      }
      return tip * r * foot_length_ * in(0, .45) - d * r * in(-.1, .5);
    }
    if (foot_ == Foot::kDown) {
      scene_.ellipse(ankle + d * r, {r * 1.8, r * foot_height_}, angleOf(d));
      return d * r * in(0, .6);
    }
    return -d * r * in(-.1, .7);
  }

  // ---- torso

  Vec spine(double t) const {
    const Vec control = 2 * p_.middle - .5 * (p_.pelvis + p_.neck);
    return (1 - t) * (1 - t) * p_.pelvis + 2 * t * (1 - t) * control + t * t * p_.neck;
  }

  void paintTorso() {
    const double T = p_.torso, H = p_.head_height;
    scene_.begin(ink(top_), PartOwner::kTorso);
    if (is(BodyKind::kStick) && p_.top < .06) {
      std::array<Vec, kLimbPoints> centres;
      std::array<double, kLimbPoints> radii;
      for (int i = 0; i < kLimbPoints; ++i) centres[i] = spine(i / (kLimbPoints - 1.));
      radii.fill(std::max(limb_radius_, p_.top));
      scene_.path(centres, radii);
    } else {
      constexpr int kRows = 8;
      std::array<Vec, 2 * kRows> outline;
      for (int i = 0; i < kRows; ++i) {
        const double t = i / (kRows - 1.);
        const double w = t < .5 ? p_.bottom + (p_.waist - p_.bottom) * 2 * t
                                : p_.waist + (p_.top - p_.waist) * (2 * t - 1);
        outline[i] = spine(t) + p_.right * w;
        outline[2 * kRows - 1 - i] = spine(t) - p_.right * w;
      }
      scene_.polygon(outline);
      const int shape = weighted({.45, .22, .33});
      if (shape > 0) {
        const double r = std::min(p_.bottom, p_.top) * in(.4, .9);
        scene_.line(p_.neck - p_.chest_right * (p_.top - r) - p_.chest_up * r * .5,
                    p_.neck + p_.chest_right * (p_.top - r) - p_.chest_up * r * .5, r, r);
        scene_.line(p_.pelvis - p_.right * (p_.bottom - r * .8) + p_.up * r * .4,
                    p_.pelvis + p_.right * (p_.bottom - r * .8) + p_.up * r * .4, r * .9, r * .9);
      }
      if (shape == 1 || is(BodyKind::kPlush)) {
        scene_.ellipse(p_.middle, {std::max({p_.waist, p_.bottom, p_.top}) * in(.95, 1.25), T * in(.5, .62)},
                       angleOf(p_.right));
      }
      if (p_.view != FigureView::kFront && chance(.25)) {  // belly or chest seen from the side
        scene_.ellipse(
            p_.middle + p_.chest_up * T * in(-.25, .25) + p_.chest_right * p_.face * p_.waist * in(.2, .7),
            {p_.waist * in(.5, 1), T * in(.2, .45)}, angleOf(p_.right));
      }
      if (chance(.6)) scene_.ellipse(p_.pelvis, {p_.bottom, p_.bottom * in(.2, .6)}, angleOf(p_.right));
      if (chance(.5)) {  // sloping shoulders
        const Vec chin = p_.neck + p_.chest_up * (std::max(p_.neck_gap, 0.) + H * .05);
        const double w = p_.head_width * .2;
        scene_.polygon({p_.neck + p_.chest_right * p_.top, p_.neck - p_.chest_right * p_.top,
                        chin - p_.chest_right * w, chin + p_.chest_right * w});
      }
    }
    double neck_r = std::min(p_.head_width * .3, std::max(p_.top * .6, limb_radius_)) * in(.4, 1);
    if (is(BodyKind::kStick)) neck_r = limb_radius_;
    neck_r = std::max(neck_r, kThinnest);
    scene_.begin(ink(skin_), PartOwner::kTorso);
    scene_.line(p_.neck - p_.chest_up * T * .05, p_.head, neck_r, neck_r);
  }

  void paintClothes() {
    const double T = p_.torso, L = p_.leg;
    const Vec knees = (p_.legs[kRight].middle + p_.legs[kLeft].middle) / 2;
    const Vec down = (knees - p_.pelvis).norm() > L * .15 ? normalised(knees - p_.pelvis) : Vec(-p_.up);
    Vec across = leftOf(down);
    if (across.dot(p_.right) < 0) across = -across;

    if (chance(p_.sitting ? .05 : .17)) {  // skirt, dress, robe
      const bool robe = chance(.3);        // down to the shoes
      const double l = L * (robe ? in(.8, 1.1) : in(.12, 1.05)), w = std::max(p_.bottom, .04) * in(1, 2.6);
      const double from = chance(.3) ? in(.6, 1) : in(.05, .5);
      const Vec top = spine(from), hem = p_.pelvis + down * l;
      const double w0 = std::max(p_.waist, p_.bottom) * in(.75, 1.05);
      scene_.begin(ink(robe || chance(.5) ? top_ : accent_), PartOwner::kSkirt);
      const double sag = in(-.05, .12) * w;
      scene_.polygon({top - p_.right * w0, top + p_.right * w0, hem + across * w,
                      hem + down * sag + across * w * .4, hem + down * sag - across * w * .4,
                      hem - across * w});
    } else if (chance(p_.sitting ? .03 : .1)) {  // open coat: two panels
      const double l = L * in(.1, .85), w = std::max(p_.bottom, .03) * in(1, 1.8);
      const Colour colour = chance(.5) ? top_ : accent_;
      const Vec hem = p_.pelvis + down * l;
      for (const double s : {-1., 1.}) {
        const double gap = w * in(.05, .7);
        scene_.begin(ink(colour), PartOwner::kSkirt);
        scene_.polygon({p_.neck + p_.chest_right * s * p_.top * .3, p_.neck + p_.chest_right * s * p_.top,
                        p_.pelvis + p_.right * s * p_.bottom * in(1, 1.25), hem + across * s * w,
                        hem + across * s * gap, p_.middle + p_.chest_right * s * p_.waist * in(.1, .5)});
      }
    }
    if (chance(.06)) {  // scarf, collar
      scene_.begin(ink(accent_), PartOwner::kTorso);
      scene_.ellipse(p_.neck + p_.chest_up * T * in(-.02, .06), {p_.top * in(.4, .95), T * in(.06, .16)},
                     angleOf(p_.chest_right));
    }
    if (chance(.04)) {  // bag at the hip
      const double s = sign();
      scene_.begin(ink(accent_));
      scene_.ellipse(p_.pelvis + p_.right * s * p_.bottom * in(.9, 1.3) + p_.up * T * in(-.1, .2),
                     {T * in(.08, .25), T * in(.08, .25)}, in(-.3, .3), in(2, 5));
    }
    shoulder_pads_ = chance(.06) ? 1 : 0;
  }

  // ---- head

  void paintHead() {
    const double H = p_.head_height, W = p_.head_width;
    const Vec up = p_.head_up, right = p_.head_right, c = p_.head;
    const double tilt = angleOf(right);
    const bool animal = is(BodyKind::kPlush) || chance(.06);
    const auto onHead = [&](double angle,
                            double reach) {  // a point on the head's ellipse, angle from the top
      const Vec v = rotated(up, angle);
      return Vec(c + right * v.dot(right) * W * .5 * reach + up * v.dot(up) * H * .5 * reach);
    };

    if (animal && chance(.9)) paintEars(.35, .95, .06, .55);

    scene_.begin(ink(skin_), PartOwner::kHead);
    switch (weighted({.48, .27, .15, .05, .05})) {
      case 0:
        scene_.ellipse(c, {W / 2, H / 2}, tilt);
        break;
      case 1:
        scene_.ellipse(c, {W / 2, H / 2}, tilt, in(2.3, 7));
        break;
      case 2:
        scene_.ellipse(c + up * H * .1, {W / 2, H * .4}, tilt);
        scene_.ellipse(c - up * H * .18, {W * in(.3, .45), H * .32}, tilt);
        break;
      case 3: {
        const double a = in(.1, .6);
        scene_.polygon({c + up * H / 2 + right * W * a, c + up * H / 2 - right * W * a,
                        c - up * H / 2 - right * W * .5, c - up * H / 2 + right * W * .5});
        break;
      }
      default: {  // lumpy, as drawn by hand
        std::array<Vec, 18> corners;
        const double p1 = in(0, 6), p2 = in(0, 6), a1 = in(0, .08), a2 = in(0, .07);
        for (int i = 0; i < 18; ++i) {
          const double t = 2 * kPi * i / 18;
          const double r = 1 + a1 * std::sin(2 * t + p1) + a2 * std::sin(3 * t + p2);
          corners[i] = c + right * W * .5 * r * std::cos(t) + up * H * .5 * r * std::sin(t);
        }
        scene_.polygon(corners);
      }
    }
    if (p_.view == FigureView::kSide && chance(.5)) {  // nose
      const Vec at = c + right * p_.face * W * .46 - up * H * in(-.1, .2);
      scene_.line(at, at + right * p_.face * H * in(.03, .15), H * in(.03, .08), H * in(.02, .05));
    }
    if (animal && chance(.7)) {  // muzzle, snout, beak
      const double s = p_.view == FigureView::kFront ? gauss(0, .1) : p_.face * in(.25, .6);
      scene_.begin(ink(chance(.5) ? skin_ : accent_), PartOwner::kHead);
      scene_.ellipse(c + right * s * W - up * H * in(.05, .25), {W * in(.15, .4), H * in(.12, .28)}, tilt);
    }
    if (chance(.2)) {  // jaw or hair mass off the middle
      scene_.begin(ink(hair_), PartOwner::kHead);
      scene_.ellipse(c + right * W * gauss(0, .25) + up * H * in(-.3, .35),
                     {W * in(.3, .55), H * in(.2, .45)}, in(0, 3));
    }
    if (chance(.06)) {  // beard
      scene_.begin(ink(hair_), PartOwner::kHead);
      const double w = W * in(.2, .45), l = chance(.3) ? H * in(.6, 1) : H * in(.15, .6);
      scene_.polygon({c - up * H * .2 - right * w, c - up * H * .2 + right * w,
                      c - up * (H * .4 + l) + right * w * in(0, .8),
                      c - up * (H * .4 + l) - right * w * in(0, .8)});
    }
    paintHair(onHead);
    if (chance(.12)) paintHat();
    if (!animal && chance(.12)) paintEars(-.2, 1.9, .05, .5);
    if (chance(.07)) {  // pigtails
      const double a = in(.5, 1.8), l = H * in(.3, .9), r = H * in(.04, .14), droop = in(-.5, 1.2);
      scene_.begin(ink(hair_), PartOwner::kHead);
      for (const double s : {-1., 1.}) {
        const Vec v = rotated(up, s * a), b = onHead(s * a, .9), w = rotated(v, s * droop);
        scene_.path(flowing(b, b + v * l * .5, b + v * l * .5 + w * l * .5),
                    radiiThrough(r * .5, r * 1.2, r * .5));
      }
    }
    if (chance(.05)) {  // glass bowl, halo, hood
      const double r = std::max(H, W) * in(.56, .75);
      scene_.begin(ink(accent_), PartOwner::kHead);
      scene_.ring(c, r, std::max(.006, r * in(.03, .08)));
    }
    if (chance(.04)) {  // antennae
      for (const double s : {-1., 1.}) {
        const Vec v = rotated(up, s * in(.2, .7)), b = onHead(s * .3, .95);
        scene_.begin(ink(accent_), PartOwner::kHead);
        scene_.line(b, b + v * H * .35, kThinnest, kThinnest);
        scene_.disc(b + v * H * .35, H * in(.03, .08));
      }
    }
  }

  void paintEars(double low, double high, double thin, double longest) {
    const double H = p_.head_height, W = p_.head_width;
    const double a = in(low, high), l = H * in(.05, longest), r = H * in(thin, .17), tip = r * in(.2, 1.3);
    scene_.begin(ink(skin_), PartOwner::kHead);
    for (const double s : {-1., 1.}) {
      const Vec v = rotated(p_.head_up, s * a);
      const Vec b =
          p_.head + p_.head_right * v.dot(p_.head_right) * W * .47 + p_.head_up * v.dot(p_.head_up) * H * .47;
      scene_.line(b, b + v * l, r, tip);
    }
  }

  template <typename OnHead>
  void paintHair(const OnHead& onHead) {
    const double H = p_.head_height, W = p_.head_width;
    const Vec up = p_.head_up, right = p_.head_right, c = p_.head;
    if (chance(.25)) {  // cap of hair over the skull
      const double w = W * in(.48, .58), h = H * in(.4, .56);
      scene_.begin(ink(hair_), PartOwner::kHead);
      std::array<Vec, 14> corners;
      const double cut = in(-.15, .3);
      for (int i = 0; i < 12; ++i) {
        const double t = kPi * i / 11;
        corners[i] = c + right * w * std::cos(t) + up * (h * std::sin(t) + H * .02);
      }
      corners[12] = c - right * w * .5 + up * H * cut;
      corners[13] = c + right * w * .5 + up * H * cut;
      scene_.polygon(corners);
    }
    if (chance(.35)) {  // curls
      const int n = 2 + rng_.below(8);
      const double from = in(-.3, .3), r = in(.07, .3), fan = in(1.5, 4);
      scene_.begin(ink(hair_), PartOwner::kHead);
      for (int k = 0; k < n; ++k) {
        scene_.disc(onHead(from + (k / (n - 1.) - .5) * fan, in(.75, 1.05)), H * r * in(.6, 1.3));
      }
    }
    if (chance(.18)) {  // spikes
      const int n = 1 + rng_.below(7);
      const double fan = in(.2, 1.8), l = in(.6, 1.05);
      scene_.begin(ink(hair_), PartOwner::kHead);
      for (int k = 0; k < n; ++k) {
        const Vec v = rotated(up, in(-fan, fan)), b = leftOf(v), base = c + v * H * .3;
        scene_.polygon({c + v * H * l * in(.75, 1), base + b * W * in(.1, .3), base - b * W * in(.1, .3)});
      }
    }
    if (chance(.12)) {  // tuft, bun
      const Vec v = rotated(up, gauss(0, .6));
      scene_.begin(ink(hair_), PartOwner::kHead);
      scene_.ellipse(c + v * H * in(.5, .7), {H * in(.12, .4), H * in(.15, .45)}, in(0, 3.1));
      if (chance(.5)) {
        scene_.ellipse(c + rotated(v, gauss(0, .6)) * H * in(.45, .8), {H * in(.1, .3), H * in(.1, .3)}, 0);
      }
    }
    if (chance(.05)) {  // a mass of hair around the whole head
      scene_.begin(ink(hair_), PartOwner::kHead);
      scene_.ellipse(c + up * H * in(.05, .3) + right * W * gauss(0, .1), {W * in(.55, .85), H * in(.35, .6)},
                     in(-.3, .3));
    }
    if (chance(.04)) {  // puffs at both sides
      const double r = H * in(.12, .32), a = in(.9, 1.8);
      scene_.begin(ink(hair_), PartOwner::kHead);
      for (const double s : {-1., 1.}) {
        const Vec b = onHead(s * a, in(.95, 1.15));
        scene_.disc(b, r);
        if (chance(.5)) scene_.disc(b + up * r * in(-.8, .8) + right * s * r * in(0, .5), r * in(.6, .9));
      }
    }
    if (chance(.02)) {  // the cap of a mushroom, a sun hat
      scene_.begin(ink(hair_), PartOwner::kHead);
      const double w = W * in(.8, 1.4);
      scene_.ellipse(c + up * H * in(.3, .5), {w, H * in(.25, .5)}, angleOf(right), in(2, 3));
    }
    if (chance(.05)) {  // crest
      const double s = p_.view == FigureView::kFront ? sign() : -p_.face;
      scene_.begin(ink(accent_), PartOwner::kHead);
      scene_.path(flowing(onHead(.1 * s, .9), onHead(.5 * s, in(1.2, 1.6)), onHead(1.3 * s, in(1, 1.7))),
                  radiiThrough(H * in(.04, .1), H * in(.08, .2), H * in(.03, .12)));
    }
  }

  void paintHat() {
    const double H = p_.head_height, W = p_.head_width;
    const Vec up = p_.head_up, right = p_.head_right;
    const double brim = W * in(.45, .85), tall = std::min(H, .25) * in(.15, 1), thick = H * .07;
    const double tip = brim * in(0, .9), crown = std::max(tip, brim * in(.5, .8));
    const Vec base = p_.head + up * H * in(.18, .42), shift = right * gauss(0, .08) * brim;
    scene_.begin(ink(accent_), PartOwner::kHead);
    scene_.polygon({base + right * brim, base + up * thick + right * brim, base + up * thick + right * crown,
                    base + up * tall + right * tip + shift, base + up * tall - right * tip + shift,
                    base + up * thick - right * crown, base + up * thick - right * brim,
                    base - right * brim});
    if (chance(.3)) scene_.disc(base + up * tall + shift, H * in(.05, .14));
  }

  // ---- what is drawn on the figure: seen only as inner lines

  void paintDetails() {
    if (style_ == Style::kHollow || chance(.15)) return;
    const double H = p_.head_height, W = p_.head_width;
    const Vec up = p_.head_up, right = p_.head_right;
    const double forward = p_.view == FigureView::kFront ? 0 : p_.face * in(.05, .25);
    const Colour dark = randomColour(10, 90);
    if (chance(.85)) {
      const double eye = H * in(.02, .1), apart = W * in(.12, .26), high = in(-.12, .15);
      for (const double s : {-1., 1.}) {
        const Vec at = p_.head + right * (forward * W + s * apart) + up * H * high;
        if (chance(.3)) {
          scene_.begin(detail({250, 250, 250}));
          scene_.disc(at, eye * 1.6);
        }
        scene_.begin(detail(dark));
        scene_.disc(at, eye);
      }
      scene_.begin(detail(dark));
      const Vec mouth = p_.head + right * forward * W - up * H * in(.15, .3);
      const double w = W * in(.06, .2);
      scene_.path(flowing(mouth - right * w, mouth - up * gauss(.03, .04) * H, mouth + right * w),
                  radiiThrough(.004, H * in(.005, .03), .004));
    }
    if (chance(.35)) {  // belt, hem of the shirt
      const Vec at = spine(in(-.02, .25));
      scene_.begin(detail(dark));
      scene_.line(at - p_.right * p_.bottom, at + p_.right * p_.bottom, .005, in(.004, .02));
    }
    if (chance(.3)) {  // opening, tie, buttons
      scene_.begin(detail(dark));
      const double off = gauss(0, .1) * p_.waist;
      scene_.line(spine(.95) + p_.right * off, spine(in(0, .4)) + p_.right * off, in(.003, .012),
                  in(.003, .012));
    }
    // Folds, patterns, badges, armour: few, or all over the figure.
    const int marks = chance(.2) ? 10 + rng_.below(20) : chance(.4) ? 1 + rng_.below(6) : 0;
    for (int k = 0; k < marks; ++k) {
      const LimbPlan& limb = chance(.5) ? p_.arms[rng_.below(2)] : p_.legs[rng_.below(2)];
      const Vec at = k % 3 == 0   ? Vec(spine(in(-.3, 1)) + p_.right * p_.top * in(-1, 1))
                     : k % 3 == 1 ? Vec(limbPath(limb)[rng_.below(kLimbPoints)])
                                  : Vec(p_.head + right * W * in(-.5, .5) + up * H * in(-.5, .6));
      scene_.begin(detail(chance(.5) ? dark : randomColour()));
      if (chance(.5)) {
        scene_.line(at, at + rotated(p_.right, in(0, kPi)) * p_.torso * in(.05, .3), .004, .004);
      } else {
        scene_.ellipse(at, {p_.torso * in(.02, .15), p_.torso * in(.02, .15)}, 0, in(2, 6));
      }
    }
  }

  Rng& rng_;
  const BipedPlan& p_;
  Scene scene_;
  struct {
    Vec head;
    std::array<std::array<Vec, 3>, 2> arm, leg;
  } joints_;

  Style style_ = Style::kFlat;
  Colour rim_colour_{};
  double rim_width_ = 0;
  Colour skin_{}, hair_{}, top_{}, trousers_{}, shoes_{}, accent_{};

  double limb_radius_ = 0, leg_radius_ = 0, arm_taper_ = 1, leg_taper_ = 1, hand_size_ = 1;
  Hand hand_ = Hand::kNone;
  Foot foot_ = Foot::kNone;
  double sleeve_ = 0, sleeve_width_ = 1, glove_ = 0;  // lengths as shares of the limb
  double flare_ = 1, trouser_length_ = 1, trouser_width_ = 1, boot_ = 0, boot_width_ = 1;
  double foot_length_ = 1, foot_height_ = 1;
  double shoulder_pads_ = 0;  // chance
};

}  // namespace

PaintedBiped paintBiped(Rng& rng, const BipedPlan& plan) { return Painter(rng, plan).paint(); }

}  // namespace skel
