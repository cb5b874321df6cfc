#include "trainer/figures/quadruped_painter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "trainer/figures/limb_path.h"
#include "trainer/figures/painting.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

class Painter {
 public:
  Painter(Rng& rng, const QuadrupedPlan& plan) : rng_(rng), p_(plan) {}

  PaintedQuadruped paint() {
    sampleStyle();
    const bool tail_behind = chance(.7), legs_behind = chance(.3);
    if (tail_behind) paintTail();
    if (chance(.07)) paintWing();
    for (auto* pair : {&p_.hind, &p_.front})
      for (const LimbPlan& leg : *pair)
        if (!leg.in_front || legs_behind) paintLeg(leg);
    const bool neck_behind = chance(.5);
    if (neck_behind) paintNeck();
    paintTrunk();
    if (!neck_behind) paintNeck();
    if (!tail_behind) paintTail();
    for (auto* pair : {&p_.hind, &p_.front})
      for (const LimbPlan& leg : *pair)
        if (leg.in_front && !legs_behind) paintLeg(leg);
    paintOnBack();
    paintHead();
    paintMarks();

    PaintedQuadruped out{std::move(scene_), {}};
    out.joints[0] = head_;
    out.joints[1] = p_.middle;
    out.joints[2] = p_.tail[0];
    out.joints[3] = tip_;
    for (const int s : {kRight, kLeft}) {
      const std::size_t first = s == kLeft ? 4 : 10;
      const LimbPlan* legs[] = {&p_.front[s], &p_.hind[s]};
      for (std::size_t l = 0; l < 2; ++l) {
        const LimbPath path = limbPath(*legs[l]);
        out.joints[first + 3 * l] = path[0];
        out.joints[first + 3 * l + 1] = path[kLimbPoints / 2];
        out.joints[first + 3 * l + 2] = path[kLimbPoints - 1];
      }
    }
    if (chance(.5)) {
      const auto turned = [](const Vec& p) { return Vec(-p.x(), p.y()); };
      out.scene.transform(turned);
      for (Vec& p : out.joints) p = turned(p);
    }
    return out;
  }

 private:
  bool chance(double p) { return rng_.chance(p); }
  double in(double low, double high) { return rng_.uniform(low, high); }
  double gauss(double mean, double deviation) { return rng_.normal(mean, deviation); }
  bool is(AnimalKind kind) const { return p_.kind == kind; }

  Colour randomColour(double low = 40, double high = 245) { return skel::randomColour(rng_, low, high); }
  Ink ink(const Colour& fill) const { return partInk(style_, fill, rim_colour_, rim_width_); }

  void sampleStyle() {
    const double r = rng_.uniform();
    style_ = r < .36 ? Style::kFlat : r < .66 ? Style::kCartoon : r < .94 ? Style::kPaper : Style::kHollow;
    const double dark = in(0, 90);
    rim_colour_ = {std::uint8_t(dark), std::uint8_t(dark), std::uint8_t(dark + 10)};
    rim_width_ = style_ == Style::kFlat ? 0 : style_ == Style::kHollow ? in(.011, .028) : in(.004, .015);
    fur_ = randomColour();
    limbs_ = chance(.6) ? fur_ : randomColour();
    face_ = chance(.65) ? fur_ : randomColour();
    accent_ = randomColour();
    if (style_ == Style::kPaper) {
      const Colour paper = randomColour(200, 250);
      for (Colour* c : {&fur_, &limbs_, &face_, &accent_})
        if (chance(.85)) *c = paper;
    }
    fused_ = chance(.55);
    leg_radius_ = std::max(kThinnest, p_.leg_width / 2);
    leg_taper_ = is(AnimalKind::kElephant) ? in(.8, 1.2) : in(.4, 1.1);
    foot_ = rng_.below(4);
    foot_size_ = in(.9, 1.7);
    ears_ = is(AnimalKind::kDog)                                  ? (chance(.6) ? kHanging : kPointed)
            : is(AnimalKind::kCat) || is(AnimalKind::kFox)        ? kPointed
            : is(AnimalKind::kElephant) || is(AnimalKind::kMouse) ? (chance(.8) ? kRound : kLong)
            : is(AnimalKind::kTurtle) || is(AnimalKind::kLizard)  ? (chance(.85) ? kNone : kPointed)
                                                                  : static_cast<Ears>(rng_.below(5));
  }

