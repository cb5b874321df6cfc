#include "libskel/cutout/cut_out.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "libskel/core/check.h"
#include "libskel/cutout/free_limbs.h"
#include "libskel/cutout/limb_plane.h"
#include "libskel/cutout/paper_rim.h"
#include "libskel/cutout/skirted_legs.h"
#include "libskel/mesh/fill_hidden.h"
#include "libskel/skeleton/frontal.h"
#include "libskel/skin/skin_weights.h"

namespace skel {
namespace {

using Eigen::Index;
using Eigen::Vector2d;

// A vertex that follows one joint by more is a handle of it: elbows bend in one place, necks and backs all
// along.
constexpr double kOneLimbJoint = 0.55, kOneTrunkJoint = 0.8;
constexpr int kUnderlap_px = 2;  // so far a sheet goes on below the next, lest the ground shows between

// The figure's pieces, or the whole figure as the one that it is.
std::vector<FigurePiece> piecesOf(const DrawnFigure& figure) {
  std::vector<FigurePiece> pieces =
      figurePieces(figure.layers, figure.silhouette, figure.skeleton, figure.body_plan);
  if (pieces.empty()) {
    FigurePiece whole;
    whole.box = figureBox(figure.silhouette.mask);
    whole.mask =
        figure.silhouette.mask.block(whole.box.y0, whole.box.x0, whole.box.height(), whole.box.width());
    whole.hidden = whole.over = Plane8::Zero(whole.mask.rows(), whole.mask.cols());
    pieces.push_back(std::move(whole));
  }
  return pieces;
}

// How far before the viewer's other things a part is painted.
class PaintOrder {
 public:
  PaintOrder(const DrawnFigure& figure, const std::vector<FigurePiece>& pieces, const std::vector<int>& given)
      : order_(figure.body_plan.limbs.size() + 1, 0) {
    for (std::size_t i = 0; i < given.size(); ++i) order_[std::size_t(given[i])] = int(i);
    if (!given.empty()) return;
    const Skeleton& skeleton = figure.skeleton;
    double trunk_z = 0, low = 1e300, high = -1e300;
    int trunk_joints = 0;
    for (const Joint& joint : skeleton.joints) {
      low = std::min(low, joint.position.y()), high = std::max(high, joint.position.y());
      if (joint.name.find('_') != std::string::npos && joint.name != "head_top") continue;
      trunk_z += joint.position.z();
      ++trunk_joints;
    }
    trunk_z /= std::max(1, trunk_joints);
    // Arms of who is drawn from the front are about as deep as the trunk: small differences say nothing.
    const bool from_front = frontal(skeleton, figure.body_plan) == 1;
    for (std::size_t k = 0; k < figure.body_plan.limbs.size(); ++k) {
      const TemplateLimb& limb = figure.body_plan.limbs[k];
      const auto piece = std::find_if(pieces.begin(), pieces.end(),
                                      [&](const FigurePiece& p) { return p.layer == int(k) + 1; });
      double z = 0;
      for (const int joint : limb.joints)
        if (const int j = skeleton.find(figure.body_plan.joints[std::size_t(joint)].name); j >= 0)
          z += (skeleton.joints[std::size_t(j)].position.z() - trunk_z) / double(limb.joints.size());
      const int turn = int(piece - pieces.begin());  // after all others where it is no sheet of its own
      constexpr double kFar = 0.015;                 // of the figure's height
      const std::vector<int>& far = figure.layers.far;
      const bool leg = isLeg(figure.body_plan, limb);
      if (std::find(far.begin(), far.end(), int(k) + 1) != far.end() ||
          (z < -kFar * (high - low) && (leg || !from_front)))
        order_[k + 1] = turn - 200;
      else if (piece == pieces.end())
        order_[k + 1] = leg ? -100 : 100;
      else
        order_[k + 1] = turn;
    }
  }
  int of(int part) const { return order_[std::size_t(part)]; }

