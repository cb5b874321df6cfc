#include "trainer/confidence_samples.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
#include "libskel/core/rng.h"
#include "libskel/image/read_image.h"
#include "libskel/jointnet/figure_look.h"
#include "libskel/silhouette/silhouette.h"
#include "trainer/figures/figure.h"
#include "trainer/figures/pasted_drawing.h"
#include "trainer/figures/warped_drawing.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

constexpr int kSide = 256;  // px, of a disturbed figure

// Joints by the net's number; image px.
using Truth = std::vector<std::optional<Vec>>;

struct Looked {
  TreeRecognition found;
  Evidence evidence;
  std::vector<Vec> places;  // image px
};

// Whether the joints fit; those of the two sides exchanged where that fits better, if it is a guess which is
// which.
void judge(const Truth& truth, double long_side, bool sides_known, const NetJoints& joints,
           std::vector<Vec> places, ConfidenceSample& sample) {
  const auto distance = [&](std::size_t j, std::size_t place) {
    return truth[j] ? (*truth[j] - places[place]).norm() : 0;
  };
  for (std::size_t k = 0; !sides_known && k < joints.limbs.size(); ++k) {
    double as_is = 0, exchanged = 0;
    for (const int j : joints.limbs[k]) {
      const auto one = static_cast<std::size_t>(j), other = static_cast<std::size_t>(joints.mirrored[one]);
      as_is += distance(one, one) + distance(other, other);
      exchanged += distance(one, other) + distance(other, one);
    }
    if (exchanged >= as_is) continue;
    for (const int j : joints.limbs[k])
      std::swap(places[static_cast<std::size_t>(j)],
                places[static_cast<std::size_t>(joints.mirrored[static_cast<std::size_t>(j)])]);
  }
  sample.right.clear();
  sample.usable = true;
  for (std::size_t j = 0; j < truth.size(); ++j) {
    const double error = distance(j, j) / long_side;
    sample.right.push_back(truth[j] ? error <= .1 : -1);
    if (error > .15) sample.usable = false;
  }
}

class Sampler {
 public:
  Sampler(const JointNet& net)
      : net_(net),
        body_plan_(loadTemplate(net.body_plan)),
        joints_(netJoints(net.joints, body_plan_)),
        plan_(figurePlan(net.body_plan)) {}

  // All samples of a drawing; `neighbour`: another one, pieces of which are stuck to it.
  std::vector<ConfidenceSample> of(const JointedDrawing& drawing, const JointedDrawing& neighbour, int copies,
                                   Rng rng) const {
    std::vector<ConfidenceSample> samples;
    const Image image = readImage(drawing.image);
    const Silhouette silhouette = silhouetteOf(image, drawing);
    Truth truth(joints_.names.size());
    for (const auto& [name, place] : drawing.joints)
      for (std::size_t j = 0; j < truth.size(); ++j)
        if (joints_.names[j] == name) truth[j] = place;
    const auto add = [&](Disturbance disturbance, const Image& picture, const Silhouette& seen,
                         const Truth& at, double long_side) {
      if (!seen.found()) return;
      const Looked looked = look(picture, seen);
      ConfidenceSample sample = describe(looked, disturbance, drawing.image);
      judge(at, long_side, !drawing.side_view, joints_, looked.places, sample);
      if (disturbance == Disturbance::kCut || disturbance == Disturbance::kPair) {
        sample.usable = false;
        std::fill(sample.right.begin(), sample.right.end(), -1);
      }
      samples.push_back(std::move(sample));
    };
    const double long_side = kWorkingGridSize / silhouette.grid.scale;
    add(Disturbance::kNone, image, silhouette, truth, long_side);
    if (drawing.mask && (image.rgba.col(3) == 255).all())
      add(Disturbance::kFound, image, extractSilhouette(image), truth, long_side);

    const SmallDrawing small = annotated(drawing, image, silhouette, truth);
    const Image other_image = readImage(neighbour.image);
    const SmallDrawing other = annotated(neighbour, other_image, silhouetteOf(other_image, neighbour), {});
    for (int copy = 0; copy < copies; ++copy) {
      for (const Disturbance disturbance :
           {Disturbance::kWarped, Disturbance::kTurned, Disturbance::kThing, Disturbance::kLimb,
            Disturbance::kBite, Disturbance::kCut, Disturbance::kPair}) {
        WarpedDrawing figure = disturbed(rng, disturbance, small, other);
        Truth at(truth.size());
        for (std::size_t j = 0; j < truth.size(); ++j)
          if (truth[j]) at[j] = figure.joints[planned(j)] - Vec::Constant(.5);
        Image picture(figure.width, figure.height);
        Plane8 mask(figure.height, figure.width);
        for (Eigen::Index i = 0; i < mask.size(); ++i) {
          const auto k = static_cast<std::size_t>(i);
          mask.data()[i] = figure.solid[k] ? 255 : 0;
          for (int c = 0; c < 3; ++c)
            picture.rgba(i, c) = figure.solid[k] ? figure.colours[k][static_cast<std::size_t>(c)] : 255;
          picture.rgba(i, 3) = 255;
        }
        if ((mask != 0).any()) add(disturbance, picture, silhouetteFromMask(mask), at, kSide);
      }
    }
    return samples;
  }