  // Paints over the line between two parts that are one.
  void hideSeam(const Vec& from, const Vec& to, double r_from, double r_to, const Colour& colour,
                PartOwner owner) {
    if (rim_width_ == 0 || style_ == Style::kHollow || !fused_) return;
    scene_.begin(detail(colour), owner);
    scene_.line(from, to, r_from, r_to);
  }

  PartOwner ownerOf(const LimbPlan& leg) const {
    for (const int s : {kRight, kLeft}) {
      if (&leg == &p_.front[s]) return s == kLeft ? PartOwner::kLeftArm : PartOwner::kRightArm;
      if (&leg == &p_.hind[s]) return s == kLeft ? PartOwner::kLeftLeg : PartOwner::kRightLeg;
    }
    return PartOwner::kNone;
  }

  void paintLeg(const LimbPlan& leg) {
    const LimbPath path = limbPath(leg);
    const PartOwner owner = ownerOf(leg);
    const double r = leg_radius_, end = std::max(kThinnest, r * leg_taper_);
    const bool hind = owner == PartOwner::kLeftLeg || owner == PartOwner::kRightLeg;
    Colour colour = limbs_;
    if (!leg.in_front && style_ == Style::kFlat && chance(.6))
      for (auto& v : colour) v = static_cast<std::uint8_t>(v * .8);
    scene_.begin(ink(colour), owner);
    const double thigh = hind && !is(AnimalKind::kDoodle) ? r * thigh_ : r;
    scene_.path(path, radiiThrough(thigh, (r + end) / 2, end));
    const Vec foot = path[kLimbPoints - 1];
    switch (foot_) {
      case 0:  // paw
        scene_.ellipse(foot + Vec(end * in(.3, .9), 0), {end * 1.5 * foot_size_, end * foot_size_}, 0);
        break;
      case 1:  // hoof
        scene_.begin(ink(accent_), owner);
        scene_.line(foot - Vec(0, end * .5), foot + Vec(0, end * .6), end, end * in(1, 1.3));
        break;
      case 2:  // cut off straight
        scene_.polygon({path[kLimbPoints - 3] + Vec(-end, 0), path[kLimbPoints - 3] + Vec(end, 0),
                        foot + Vec(end * 1.1, end), foot + Vec(-end * 1.1, end)});
        break;
      default:
        break;
    }
    if (leg.in_front) hideSeam(path[1], path[0] + p_.up * r, r * .9, r * .9, colour, owner);
  }

  void paintTail() {
    tip_ = p_.tail[2];
    if (!p_.has_tail) return;
    const double w = p_.tail_width / 2, length = (p_.tail[2] - p_.tail[1]).norm() * 2;
    if (is(AnimalKind::kPig) && chance(.6)) {  // a curl
      const double r = std::max(.02, length * in(.2, .35));
      const Vec centre = p_.tail[0] - p_.forward * (r + length * .2) + p_.up * r * in(0, 1);
      scene_.begin(ink(fur_), PartOwner::kTail);
      scene_.line((p_.rump + p_.tail[0]) / 2, centre + p_.forward * r, kThinnest * 1.5, kThinnest * 1.3);
      std::vector<Vec> curl;
      std::vector<double> radii;
      const double turns = in(.7, 1.6) * 2 * kPi, sense = chance(.5) ? 1 : -1;
      for (int i = 0; i <= 14; ++i) {
        const double t = i / 14.0;
        curl.push_back(centre + rotated(p_.forward * r * (1 - .5 * t), sense * turns * t) -
                       p_.forward * r * t * in(0, .1));
        radii.push_back(std::max(kThinnest, .012 * (1 - .4 * t)));
      }
      scene_.path(curl, radii);
      tip_ = curl.back();
      return;
    }
    scene_.begin(ink(fur_), PartOwner::kTail);
    scene_.line((p_.rump + p_.tail[0]) / 2, p_.tail[0], w, w);
    const LimbPath path = flowing(p_.tail[0] + p_.forward * w, p_.tail[1], p_.tail[2]);
    if (is(AnimalKind::kLizard)) {
      scene_.path(path, radiiThrough(w, w * in(.4, .7), kThinnest));
    } else if (is(AnimalKind::kFox)) {
      scene_.path(path, radiiThrough(w * .3, w, w * in(.2, .8)));
    } else if (is(AnimalKind::kHorse)) {
      scene_.path(path, radiiThrough(w * .5, w, w * in(.3, 1.2)));
    } else {
      scene_.path(path, radiiThrough(w, w * in(.6, 1), w * in(.4, 1)));
      if (chance(is(AnimalKind::kCow) || is(AnimalKind::kElephant) ? .7 : .1)) {  // tuft
        scene_.begin(ink(accent_), PartOwner::kTail);
        scene_.ellipse(p_.tail[2], {.02 + w * in(.5, 1.5), .015 + w}, angleOf(p_.tail[2] - p_.tail[1]));
      }
    }
    hideSeam(path[1], p_.tail[0] + p_.forward * w * 2, w * .8, w * .8, fur_, PartOwner::kTail);
  }