 private:
  std::vector<int> order_;
};

// The pieces' masks, those below others a little larger: below what is painted after them.
std::vector<Plane8> underlapped(const std::vector<FigurePiece>& pieces, const Plane8& figure,
                                const PaintOrder& order) {
  constexpr int kNone = -10000;
  Eigen::ArrayXXi top = Eigen::ArrayXXi::Constant(figure.rows(), figure.cols(), kNone);
  for (const FigurePiece& piece : pieces)
    for (int v = 0; v < piece.mask.rows(); ++v)
      for (int u = 0; u < piece.mask.cols(); ++u)
        if (piece.mask(v, u) != 0 && piece.hidden(v, u) == 0) {
          int& there = top(piece.box.y0 + v, piece.box.x0 + u);
          there = std::max(there, order.of(piece.layer));
        }
  std::vector<Plane8> masks;
  for (const FigurePiece& piece : pieces) {
    Plane8 mask = piece.mask;
    for (int step = 0; step < kUnderlap_px; ++step) {
      const Plane8 now = mask;
      for (int v = 0; v < now.rows(); ++v)
        for (int u = 0; u < now.cols(); ++u)
          if (now(v, u) == 0 && top(piece.box.y0 + v, piece.box.x0 + u) > order.of(piece.layer) &&
              ((u > 0 && now(v, u - 1) != 0) || (v > 0 && now(v - 1, u) != 0) ||
               (u + 1 < now.cols() && now(v, u + 1) != 0) || (v + 1 < now.rows() && now(v + 1, u) != 0)))
            mask(v, u) = 255;
    }
    masks.push_back(std::move(mask));
  }
  return masks;
}

// What the piece shows, with what others hide of it filled in; clear around it.
Image pictureOf(const DrawnFigure& figure, const FigurePiece& piece, const Plane8& mask) {
  const PixelBox& box = piece.box;
  Image picture(box.width(), box.height());
  Plane8 known = Plane8::Zero(box.height(), box.width()), hidden = known;
  const Plane8& bridges = figure.silhouette.bridges;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      std::copy_n(figure.image.pixel(box.x0 + x, box.y0 + y), 4, picture.pixel(x, y));
      if (mask(y, x) == 0) continue;
      const bool drawn = bridges.size() == 0 || bridges(box.y0 + y, box.x0 + x) == 0;
      hidden(y, x) = piece.hidden(y, x) != 0 || piece.mask(y, x) == 0;
      known(y, x) = drawn && hidden(y, x) == 0;
    }
  picture = fillHidden(std::move(picture), known, hidden);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (known(y, x) == 0 && hidden(y, x) == 0)
        std::fill_n(picture.pixel(x, y), 4, std::uint8_t(0));
      else if (hidden(y, x) != 0)  // as thick as what hides it, not as the rim that it is filled from
        picture.pixel(x, y)[3] = figure.image.pixel(box.x0 + x, box.y0 + y)[3];
  return picture;
}

// How long the piece of a limb is that bends, to both sides of its root and of its middle joint, px: wide
// limbs are round there, thin ones curve, and short ones keep what is rigid on both sides.
struct Bends {
  double root = 0, middle = 0;
};

// `root_width`: of what of the limb is in the trunk's sheet.
Bends bendsOf(const DrawnFigure& figure, std::size_t limb, double root_width, double width) {
  constexpr double kRootWide = 0.3, kWide = 0.35;                // of the limb's width
  constexpr double kRootThin = 0.1, kThin = 0.12, kShort = 0.3;  // of a bone
  const auto& [root, middle, end] = limbBones(figure, limb).joints;
  const double upper = (middle - root).norm(), shorter = std::min(upper, (end - middle).norm());
  return {std::max(kRootWide * root_width, kRootThin * upper),
          std::clamp(kWide * width, kThin * shorter, kShort * shorter)};
}

// Which limb moves what of a sheet: of each square and of each vertex. `free`: the vertices about the borders
// between limbs and the rest, and about elbows and knees, where paper bends. `worn`: those that most of what
// is around them is a skirt or a thing.
struct Carriers {
  std::vector<int> of_square, of_vertex;
  std::vector<bool> free, worn;
};

Carriers carriersOf(const CutOutSheet& sheet, const Plane8& part, const Plane8& limbs, const PixelBox& box,
                    const std::vector<Bends>& bends) {
  const Lattice& lattice = sheet.lattice;
  Carriers carriers;
  std::vector<std::array<int, 5>> votes(lattice.squares.size(), {0, 0, 0, 0, 0});
  std::vector<int> worn(lattice.squares.size(), 0), of_worn(std::size_t(lattice.vertices.rows()), 0);
  for (int v = 0; v < lattice.square_of.rows(); ++v)
    for (int u = 0; u < lattice.square_of.cols(); ++u)
      if (const int square = lattice.square_of(v, u); square >= 0) {
        ++votes[std::size_t(square)][limbs(box.y0 + v, box.x0 + u)];
        const bool is_worn =
            part.size() != 0 && (part(box.y0 + v, box.x0 + u) == std::uint8_t(Part::kSkirt) ||
                                 part(box.y0 + v, box.x0 + u) == std::uint8_t(Part::kThing));
        worn[std::size_t(square)] += is_worn ? 1 : -1;
      }
  const auto winner = [](const std::array<int, 5>& of) {
    return int(std::max_element(of.begin(), of.end()) - of.begin());
  };
  const std::size_t count = std::size_t(lattice.vertices.rows());
  std::vector<std::array<int, 5>> around(count, {0, 0, 0, 0, 0});
  for (std::size_t s = 0; s < lattice.squares.size(); ++s) {
    carriers.of_square.push_back(winner(votes[s]));
    for (const int v : lattice.squares[s]) {
      ++around[std::size_t(v)][std::size_t(carriers.of_square[s])];
      of_worn[std::size_t(v)] += worn[s];
    }
  }
  std::vector<double> left(count, -1);  // how much farther paper is free, px
  for (std::size_t v = 0; v < count; ++v) {
    carriers.of_vertex.push_back(winner(around[v]));
    if (std::count(around[v].begin(), around[v].end(), 0) == 4) continue;
    for (std::size_t limb = 1; limb < 5; ++limb)
      if (around[v][limb] > 0) left[v] = std::max(left[v], bends[limb].root);
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const std::array<int, 4>& square : lattice.squares)
      for (const int a : square)
        for (const int b : square) {
          const double reach =
              left[std::size_t(a)] - (lattice.vertices.row(a) - lattice.vertices.row(b)).norm();
          if (reach > left[std::size_t(b)] + 1e-9) left[std::size_t(b)] = reach, changed = true;
        }
  }
  for (const double reach : left) carriers.free.push_back(reach >= 0);
  for (const int more : of_worn) carriers.worn.push_back(more > 0);
  return carriers;
}

