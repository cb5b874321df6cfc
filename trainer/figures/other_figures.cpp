#include "trainer/figures/other_figures.h"

#include <cmath>
#include <numbers>

#include "trainer/figures/biped_painter.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

Ink randomInk(Rng& rng, double rim_width) {
  Ink ink;
  for (auto& v : ink.fill) v = static_cast<std::uint8_t>(rng.uniform(40, 250));
  ink.rim_width = rim_width;
  return ink;
}

void paintFace(Rng& rng, Scene& scene, const Vec& centre, double size) {
  Ink ink;
  ink.fill = {20, 20, 20};
  ink.inside_only = true;
  scene.begin(ink);
  const double eye = size * rng.uniform(.05, .2);
  for (const double s : {-1., 1.}) scene.disc(centre + Vec(s * size * .35, -size * .1), eye);
  scene.line(centre + Vec(-size * .2, size * .35), centre + Vec(size * .2, size * .35), .006, .006);
}

// Four legs, or two and a beak: seen from the side.
void paintAnimal(Rng& rng, Scene& scene, double rim) {
  const Ink ink = randomInk(rng, rim);
  const double length = rng.uniform(.4, .8), height = length * rng.uniform(.25, .6);
  const double leg = rng.uniform(.05, .5), w = rng.uniform(.02, .07);
  const bool bird = rng.chance(.25);
  scene.begin(ink);
  if (rng.chance(.7)) {  // tail
    const Vec a(-length / 2, -height * .1);
    const double turn = rng.uniform(-1.2, 1.2), l = rng.uniform(.1, .5);
    scene.line(a, a + rotated(Vec(-l, 0), turn), w * rng.uniform(.3, 1.5), w * rng.uniform(.2, 1.5));
  }
  const int legs = bird ? 2 : 4;
  for (int i = 0; i < legs; ++i) {
    const double x = bird ? (i - .5) * length * .2 : length * (-.42 + .84 * (i / 2) + .12 * (i % 2));
    const Vec a(x, height * .2), b = a + Vec(rng.normal(0, .05), height * .3 + leg);
    scene.line(a, b, w, w * rng.uniform(.6, 1));
    if (rng.chance(.5)) scene.line(b, b + Vec(w * 1.5, 0), w * .7, w * .6);
  }
  scene.ellipse(Vec(0, 0), {length / 2, height / 2}, rng.normal(0, .08), rng.uniform(2, 3.5));
  const double head = rng.uniform(.12, .4);
  const Vec shoulder(length * .42, -height * .2);
  const Vec c = shoulder + rotated(Vec(rng.uniform(.05, .4), 0), rng.uniform(-1.5, .2)) + Vec(head * .2, 0);
  scene.line(shoulder, c, head * rng.uniform(.2, .45), head * rng.uniform(.2, .4));
  scene.begin(ink);
  scene.ellipse(c, {head * .55, head * rng.uniform(.35, .5)}, rng.normal(0, .2));
  if (rng.chance(.7)) scene.ellipse(c + Vec(head * .5, head * .12), {head * .3, head * .18}, 0);
  if (rng.chance(.8)) {
    for (const double s : {-.4, .1}) {
      scene.line(c + Vec(s * head, -head * .3), c + Vec(s * head * 1.3, -head * rng.uniform(.45, 1)),
                 head * .1, head * rng.uniform(.02, .12));
    }
  }
  paintFace(rng, scene, c, head * .5);
}

// A seated, standing or swimming animal without limbs that could be told apart: penguin, fish, whale, ghost.
void paintPudding(Rng& rng, Scene& scene, double rim) {
  const Ink ink = randomInk(rng, rim);
  const double w = rng.uniform(.2, .5), h = rng.uniform(.25, .55);
  scene.begin(ink);
  scene.ellipse(Vec(0, 0), {w, h}, rng.normal(0, .2), rng.uniform(2, 5));
  if (rng.chance(.6)) scene.ellipse(Vec(0, -h), {w * rng.uniform(.5, 1), h * rng.uniform(.3, .6)}, 0);
  const int fins = rng.below(5);
  for (int i = 0; i < fins; ++i) {
    const double a = rng.uniform(0, 2 * kPi);
    const Vec d(std::cos(a), std::sin(a));
    const Vec at(d.x() * w * .9, d.y() * h * .9);
    scene.polygon(
        {at + Vec(-d.y(), d.x()) * w * .3, at + d * rng.uniform(.05, .3), at - Vec(-d.y(), d.x()) * w * .3});
  }
  paintFace(rng, scene, Vec(0, -h * rng.uniform(.2, 1)), w * rng.uniform(.3, .7));
}