  // ---- trunk

  void paintTrunk() {
    const double half = (p_.chest - p_.rump).norm() / 2, h = p_.height / 2, tilt = angleOf(p_.forward);
    const Vec centre = (p_.chest + p_.rump) / 2;
    scene_.begin(ink(fur_), PartOwner::kTorso);
    if (is(AnimalKind::kSheep) && chance(.75)) {  // wool: a cloud
      const int curls = 8 + static_cast<int>(rng_.below(8));
      const double r = h * in(.25, .5);
      scene_.ellipse(centre, {half + h * .4, h * .85}, tilt);
      for (int i = 0; i < curls; ++i) {
        const Vec d = rotated(p_.forward, 2 * kPi * i / curls);
        scene_.disc(
            centre + p_.forward * d.dot(p_.forward) * (half + h * .4) + p_.up * d.dot(p_.up) * h * .85,
            r * in(.7, 1.2));
      }
    } else if (is(AnimalKind::kTurtle)) {
      const double w = half + h * in(.3, .7), dome = p_.height * in(.6, 1);
      scene_.ellipse(centre, {w * .95, h * .5}, tilt);  // belly
      scene_.begin(ink(accent_), PartOwner::kTorso);
      std::array<Vec, 16> shell;
      for (int i = 0; i < 14; ++i) {
        const double t = kPi * i / 13;
        shell[i] = centre + p_.forward * w * std::cos(t) + p_.up * (dome * std::sin(t) - h * .2);
      }
      shell[14] = centre - p_.forward * w * .9 - p_.up * h * .4;
      shell[15] = centre + p_.forward * w * .9 - p_.up * h * .4;
      scene_.polygon(shell);
    } else {
      const double r = rng_.uniform(), over = h * in(.15, .8);
      if (r < .40) {
        scene_.ellipse(centre, {half + over, h}, tilt, in(2, 3));
      } else if (r < .55) {  // box
        scene_.ellipse(centre, {half + over * .6, h}, tilt, in(3, 9));
      } else {  // rump and chest of their own, joined by the back
        const double a = h * in(.75, 1.05), b = h * in(.8, 1.1), m = h * in(.65, 1.05);
        scene_.path(flowing(p_.rump, p_.middle, p_.chest), radiiThrough(a, m, b));
      }
      if (chance(.15)) {  // hump, hanging belly
        const double s = chance(.5) ? 1 : -1;
        scene_.ellipse(p_.middle + p_.up * s * h * in(.2, .7) + p_.forward * half * in(-.5, .5),
                       {half * in(.3, .7), h * in(.4, .7)}, tilt);
      }
    }
  }

  void paintNeck() {
    const double w = p_.neck_width / 2;
    const Vec from = p_.neck - p_.forward * w * .5, to = p_.head - p_.head_forward * p_.head_length * .1;
    scene_.begin(ink(fur_), PartOwner::kTorso);
    const Vec bent = (from + to) / 2 + leftOf(normalised(to - from)) * gauss(0, .05) * (to - from).norm();
    const double base = w * in(1, 1.6), top = w * in(.65, 1);
    scene_.path(flowing(from, bent, to), radiiThrough(base, w, top));
    hideSeam(from, p_.chest, base * .85, base * .85, fur_, PartOwner::kTorso);
    if (chance(is(AnimalKind::kHorse) ? .8 : is(AnimalKind::kGiraffe) ? .4 : .06)) {  // mane
      const Vec back = leftOf(normalised(to - from)) * -1;
      const int tufts = 4 + static_cast<int>(rng_.below(6));
      const double r = w * in(.3, .9);
      scene_.begin(ink(accent_), PartOwner::kTorso);
      for (int i = 0; i < tufts; ++i) {
        const double t = i / (tufts - 1.0);
        const Vec at = from + (to - from) * t + back * w * in(.6, 1.0);
        if (chance(.5)) {
          scene_.disc(at, r * in(.7, 1.2));
        } else {
          scene_.line(at, at + rotated(back, gauss(.5, .4)) * r * 2, r * .6, r * .3);
        }
      }
    }
  }