// Frees the vertices about elbows and knees.
void freeMiddles(const DrawnFigure& figure, const std::vector<Bends>& bends, const CutOutSheet& sheet,
                 const Eigen::Vector2i& corner, Carriers& carriers) {
  for (std::size_t limb = 1; limb <= std::min<std::size_t>(4, figure.body_plan.limbs.size()); ++limb) {
    const LimbBones bones = limbBones(figure, limb);
    for (Index v = 0; v < sheet.lattice.vertices.rows(); ++v)
      if (carriers.of_vertex[std::size_t(v)] == int(limb)) {
        const Vector2d at = sheet.lattice.vertices.row(v).transpose() + corner.cast<double>();
        const double along = bones.nearest(at).along;
        const std::size_t half = along < 1 ? 0 : 1;
        const double bone = (bones.joints[half + 1] - bones.joints[half]).norm();
        if (std::abs(along - 1) * bone < bends[limb].middle) carriers.free[std::size_t(v)] = true;
      }
  }
}

// The drawing flat on the model's plane, all sheets in one mesh, for the skin: what different limbs move is
// not joined.
TriangleMesh flatMesh(const std::vector<CutOutSheet>& sheets, const std::vector<Carriers>& carriers) {
  TriangleMesh mesh;
  Index vertices = 0;
  for (const CutOutSheet& sheet : sheets) vertices += sheet.lattice.vertices.rows();
  mesh.vertices.resize(vertices, 3);
  mesh.layer.resize(vertices);
  std::vector<Eigen::RowVector3i> triangles;
  Index first = 0;
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    const CutOutSheet& sheet = sheets[s];
    for (Index v = 0; v < sheet.lattice.vertices.rows(); ++v) {
      const Vector2d at = sheet.placed(sheet.lattice.vertices.row(v).transpose());
      mesh.vertices.row(first + v) << float(at.x()), float(at.y()), 0.f;
      mesh.layer[first + v] = carriers[s].of_vertex[std::size_t(v)];
    }
    const Eigen::MatrixX3i own = sheet.lattice.triangles();
    for (Index t = 0; t < own.rows(); ++t) {
      const Eigen::RowVector3i corners = own.row(t).array() + int(first);
      if (mesh.layer[corners[0]] == mesh.layer[corners[1]] &&
          mesh.layer[corners[0]] == mesh.layer[corners[2]])
        triangles.push_back(corners);
    }
    first += sheet.lattice.vertices.rows();
  }
  mesh.triangles.resize(Index(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) mesh.triangles.row(Index(t)) = triangles[t];
  return mesh;
}

