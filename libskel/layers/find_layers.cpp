#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "libskel/image/mask_parts.h"
#include "libskel/layers/layer_map.h"
#include "libskel/layers/ribbon.h"
#include "libskel/mesh/outline.h"

namespace skel {
namespace {

using Eigen::Vector2d;

constexpr int kFiner = 2;  // than the working grid

// Of a limb's sections beyond its root.
constexpr double kLeastContact = 0.2;  // with the body, as a share of one side: less is free
constexpr double kLeastDrawn = 0.7;    // of the contact: what is drawn
constexpr double kAboutBones = 0.7;    // that hold the bones
constexpr double kLeastSeen = 0.7;     // of a limb: more of it hidden by others, and it is left to the body
constexpr double kCutOff = 0.3;        // of a limb's area: larger parts that it cuts off stay the body's
constexpr double kClearer = 1.6;       // the edges are, than what lies between them
constexpr double kGrown = 0.6;         // in contact with the body, of a limb that is hidden
constexpr double kSure = 0.75;         // confidence in the end of a limb that is not hidden

LookGrid lookGrid(const Image& image, const Silhouette& silhouette) {
  LookGrid look;
  look.width = kFiner * silhouette.grid.width, look.height = kFiner * silhouette.grid.height;
  look.scale = kFiner * silhouette.grid.scale;
  look.corner_px = silhouette.grid.corner_px;
  look.colours = gridColours(image, look.corner_px, look.scale, look.width, look.height);
  look.mask = Plane8::Zero(look.height, look.width);
  std::array<int, 256> histogram{};
  int count = 0;
  for (int y = 0; y < look.height; ++y)
    for (int x = 0; x < look.width; ++x) {
      const Vector2d p = look.toImage({x, y});
      const auto u = std::clamp<Eigen::Index>(std::lround(p.x()), 0, image.width - 1),
                 v = std::clamp<Eigen::Index>(std::lround(p.y()), 0, image.height - 1);
      if (silhouette.mask(v, u) == 0) continue;
      look.mask(y, x) = 255;
      ++histogram[std::clamp(static_cast<int>(look.colours.row(std::int64_t{y} * look.width + x).mean()), 0,
                             255)];
      ++count;
    }
  const auto percentile = [&](double share) {
    int left = static_cast<int>(share * count), value = 0;
    while (value < 255 && left >= histogram[value]) left -= histogram[value++];
    return value;
  };
  look.range = std::max(40, percentile(0.98) - percentile(0.02));
  return look;
}

struct Limb {
  Ribbon ribbon;
  PixelBox box;  // of the image
  Plane8 mask;   // of the box's size
  bool layer = false;
  int wins = 0;