  void paintOnBack() {
    const double h = p_.height / 2;
    const Vec along = p_.chest - p_.rump;
    if (chance(is(AnimalKind::kLizard) ? .5 : .03)) {  // spikes
      const int n = 3 + static_cast<int>(rng_.below(7));
      const double tall = h * in(.2, .8);
      scene_.begin(ink(accent_), PartOwner::kTorso);
      for (int i = 0; i < n; ++i) {
        const Vec at = p_.rump + along * (i + .5) / n + p_.up * h * .9;
        const Vec side = p_.forward * along.norm() / n * .5;
        scene_.polygon({at - side, at + p_.up * tall * in(.7, 1.2), at + side, at - p_.up * h * .2});
      }
    }
    if (chance(.05)) {  // saddle, blanket, basket
      scene_.begin(ink(accent_), PartOwner::kTorso);
      scene_.ellipse(p_.middle + p_.up * h * in(.4, 1), {along.norm() * in(.15, .35), h * in(.2, .5)},
                     angleOf(p_.forward), in(2, 5));
    }
  }

  void paintWing() {
    const double l = p_.height * in(.6, 2.4);
    const Vec base = p_.middle + p_.up * p_.height * .3, d = rotated(p_.up, gauss(-.4, .6));
    scene_.begin(ink(accent_), PartOwner::kAppendix);
    scene_.ellipse(base + d * l * .5, {l * .5, l * in(.15, .35)}, angleOf(d));
  }

  // ---- head

  enum Ears { kPointed, kRound, kHanging, kLong, kNone };

  void paintEar(double s, bool behind) {
    const double H = p_.head_height, L = p_.head_length;
    const Vec up = p_.head_up, forward = p_.head_forward;
    // In profile both ears sit at the back of the skull.
    const double across = p_.frontal_head ? s * L * .3 : L * (-.22 + .09 * s);
    const Vec base = p_.head + forward * across + up * H * (p_.frontal_head ? .32 : .36);
    const Vec out = rotated(up, p_.frontal_head ? s * ear_angle_ : -ear_angle_ * .7 + .25 * s);
    const double l = ear_length_ * H, w = ear_width_ * H;
    if (ears_ == kNone || (behind && s < 0 && !p_.frontal_head && chance(.3))) return;
    scene_.begin(ink(chance(.8) ? face_ : accent_), PartOwner::kHead);
    switch (ears_) {
      case kPointed:
        scene_.polygon(
            {base - leftOf(out) * w, base + out * l, base + leftOf(out) * w, base - out * H * .15});
        break;
      case kRound: {
        const double r = std::max(w, l * .45);
        scene_.disc(base + out * r * .7, r);
        break;
      }
      case kHanging:
        scene_.path(flowing(base, base + forward * (p_.frontal_head ? s : -1) * l * .4 + up * l * .1,
                            base + forward * (p_.frontal_head ? s : -1) * l * .5 - up * l * .8),
                    radiiThrough(w * .5, w, w * .8));
        break;
      default:
        scene_.path(flowing(base, base + out * l, base + rotated(out, gauss(0, .2)) * l * 1.7),
                    radiiThrough(w * .5, w * .8, w * .4));
    }
  }

  void paintHorns() {
    const double H = p_.head_height, l = H * (chance(.3) ? in(.8, 1.6) : in(.2, .8)),
                 r = std::max(kThinnest, H * in(.03, .09));
    const bool antlers = chance(.3), knobs = is(AnimalKind::kGiraffe);
    scene_.begin(ink(accent_), PartOwner::kHead);
    for (const double s : {-1., 1.}) {
      const double across = p_.frontal_head ? s * .2 : -.12 + .1 * s;
      const Vec base = p_.head + p_.head_forward * p_.head_length * across + p_.head_up * H * .4;
      const Vec d = rotated(p_.head_up, (p_.frontal_head ? s : 1) * in(-.4, .8));
      const Vec tip = base + d * l;
      if (knobs) {
        scene_.line(base, tip, r * .6, r * .6);
        scene_.disc(tip, r * 1.2);
      } else {
        scene_.path(flowing(base, base + d * l * .5, base + rotated(d, gauss(0, .5)) * l),
                    radiiThrough(r, r * .8, kThinnest));
        if (antlers) {
          for (const double t : {.4, .7}) {
            const Vec at = base + d * l * t;
            scene_.line(at, at + rotated(d, s * in(.5, 1.1)) * l * .4, r * .7, kThinnest);
          }
        }
      }
    }
  }