Eigen::MatrixX2d placedVertices(const CutOutSheet& sheet) {
  Eigen::MatrixX2d places(sheet.lattice.vertices.rows(), 2);
  for (Index v = 0; v < places.rows(); ++v)
    places.row(v) = sheet.placed(sheet.lattice.vertices.row(v).transpose()).transpose();
  return places;
}

// Of each vertex, the first vertex of the part of the lattice that it is in.
std::vector<int> partsOf(const Lattice& lattice) {
  std::vector<int> part(std::size_t(lattice.vertices.rows()));
  std::iota(part.begin(), part.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (const std::array<int, 4>& square : lattice.squares) {
      int least = part[std::size_t(square[0])];
      for (const int v : square) least = std::min(least, part[std::size_t(v)]);
      for (const int v : square)
        if (part[std::size_t(v)] != least) part[std::size_t(v)] = least, changed = true;
    }
  }
  return part;
}

// Of each joint of the skeleton: whether it is a leg's.
std::vector<bool> legJoints(const DrawnFigure& figure) {
  std::vector<bool> of_leg(figure.skeleton.joints.size(), false);
  for (const TemplateLimb& limb : figure.body_plan.limbs)
    for (const int joint : limb.joints)
      if (const int j = figure.skeleton.find(figure.body_plan.joints[std::size_t(joint)].name);
          j >= 0 && isLeg(figure.body_plan, limb))
        of_leg[std::size_t(j)] = true;
  return of_leg;
}

// `first`: the sheet's first vertex among those of `weights`. Legs hold no skirt and no thing: they hang from
// the trunk, and what shows of legs below takes a hem along.
void hang(const SkinWeights& weights, Index first, const Carriers& carriers, const std::vector<bool>& of_leg,
          CutOutSheet& sheet) {
  const Eigen::MatrixX2d places = placedVertices(sheet);
  const auto hold = [&](Index v) { sheet.handles.push_back({int(v), weights.joints(first + v, 0)}); };
  const auto isHeld = [&](Index v) {
    const std::size_t i = std::size_t(v);
    return !carriers.free[i] && !(carriers.worn[i] && of_leg[weights.joints(first + v, 0)]);
  };
  for (Index v = 0; v < places.rows(); ++v)
    if (const double most = carriers.of_vertex[std::size_t(v)] == 0 ? kOneTrunkJoint : kOneLimbJoint;
        double(weights.weights(first + v, 0)) >= most && isHeld(v))
      hold(v);
  // What hangs on nothing moves with the joint that it is nearest to.
  const std::vector<int> part = partsOf(sheet.lattice);
  std::vector<int> held_in(part.size(), 0);
  for (const CutOutSheet::Handle& handle : sheet.handles)
    ++held_in[std::size_t(part[std::size_t(handle.vertex)])];
  for (Index v = 0; v < places.rows(); ++v)
    if (held_in[std::size_t(part[std::size_t(v)])] < 2) hold(v);
  std::vector<int> held;
  for (const CutOutSheet::Handle& handle : sheet.handles) held.push_back(handle.vertex);
  sheet.mesh = std::make_shared<const ArapMesh>(places, sheet.lattice.triangles(), held);
}

}  // namespace