// A head and nothing else.
void paintHeadAlone(Rng& rng, Scene& scene, double rim) {
  const Ink ink = randomInk(rng, rim);
  const double w = rng.uniform(.35, .55), h = rng.uniform(.35, .55);
  scene.begin(ink);
  const double a = rng.uniform(.1, 1.4), l = rng.uniform(.05, .5), r = rng.uniform(.05, .2);
  for (const double s : {-1., 1.}) {
    const Vec d = rotated(Vec(0, -1), s * a);
    scene.line(Vec(d.x() * w, d.y() * h) * .9, Vec(d.x() * (w + l), d.y() * (h + l)), r,
               r * rng.uniform(.2, 1.2));
  }
  scene.ellipse(Vec(0, 0), {w, h}, 0, rng.uniform(2, 6));
  const int curls = rng.chance(.5) ? rng.below(9) : 0;
  for (int i = 0; i < curls; ++i) {
    const double t = rng.uniform(kPi, 2 * kPi);
    scene.disc(Vec(std::cos(t) * w, std::sin(t) * h), rng.uniform(.05, .2));
  }
  if (rng.chance(.4)) {  // shoulders: a bust
    scene.ellipse(Vec(0, h + .15), {rng.uniform(.4, .8), rng.uniform(.15, .4)}, 0, rng.uniform(2, 5));
  }
  paintFace(rng, scene, Vec(0, 0), w * .8);
}

// Boxes, discs and bars put together: houses, cars, trees, tools, letters.
void paintThing(Rng& rng, Scene& scene, double rim) {
  const int n = 1 + rng.below(7);
  Vec at(0, 0);
  for (int i = 0; i < n; ++i) {
    scene.begin(randomInk(rng, rim));
    const Vec half(rng.uniform(.05, .4), rng.uniform(.05, .4));
    switch (rng.below(4)) {
      case 0:
        scene.ellipse(at, half, rng.uniform(0, kPi), 2);
        break;
      case 1:
        scene.ellipse(at, half, rng.chance(.6) ? 0 : rng.uniform(0, kPi), 8);
        break;
      case 2:
        scene.polygon({at + Vec(-half.x(), half.y()), at + Vec(half.x(), half.y()), at + Vec(0, -half.y())});
        break;
      default: {
        const Vec d = rotated(Vec(rng.uniform(.1, .5), 0), rng.uniform(0, 2 * kPi));
        const double r = rng.uniform(.01, .06);
        scene.line(at - d, at + d, r, r * rng.uniform(.4, 1.5));
      }
    }
    at += Vec(rng.normal(0, .22), rng.normal(0, .22));
  }
}

// A closed curve without any meaning.
void paintBlob(Rng& rng, Scene& scene, double rim) {
  constexpr int kCorners = 48;
  std::array<Vec, kCorners> corners;
  std::array<double, 5> size, phase;
  for (int k = 0; k < 5; ++k) {
    size[k] = rng.normal(0, .35 / (k + 1));
    phase[k] = rng.uniform(0, 2 * kPi);
  }
  for (int i = 0; i < kCorners; ++i) {
    const double t = 2 * kPi * i / kCorners;
    double r = 1;
    for (int k = 0; k < 5; ++k) r += size[k] * std::sin((k + 1) * t + phase[k]);
    corners[i] = Vec(std::cos(t), std::sin(t)) * std::max(.05, r) * .4;
  }
  scene.begin(randomInk(rng, rim));
  scene.polygon(corners);
}

}  // namespace

Scene paintOther(Rng& rng) {
  Scene scene;
  const double rim = rng.chance(.5) ? 0 : rng.uniform(.004, .014);
  const double r = rng.uniform();
  if (r < .38) {
    paintAnimal(rng, scene, rim);
    if (rng.chance(.5)) scene.transform([](const Vec& p) { return Vec(-p.x(), p.y()); });
  } else if (r < .56) {
    paintPudding(rng, scene, rim);
  } else if (r < .72) {
    paintHeadAlone(rng, scene, rim);
  } else if (r < .9) {
    paintThing(rng, scene, rim);
  } else {
    paintBlob(rng, scene, rim);
  }
  return scene;
}

Scene paintNoAnimal(Rng& rng) {
  if (rng.chance(.45))
    return paintBiped(rng, sampleBipedPlan(rng, static_cast<BodyKind>(rng.below(kBodyKinds)))).scene;
  Scene scene;
  const double rim = rng.chance(.5) ? 0 : rng.uniform(.004, .014);
  const double r = rng.uniform();
  if (r < .3) {
    paintPudding(rng, scene, rim);
  } else if (r < .55) {
    paintHeadAlone(rng, scene, rim);
  } else if (r < .85) {
    paintThing(rng, scene, rim);
  } else {
    paintBlob(rng, scene, rim);
  }
  return scene;
}

}  // namespace skel