  void paintHead() {
    const double H = p_.head_height, L = p_.head_length, tilt = angleOf(p_.head_forward);
    const Vec up = p_.head_up, forward = p_.head_forward;
    ear_angle_ = in(.1, 1.1);
    ear_length_ = ears_ == kRound ? in(.3, .9) : in(.25, .75);
    ear_width_ = in(.12, .3);
    if (is(AnimalKind::kElephant)) ear_length_ = in(.7, 1.3);
    const bool ears_in_front = is(AnimalKind::kElephant) || chance(.35);
    if (!ears_in_front)
      for (const double s : {-1., 1.}) paintEar(s, true);
    const bool horned = chance(is(AnimalKind::kCow) || is(AnimalKind::kGiraffe) ? .65
                               : is(AnimalKind::kAny)                           ? .15
                                                                                : .05);
    if (horned) paintHorns();

    scene_.begin(ink(face_), PartOwner::kHead);
    head_ = p_.head;
    const double reach = p_.frontal_head ? 0 : p_.muzzle * L;
    if (reach > .15 * L && chance(.55)) {  // skull and muzzle in one wedge
      const Vec nose = p_.head + forward * (L * .2 + reach);
      scene_.path(
          flowing(p_.head - forward * L * .15, (p_.head + nose) / 2 - up * H * .05, nose - up * H * .1),
          radiiThrough(H * .5, H * in(.3, .42), H * in(.12, .3)));
      head_ = p_.head + forward * reach * .3;
    } else {
      scene_.ellipse(p_.head, {L / 2, H / 2}, tilt, chance(.75) ? 2 : in(2.3, 6));
      if (reach > 0) {
        if (chance(.4)) scene_.begin(ink(chance(.5) ? face_ : accent_), PartOwner::kHead);
        scene_.ellipse(p_.head + forward * (L * .42 + reach * .3) - up * H * in(.05, .2),
                       {std::max(.03, L * .12 + reach * .45), H * in(.18, .34)}, tilt,
                       chance(.6) ? 2 : in(2.5, 6));
        head_ = p_.head + forward * reach * .2;
      }
    }
    if (rim_width_ > 0 && chance(.5))
      hideSeam(p_.head - forward * L * .1, (p_.head + p_.neck) / 2, p_.neck_width * .3, p_.neck_width * .3,
               face_, PartOwner::kHead);
    if (is(AnimalKind::kElephant) || chance(.01)) {
      const Vec root =
          p_.frontal_head ? Vec(p_.head - up * H * .15) : Vec(p_.head + forward * L * .35 - up * H * .1);
      const double l = H * in(.7, 1.5), w = H * in(.09, .17);
      const Vec tip = root - up * l * in(.5, 1) + forward * l * in(-.1, .8);
      scene_.begin(ink(face_), PartOwner::kHead);
      scene_.path(flowing(root, root - up * l * .5 + forward * l * in(0, .25), tip),
                  radiiThrough(w, w * .8, w * .6));
      if (chance(.5)) {
        scene_.begin(ink({245, 245, 235}), PartOwner::kHead);
        const Vec tusk = root - up * H * .15;
        scene_.line(tusk, tusk + forward * H * in(.2, .4) - up * H * in(-.1, .15), w * .35, kThinnest);
      }
    }
    if (!p_.frontal_head && chance(.05)) {  // horns on the nose, tusks
      scene_.begin(ink({235, 230, 210}), PartOwner::kHead);
      const int horns = 1 + static_cast<int>(rng_.below(2));
      const double side = chance(.7) ? 1 : -1;
      for (int k = 0; k < horns; ++k) {
        const Vec at = head_ + forward * L * (in(.3, .6) - .3 * k) + up * side * H * .3;
        const Vec tip = at + rotated(up * side, -side * in(-.3, 1)) * H * in(.3, 1.1) * (k ? .6 : 1);
        scene_.polygon({at - forward * H * .12, tip, at + forward * H * .12});
      }
    }
    if (is(AnimalKind::kPig) || (p_.frontal_head && chance(.3))) {  // snout
      const Vec at = p_.frontal_head ? Vec(p_.head - up * H * in(.05, .2))
                                     : Vec(p_.head + forward * L * in(.35, .55) - up * H * in(0, .15));
      scene_.begin(ink(chance(.5) ? face_ : accent_), PartOwner::kHead);
      scene_.ellipse(at, {L * (p_.frontal_head ? in(.14, .25) : in(.08, .2)), H * in(.12, .22)}, tilt,
                     chance(.6) ? 2 : 5);
    }
    if (chance(.04)) {  // a mass of hair around the head: a lion
      const double r = std::max(L, H) * in(.55, .8);
      scene_.begin(ink(accent_), PartOwner::kHead);
      scene_.ring(p_.head, r, r * in(.15, .3));
    }
    if (chance(.05)) {  // beard, tuft
      scene_.begin(ink(accent_), PartOwner::kHead);
      const double s = chance(.5) ? 1 : -1;
      scene_.ellipse(p_.head + up * s * H * .55, {L * in(.08, .25), H * in(.1, .3)}, tilt + in(-.5, .5));
    }
    if (ears_in_front)
      for (const double s : {-1., 1.})
        if (p_.frontal_head || s > 0) paintEar(s, false);
    if (chance(.04)) {  // hat, bow
      scene_.begin(ink(accent_), PartOwner::kHead);
      const Vec at = p_.head + up * H * .5;
      scene_.polygon({at - forward * L * .35, at + up * H * in(.3, .7), at + forward * L * .35});
    }
  }