CutOut makeCutOut(const DrawnFigure& drawn, const CutOutOptions& options) {
  const LayerMap layers = withoutFreeLimbs(drawn, withSkirtedLegs(drawn));
  const Image image = withoutPaperRim(drawn.image, drawn.silhouette);
  const DrawnFigure figure{image,           drawn.silhouette, drawn.skeleton,
                           drawn.body_plan, layers,           drawn.model_from_image};
  const std::vector<FigurePiece> pieces = piecesOf(figure);
  const PaintOrder order(figure, pieces, options.order);
  const std::vector<Plane8> masks = underlapped(pieces, figure.silhouette.mask, order);
  double area = 0;
  for (const Plane8& mask : masks) area += double((mask != 0).count());
  const int side_px = std::max(1, int(std::lround(std::sqrt(area / options.squares))));
  const Plane8 limbs = limbPlane(figure, pieces);
  const std::vector<double> widths = limbWidths(figure, limbs);
  const std::vector<double> all_widths =
      layers.any() ? limbWidths(figure, (limbs != 0).select(limbs, layers.limb)) : widths;
  std::vector<Bends> bends(widths.size());
  for (std::size_t limb = 1; limb <= std::min<std::size_t>(4, figure.body_plan.limbs.size()); ++limb)
    bends[limb] = bendsOf(figure, limb, widths[limb], all_widths[limb]);
  CutOut cut_out;
  std::vector<Carriers> carriers;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    CutOutSheet& sheet = cut_out.sheets.emplace_back();
    const Eigen::Vector2i corner(pieces[i].box.x0, pieces[i].box.y0);
    sheet.layer = pieces[i].layer;
    sheet.picture = pictureOf(figure, pieces[i], masks[i]);
    sheet.placed = figure.model_from_image;
    sheet.placed.origin_px -= corner.cast<double>();
    sheet.lattice = latticeOf(masks[i], side_px);
    if (sheet.layer != 0)
      carriers.push_back({std::vector<int>(sheet.lattice.squares.size(), sheet.layer),
                          std::vector<int>(std::size_t(sheet.lattice.vertices.rows()), sheet.layer),
                          std::vector<bool>(std::size_t(sheet.lattice.vertices.rows()), false),
                          std::vector<bool>(std::size_t(sheet.lattice.vertices.rows()), false)});
    else
      carriers.push_back(carriersOf(sheet, figure.layers.part, limbs, pieces[i].box, bends));
    freeMiddles(figure, bends, sheet, corner, carriers.back());
    sheet.part = carriers.back().of_square;
  }
  const TriangleMesh flat = flatMesh(cut_out.sheets, carriers);
  Skeleton on_plane = figure.skeleton;
  for (Joint& joint : on_plane.joints) joint.position.z() = 0;
  const SkinWeights weights =
      computeSkinWeights(flat, on_plane, SkinMethod::kGeodesic, {},
                         jointLayers(figure.skeleton, figure.body_plan, flat, figure.layers));
  const std::vector<bool> of_leg = legJoints(figure);
  Index first = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    hang(weights, first, carriers[i], of_leg, cut_out.sheets[i]);
    first += cut_out.sheets[i].lattice.vertices.rows();
  }

  for (std::size_t s = 0; s < cut_out.sheets.size(); ++s)
    for (std::size_t square = 0; square < cut_out.sheets[s].lattice.squares.size(); ++square)
      cut_out.patches.push_back({s, square});
  const auto turn = [&](const CutOut::Patch& patch) {
    return order.of(cut_out.sheets[patch.sheet].part[patch.square]);
  };
  std::stable_sort(cut_out.patches.begin(), cut_out.patches.end(),
                   [&](const CutOut::Patch& a, const CutOut::Patch& b) { return turn(a) < turn(b); });
  return cut_out;
}

std::vector<Eigen::MatrixX2d> posedSheets(const CutOut& cut_out, const FlatPose& pose) {
  std::vector<Eigen::MatrixX2d> posed;
  for (const CutOutSheet& sheet : cut_out.sheets) {
    Eigen::MatrixX2d targets(Index(sheet.handles.size()), 2);
    for (std::size_t h = 0; h < sheet.handles.size(); ++h) {
      const Vector2d rest = sheet.placed(sheet.lattice.vertices.row(sheet.handles[h].vertex).transpose());
      targets.row(Index(h)) = pose.moved(sheet.handles[h].joint, rest).transpose();
    }
    posed.push_back(sheet.mesh->deform(targets));
  }
  return posed;
}

double tornShare(const CutOut& cut_out, const std::vector<Eigen::MatrixX2d>& posed) {
  constexpr double kTorn = 2.5;
  SKEL_CHECK_EQ(posed.size(), cut_out.sheets.size());
  double torn = 0, all = 0;
  for (std::size_t s = 0; s < posed.size(); ++s) {
    const CutOutSheet& sheet = cut_out.sheets[s];
    const double side = sheet.lattice.side_px * sheet.placed.scale.x(), area = side * side;
    for (const auto& [a, b, c, d] : sheet.lattice.squares) {
      const auto way = [&](int from, int to) -> Vector2d {
        return (posed[s].row(to) - posed[s].row(from)).transpose();
      };
      const Vector2d right = way(a, b), down = way(a, c);
      const double longest = std::max({right.norm(), down.norm(), way(b, d).norm(), way(c, d).norm()});
      // Down is against y.
      const bool turned_over = right.x() * down.y() - right.y() * down.x() > 0;
      all += area;
      if (longest > kTorn * side || turned_over) torn += area;
    }
  }
  return all > 0 ? torn / all : 0;
}

}  // namespace skel