  bool holds(std::int64_t x, std::int64_t y) const {
    return x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1 && mask(y - box.y0, x - box.x0) != 0;
  }
};

bool standsOut(const Ribbon& ribbon) {
  int sections = 0, contact = 0, drawn = 0;
  double strength = 0;
  const auto see = [&](BandSide side, double how_strong) {
    if (side == BandSide::kOutline) return;
    ++contact;
    drawn += side == BandSide::kDrawn;
    strength += how_strong;
  };
  for (std::size_t s = 0; s < ribbon.sections.size(); ++s) {
    if (static_cast<double>(s) < ribbon.root_radius) continue;
    const Ribbon::Section& section = ribbon.sections[s];
    ++sections;
    see(section.left_side, section.left_strength);
    see(section.right_side, section.right_strength);
  }
  if (ribbon.about_bones < kAboutBones || contact == 0 || contact < kLeastContact * sections) return false;
  return drawn >= kLeastDrawn * contact && strength / contact >= kClearer * ribbon.inside_strength;
}

double cross(const Vector2d& u, const Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); }

// Whether the segments from a to b and from c to d cross.
bool segmentsCross(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

// Whether nearly all of it is against the body: no section ends at the outline on both sides, or it has taken
// the body for a part of it. `spine`: the joints that it hangs on, up to the root, grid px.
bool grownToBody(const Ribbon& ribbon, const std::vector<Vector2d>& spine) {
  int sections = 0, grown = 0;
  for (std::size_t s = 0; s < ribbon.sections.size(); ++s) {
    if (static_cast<double>(s) < ribbon.root_radius) continue;
    ++sections;
    const Ribbon::Section& section = ribbon.sections[s];
    bool against = section.left_side != BandSide::kOutline || section.right_side != BandSide::kOutline;
    for (std::size_t k = 0; k + 1 < spine.size(); ++k)
      against = against || segmentsCross(section.left, section.right, spine[k], spine[k + 1]);
    grown += against;
  }
  return sections > 0 && grown >= kGrown * sections;
}

void fillTriangle(const Vector2d& a, const Vector2d& b, const Vector2d& c, Plane8& mask) {
  const double area = cross(b - a, c - a);
  if (area == 0) return;
  const Vector2d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  const auto first = [](double value) {
    return std::max<Eigen::Index>(0, static_cast<Eigen::Index>(std::ceil(value)));
  };
  const auto last = [](double value, Eigen::Index count) {
    return std::min(count - 1, static_cast<Eigen::Index>(std::floor(value)));
  };
  for (Eigen::Index y = first(low.y()); y <= last(high.y(), mask.rows()); ++y)
    for (Eigen::Index x = first(low.x()); x <= last(high.x(), mask.cols()); ++x) {
      const Vector2d p(static_cast<double>(x), static_cast<double>(y));
      const double u = cross(b - p, c - p) / area, v = cross(c - p, a - p) / area;
      if (u >= 0 && v >= 0 && u + v <= 1) mask(y, x) = 1;
    }
}

void drawLimb(const LookGrid& look, const Plane8& figure, Limb& limb) {
  std::vector<std::array<Vector2d, 2>> sections;
  for (const Ribbon::Section& section : limb.ribbon.sections)
    sections.push_back({look.toImage(section.left), look.toImage(section.right)});
  for (const auto& [left, right] : limb.ribbon.cap)
    sections.push_back({look.toImage(left), look.toImage(right)});
  Vector2d low = sections.front()[0], high = low;
  for (const auto& ends : sections)
    for (const Vector2d& p : ends) low = low.cwiseMin(p), high = high.cwiseMax(p);
  limb.box.x0 = static_cast<int>(std::clamp(std::floor(low.x()), 0., static_cast<double>(figure.cols() - 1)));
  limb.box.y0 = static_cast<int>(std::clamp(std::floor(low.y()), 0., static_cast<double>(figure.rows() - 1)));
  limb.box.x1 =
      static_cast<int>(std::clamp(std::ceil(high.x()), 0., static_cast<double>(figure.cols() - 1))) + 1;
  limb.box.y1 =
      static_cast<int>(std::clamp(std::ceil(high.y()), 0., static_cast<double>(figure.rows() - 1))) + 1;
  limb.mask = Plane8::Zero(limb.box.height(), limb.box.width());
  const Vector2d corner(limb.box.x0, limb.box.y0);
  for (auto& [left, right] : sections) left -= corner, right -= corner;
  for (std::size_t s = 0; s + 1 < sections.size(); ++s) {
    const auto& [a, b] = sections[s];
    const auto& [c, d] = sections[s + 1];
    fillTriangle(a, b, c, limb.mask);
    fillTriangle(b, c, d, limb.mask);
  }
  limb.mask = (figure.block(limb.box.y0, limb.box.x0, limb.mask.rows(), limb.mask.cols()) != 0)
                  .select(limb.mask, Plane8::Zero(limb.mask.rows(), limb.mask.cols()));
}

// How clearly the limb is drawn where it lies within the other.
double strengthWithin(const Limb& limb, const Limb& other, const LookGrid& look) {
  double sum = 0;
  int count = 0;
  const auto see = [&](const Vector2d& grid_point, double strength) {
    const Vector2d p = look.toImage(grid_point);
    if (!other.holds(std::lround(p.x()), std::lround(p.y()))) return;
    sum += strength, ++count;
  };
  for (const Ribbon::Section& section : limb.ribbon.sections) {
    see(section.left, section.left_strength);
    see(section.right, section.right_strength);
  }
  return count ? sum / count : 0;
}

// Grows the limbs into pixels that are `kFree`, each to the nearest, by steps to the four sides.
constexpr std::uint8_t kFree = 255;
void growInto(Plane8& limbs) {
  std::vector<Eigen::Index> front;
  const Eigen::Index columns = limbs.cols();
  const auto eachBeside = [&](Eigen::Index i, const auto& see) {
    if (i % columns > 0) see(i - 1);
    if (i % columns + 1 < columns) see(i + 1);
    if (i >= columns) see(i - columns);
    if (i + columns < limbs.size()) see(i + columns);
  };
  for (Eigen::Index i = 0; i < limbs.size(); ++i)
    if (limbs.data()[i] == kFree)
      eachBeside(i, [&](Eigen::Index k) {
        if (limbs.data()[k] != 0 && limbs.data()[k] != kFree) front.push_back(k);
      });
  for (std::size_t next = 0; next < front.size(); ++next) {
    const std::uint8_t limb = limbs.data()[front[next]];
    eachBeside(front[next], [&](Eigen::Index k) {
      if (limbs.data()[k] != kFree) return;
      limbs.data()[k] = limb;
      front.push_back(k);
    });
  }
}

// Parts that the limbs cut off from the body go with them where they reach the outline: a thumb, the end of a
// shoe, the rim of two shoes that touch. Parts with joints of others in them, and large ones without any,
// stay the body's.
void takeWhatIsCutOff(const Plane8& figure, const Skeleton& skeleton, const std::vector<int>& limb_of_joint,
                      Plane8& limbs) {
  const PixelBox box = figureBox(figure);
  const MaskParts parts = maskParts((figure.block(box.y0, box.x0, box.height(), box.width()) != 0 &&
                                     limbs.block(box.y0, box.x0, box.height(), box.width()) == 0)
                                        .cast<std::uint8_t>());
  const int body = parts.largest();
  struct Part {
    std::array<int, 256> beside{};  // how many sides of pixels each limb has in common with it
    bool at_outline = false;
    std::array<bool, 256> joints_of{};
  };
  std::map<int, Part> cut_off;
  for (const MaskParts::Run& run : parts.runs) {
    if (run.part == body) continue;
    Part& part = cut_off[run.part];
    const int y = run.y + box.y0, x0 = run.x0 + box.x0, x1 = run.x1 + box.x0;
    const auto see = [&](int u, int v) {
      if (u < 0 || v < 0 || u >= figure.cols() || v >= figure.rows() || figure(v, u) == 0)
        part.at_outline = true;
      else if (limbs(v, u) != 0)
        ++part.beside[limbs(v, u)];
    };
    see(x0 - 1, y), see(x1, y);
    for (int x = x0; x < x1; ++x) see(x, y - 1), see(x, y + 1);
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      const Vector2d& p = skeleton.joints[j].image;
      if (std::lround(p.y()) == y && std::lround(p.x()) >= x0 && std::lround(p.x()) < x1)
        part.joints_of[static_cast<std::size_t>(limb_of_joint[j])] = true;
    }
  }
  if (cut_off.empty()) return;
  std::array<std::int64_t, 256> areas{};
  for (int i = 0; i < limbs.size(); ++i) ++areas[limbs.data()[i]];
  std::set<int> taken;
  for (const auto& [number, part] : cut_off) {
    const auto limb = static_cast<std::size_t>(std::max_element(part.beside.begin(), part.beside.end()) -
                                               part.beside.begin());
    bool others = false;
    for (std::size_t k = 0; k < part.joints_of.size(); ++k)
      others = others || (part.beside[k] == 0 && part.joints_of[k]);
    const bool large = static_cast<double>(parts.size[static_cast<std::size_t>(number)]) >
                       kCutOff * static_cast<double>(areas[limb]);
    if (part.at_outline && !others && (!large || part.joints_of[limb])) taken.insert(number);
  }
  if (taken.empty()) return;
  for (const MaskParts::Run& run : parts.runs)
    if (taken.contains(run.part))
      limbs.row(run.y + box.y0).segment(run.x0 + box.x0, run.x1 - run.x0).setConstant(kFree);
  growInto(limbs);
}

}  // namespace