  ConfidenceSample ofOtherPlan(const JointedDrawing& drawing) const {
    const Image image = readImage(drawing.image);
    ConfidenceSample sample =
        describe(look(image, silhouetteOf(image, drawing)), Disturbance::kOtherPlan, drawing.image);
    sample.right.assign(joints_.names.size(), -1);
    return sample;
  }

 private:
  Looked look(const Image& image, const Silhouette& silhouette) const {
    const WorkingGrid& grid = silhouette.grid;
    const FigureLook figure_look = figureLook(
        gridColours(image, grid.corner_px, grid.scale, grid.width, grid.height), silhouette.grid_mask);
    Looked looked;
    looked.found = recognizeByJointNet(silhouette.grid_mask, figure_look, net_, joints_);
    looked.evidence = evidenceOf(looked.found, silhouette.grid_mask, net_, joints_, body_plan_);
    for (const TreeJoint& joint : looked.found.joints)
      looked.places.push_back(grid.imageFromGrid(joint.position));
    return looked;
  }

  ConfidenceSample describe(const Looked& looked, Disturbance disturbance, const std::string& path) const {
    ConfidenceSample sample{drawingName(path),     disturbance, body_plan_.name, looked.evidence, {},
                            looked.found.likeness, {}};
    for (const TreeJoint& joint : looked.found.joints) sample.masses.push_back(joint.mass);
    return sample;
  }

  // The generator's number of a joint of the net.
  std::size_t planned(std::size_t joint) const {
    const auto at = std::find_if(plan_.joints.begin(), plan_.joints.end(),
                                 [&](const auto& j) { return j.name == joints_.names[joint]; });
    return static_cast<std::size_t>(at - plan_.joints.begin());
  }

  SmallDrawing annotated(const JointedDrawing& drawing, const Image& image, const Silhouette& silhouette,
                         const Truth& truth) const {
    std::vector<Vec> places(truth.empty() ? 0 : plan_.joints.size(), Vec::Zero());
    for (std::size_t j = 0; j < truth.size(); ++j) places[planned(j)] = truth[j].value_or(Vec::Zero());
    return smallDrawing(image, silhouette.mask, places,
                        drawing.side_view ? FigureView::kSide : FigureView::kFront);
  }

  WarpedDrawing disturbed(Rng& rng, Disturbance disturbance, const SmallDrawing& drawing,
                          const SmallDrawing& other) const {
    const bool pair = disturbance == Disturbance::kPair;
    WarpedDrawing figure = warpedDrawing(
        rng, drawing, disturbance == Disturbance::kTurned ? rng.uniform(0, 2 * std::numbers::pi) : 0, kSide,
        pair                                 ? kSide
        : disturbance == Disturbance::kThing ? static_cast<int>(kThingMargin * kSide)
                                             : 2);
    if (pair) pasteNeighbour(rng, other, kSide, figure);
    if (disturbance == Disturbance::kThing) {
      std::vector<bool> visible(plan_.joints.size(), true);
      for (int k = rng.chance(.5) ? 1 : 2; k > 0; --k) pasteThing(rng, plan_, other, kSide, figure, visible);
    }
    if (disturbance == Disturbance::kLimb) cutLimb(rng, figure);
    if (disturbance == Disturbance::kBite) bite(rng, figure);
    if (disturbance == Disturbance::kCut) cutOff(rng, figure);
    return figure;
  }