  // Seen only as inner lines.
  void paintMarks() {
    if (style_ == Style::kHollow || chance(.12)) return;
    const double H = p_.head_height, L = p_.head_length;
    const Colour dark = randomColour(10, 90);
    if (chance(.9)) {
      const double eye = H * in(.03, .1);
      for (const double s : {-1., 1.}) {
        if (!p_.frontal_head && s < 0) continue;
        const Vec at = p_.head + p_.head_up * H * in(0, .2) +
                       p_.head_forward * L * (p_.frontal_head ? s * .2 : in(0, .25));
        if (chance(.3)) {
          scene_.begin(detail({250, 250, 250}));
          scene_.disc(at, eye * 1.6);
        }
        scene_.begin(detail(dark));
        scene_.disc(at, eye);
      }
      const Vec mouth =
          p_.head + p_.head_forward * L * (p_.frontal_head ? 0 : .35) - p_.head_up * H * in(.15, .3);
      const double w = L * in(.06, .2);
      scene_.begin(detail(dark));
      scene_.path(flowing(mouth - p_.head_forward * w, mouth - p_.head_up * gauss(.03, .04) * H,
                          mouth + p_.head_forward * w),
                  radiiThrough(.004, H * in(.005, .03), .004));
    }
    // Spots, stripes, folds, collar.
    const int marks = chance(.3) ? 4 + static_cast<int>(rng_.below(16)) : static_cast<int>(rng_.below(3));
    const bool stripes = chance(.35);
    const Colour colour = chance(.5) ? dark : randomColour();
    for (int k = 0; k < marks; ++k) {
      const Vec at = p_.rump + (p_.chest - p_.rump) * in(-.2, 1.2) + p_.up * p_.height * in(-.5, .5);
      scene_.begin(detail(colour));
      if (stripes) {
        scene_.line(at, at + rotated(p_.up, gauss(0, .2)) * p_.height * in(.1, .5), .004, in(.004, .014));
      } else {
        scene_.ellipse(at, {p_.height * in(.03, .18), p_.height * in(.03, .18)}, in(0, 3));
      }
    }
    if (chance(.12)) {
      const Vec at = (p_.neck + p_.head) / 2,
                across = leftOf(normalised(p_.head - p_.neck)) * p_.neck_width * .7;
      scene_.begin(detail(colour));
      scene_.line(at - across, at + across, .008, .008);
    }
  }

  Rng& rng_;
  const QuadrupedPlan& p_;
  Scene scene_;
  Vec head_ = Vec::Zero(), tip_ = Vec::Zero();

  Style style_ = Style::kFlat;
  Colour rim_colour_{}, fur_{}, limbs_{}, face_{}, accent_{};
  double rim_width_ = 0;
  bool fused_ = true;  // no lines where legs, neck and tail leave the trunk
  double leg_radius_ = 0, leg_taper_ = 1, thigh_ = rng_.uniform(1, 2.2), foot_size_ = 1;
  std::uint32_t foot_ = 0;
  Ears ears_ = kNone;
  double ear_angle_ = 0, ear_length_ = 0, ear_width_ = 0;
};

}  // namespace

PaintedQuadruped paintQuadruped(Rng& rng, const QuadrupedPlan& plan) { return Painter(rng, plan).paint(); }

}  // namespace skel