LayerMap findLayers(const Image& image, const Silhouette& silhouette, const Skeleton& skeleton,
                    const SkeletonTemplate& body_plan) {
  const LookGrid look = lookGrid(image, silhouette);
  std::vector<Limb> limbs(std::min<std::size_t>(body_plan.limbs.size(), kFree - 1));
  std::vector<int> limb_of_joint(skeleton.joints.size(), 0);
  bool any = false;
  LayerMap map;
  for (std::size_t k = 0; k < limbs.size(); ++k) {
    std::vector<Vector2d> bones;
    std::vector<Vector2d> spine;
    double confidence = 0;  // of the last joint
    for (const int joint : body_plan.limbs[k].joints) {
      const int found = skeleton.find(body_plan.joints[static_cast<std::size_t>(joint)].name);
      if (found < 0) break;
      limb_of_joint[static_cast<std::size_t>(found)] = static_cast<int>(k) + 1;
      bones.push_back(look.fromImage(skeleton.joints[static_cast<std::size_t>(found)].image));
      confidence = skeleton.joints[static_cast<std::size_t>(found)].confidence;
      for (int up = skeleton.joints[static_cast<std::size_t>(found)].parent; up >= 0 && bones.size() == 1;
           up = skeleton.joints[static_cast<std::size_t>(up)].parent)
        spine.push_back(look.fromImage(skeleton.joints[static_cast<std::size_t>(up)].image));
    }
    if (bones.size() < body_plan.limbs[k].joints.size()) continue;
    limbs[k].ribbon = findRibbon(look, bones);
    limbs[k].layer = standsOut(limbs[k].ribbon);
    if (limbs[k].layer)
      drawLimb(look, silhouette.mask, limbs[k]), any = true;
    else if (body_plan.limbs[k].limb_class == JointClass::kHand && confidence < kSure &&
             grownToBody(limbs[k].ribbon, spine))
      map.hidden.push_back(static_cast<int>(k) + 1);
  }
  if (!any) return map;
  for (std::size_t a = 0; a < limbs.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if (!limbs[a].layer || !limbs[b].layer) continue;
      const bool second =
          strengthWithin(limbs[b], limbs[a], look) >= strengthWithin(limbs[a], limbs[b], look);
      ++limbs[second ? b : a].wins;
    }
  map.limb = Plane8::Zero(image.height, image.width);
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < limbs.size(); ++k)
    if (limbs[k].layer) order.push_back(k);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return limbs[a].wins > limbs[b].wins; });
  for (const std::size_t k : order) {
    const Plane8& mask = limbs[k].mask;
    auto there = map.limb.block(limbs[k].box.y0, limbs[k].box.x0, mask.rows(), mask.cols());
    const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> seen = mask != 0 && there == 0;
    if (static_cast<double>(seen.count()) < kLeastSeen * static_cast<double>((mask != 0).count())) continue;
    there = Plane8(
        seen.select(Plane8::Constant(mask.rows(), mask.cols(), static_cast<std::uint8_t>(k + 1)), there));
  }
  takeWhatIsCutOff(silhouette.mask, skeleton, limb_of_joint, map.limb);
  if (!(map.limb != 0).any()) map.limb.resize(0, 0);
  return map;
}

}  // namespace skel