  static void fillDisc(WarpedDrawing& figure, const Vec& centre, double radius, bool solid,
                       const Colour& colour) {
    for (int y = 0; y < figure.height; ++y) {
      for (int x = 0; x < figure.width; ++x) {
        if ((Vec(x + .5, y + .5) - centre).norm() > radius) continue;
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(figure.width) +
                              static_cast<std::size_t>(x);
        if (solid && !figure.solid[i]) figure.colours[i] = colour;
        figure.solid[i] = solid;
      }
    }
  }

  void cutLimb(Rng& rng, WarpedDrawing& figure) const {
    const TemplateLimb& limb =
        body_plan_.limbs[rng.below(static_cast<std::uint32_t>(body_plan_.limbs.size()))];
    const auto place = [&](int k) {
      const std::string& name =
          body_plan_.joints[static_cast<std::size_t>(limb.joints[static_cast<std::size_t>(k)])].name;
      const auto at = std::find(joints_.names.begin(), joints_.names.end(), name) - joints_.names.begin();
      return figure.joints[planned(static_cast<std::size_t>(at))];
    };
    const Vec middle = place(1), end = place(2);
    const double radius = rng.uniform(.07, .13) * kSide;
    for (double t = rng.uniform(0, 1); t <= 1.2; t += .1)
      fillDisc(figure, middle + t * (end - middle), radius, false, {});
  }

  static void bite(Rng& rng, WarpedDrawing& figure) {
    const bool add = rng.chance(.5);
    const Colour colour = {static_cast<std::uint8_t>(rng.below(256)),
                           static_cast<std::uint8_t>(rng.below(256)),
                           static_cast<std::uint8_t>(rng.below(256))};
    for (int k = 1 + static_cast<int>(rng.below(4)); k > 0; --k) {
      const auto& joint = figure.joints[rng.below(static_cast<std::uint32_t>(figure.joints.size()))];
      const Vec at = joint + .08 * kSide * Vec(rng.normal(), rng.normal());
      fillDisc(figure, at, rng.uniform(.03, add ? .15 : .09) * kSide, add, colour);
    }
  }

  static void cutOff(Rng& rng, WarpedDrawing& figure) {
    const double share = rng.uniform(.3, .6), side = rng.uniform();
    for (int y = 0; y < figure.height; ++y) {
      for (int x = 0; x < figure.width; ++x) {
        const double u = (x + .5) / figure.width, v = (y + .5) / figure.height;
        const double from = side < .5 ? 1 - v : side < .65 ? v : side < .82 ? u : 1 - u;
        if (from < share)
          figure.solid[static_cast<std::size_t>(y) * static_cast<std::size_t>(figure.width) +
                       static_cast<std::size_t>(x)] = 0;
      }
    }
  }

  const JointNet& net_;
  SkeletonTemplate body_plan_;
  NetJoints joints_;
  const FigurePlan& plan_;
};

}  // namespace

std::string drawingName(const std::string& picture) { return std::filesystem::path(picture).stem().string(); }

std::vector<ConfidenceSample> confidenceSamples(const std::vector<JointedDrawing>& drawings,
                                                const std::vector<JointedDrawing>& others,
                                                const JointNet& net, int copies, std::uint64_t seed,
                                                int threads) {
  const Sampler sampler(net);
  std::vector<std::vector<ConfidenceSample>> each(drawings.size() + others.size());
  {
    ProgressBar bar("looking at drawings of a " + net.body_plan, each.size());
    parallelFor(each.size(), threads, [&](std::size_t i) {
      if (i < drawings.size())
        each[i] = sampler.of(drawings[i], drawings[(i + 1) % drawings.size()], copies, Rng(seed, i));
      else
        each[i].push_back(sampler.ofOtherPlan(others[i - drawings.size()]));
      bar.advance();
    });
  }
  std::vector<ConfidenceSample> samples;
  for (auto& list : each)
    for (ConfidenceSample& sample : list) samples.push_back(std::move(sample));
  return samples;
}

}  // namespace skel
