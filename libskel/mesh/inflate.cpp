// L. Feng, X. Yang, S. Xiao, "MagicToon: A 2D-to-3D creative cartoon modeling system with mobile AR" (2017),
// section on inflation. The Poisson equation is solved by linear finite elements on the mesh itself
// (cotangent weights: U. Pinkall, K. Polthier, "Computing discrete minimal surfaces and their conjugates",
// 1993).
#include "libskel/mesh/inflate.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/mesh/cross_sections.h"
#include "libskel/mesh/fill_hidden.h"
#include "libskel/mesh/ink_hull.h"
#include "libskel/mesh/lay_over.h"
#include "libskel/mesh/local_mean.h"
#include "libskel/mesh/neck.h"
#include "libskel/mesh/outline.h"
#include "libskel/mesh/outline_band.h"
#include "libskel/mesh/planar_mesh.h"
#include "libskel/mesh/shoes.h"
#include "libskel/mesh/texture.h"
#include "libskel/mesh/texture_atlas.h"
#include "libskel/silhouette/outline.h"

namespace skel {
namespace {

constexpr double kVertexCount = 3500;

// Two sheets share the rim: A / cell² nodes twice, and the rim's crossings with the grid's lines, 4/π·L /
// cell of them for an outline of length L in no special direction.
struct VertexEstimate {
  double twice_area_px2 = 0, crossings_px = 0;

  double count(double cell_px) const { return (twice_area_px2 / cell_px + crossings_px) / cell_px; }
  double cell(double count) const {
    return (crossings_px + std::sqrt(crossings_px * crossings_px + 4 * twice_area_px2 * count)) / (2 * count);
  }
};

void addTo(VertexEstimate& result, const std::vector<Polygon>& outline) {
  for (const Polygon& curve : outline) {
    Eigen::Vector2d p = curve.back();
    for (const Eigen::Vector2d& q : curve) {
      result.twice_area_px2 += p.x() * q.y() - q.x() * p.y();
      result.crossings_px += 4 / 3.14159265358979 * (q - p).norm();
      p = q;
    }
  }
}

// The flange that a drawn outline becomes rises from the rim to this share of the outline's width: seen from
// the side it is next to nothing.
constexpr double kFlange = 0.06;
constexpr double kLip = 1;  // how far the rim stands forward there, as a share of that width

// −Δu + u / range² = c of each inner vertex. A long strip of width w gets z² = c/2·(w²/4 − x²), as thick as
// wide for c = 2; a disc of diameter d gets z² = c/4·(d²/4 − r²), a ball for c = 4; what is wider than the
// range levels out at sqrt(c)·range.
std::vector<DepthThere> depthsOf(const PlanarMesh& mesh, const std::vector<DepthBone>& bones) {
  std::vector<DepthThere> depths;
  for (int v = 0; v < mesh.inner_count; ++v) depths.push_back(depthAt(bones, mesh.vertices[v]));
  return depths;
}

// z of the inner vertices, px. Those within the drawn outline (`band`, its width there, else 0) lie on its
// flange; the body rises behind it.
Eigen::VectorXd inflatedHeights(const PlanarMesh& mesh, const std::vector<DepthThere>& depths,
                                const std::vector<double>& band) {
  const int count = mesh.inner_count;
  // Obtuse triangles at the rim could let u touch zero inside.
  const double floor = 0.05 * mesh.cell_px;
  const auto flange = [&](int v) { return std::pow(std::max(kFlange * band[v], floor), 2); };
  const auto free = [&](int v) { return v < count && band[v] == 0; };
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(12 * mesh.triangles.size());
  Eigen::VectorXd source = Eigen::VectorXd::Zero(count);
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector2d p[3] = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    const Eigen::Vector2d e = p[1] - p[0], f = p[2] - p[0];
    const double double_area = std::abs(e.x() * f.y() - e.y() * f.x());
    for (int k = 0; k < 3; ++k) {
      const int a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      const double half_cotangent = 0.5 * (p[(k + 1) % 3] - p[k]).dot(p[(k + 2) % 3] - p[k]) / double_area;
      if (free(t[k])) {
        const DepthThere& there = depths[t[k]];
        source[t[k]] += there.source * double_area / 6;
        if (there.most_px > 0)
          entries.emplace_back(t[k], t[k], there.source / (there.most_px * there.most_px) * double_area / 6);
      }
      if (free(a)) entries.emplace_back(a, a, half_cotangent);
      if (free(b)) entries.emplace_back(b, b, half_cotangent);
      // The solver reads the lower triangle alone.
      if (free(a) && free(b)) entries.emplace_back(std::max(a, b), std::min(a, b), -half_cotangent);
      if (free(a) && b < count && !free(b)) source[a] += half_cotangent * flange(b);
      if (free(b) && a < count && !free(a)) source[b] += half_cotangent * flange(a);
    }
  }
  for (int v = 0; v < count; ++v)
    if (!free(v)) entries.emplace_back(v, v, 1), source[v] = flange(v);
  Eigen::SparseMatrix<double> laplacian(count, count);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian);
  SKEL_CHECK(solver.info() == Eigen::Success);
  const Eigen::VectorXd u = solver.solve(source);
  return u.unaryExpr([&](double value) { return std::sqrt(std::max(value, floor * floor)); });
}

constexpr int kLeastTexture = kLeastMaxTexture / 2;  // texels a side

// The back's texture and where the front's points lie in it.
struct BackTexture {
  Image image;
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  // its coordinates of the front's (0, 0)
  Eigen::Vector2d size = Eigen::Vector2d::Ones();    // and how far it is from there to (1, 1)
};

// The limit of a texture of which two must fit side by side into `max_texture_px`.
int halfOf(int max_texture_px, const PixelBox& box) {
  const double long_by_short =
      std::max(box.width(), box.height()) / double(std::min(box.width(), box.height()));
  const double fitting = (0.5 * max_texture_px - 2 * kTextureMargin) * long_by_short + 2 * kTextureMargin;
  return std::max(kLeastTexture, static_cast<int>(std::min(fitting, double(max_texture_px))));
}

// `whole_px`, `around`: of a piece, what backColors() asks for.
BackTexture backTexture(const DrawingTexture& front, const PixelBox& box, const InflateOptions& options,
                        int whole_px, const WholeFigure* around) {
  BackTexture back;
  if (!options.back_picture) {
    std::optional<HeadDisc> head = options.head;
    if (head) {
      const Eigen::Vector2d texels(front.image.width, front.image.height);
      head->center = front.uvFromImage(head->center).cwiseProduct(texels);
      head->radius *= front.image.width / front.size_px.x();
    }
    back.image = backColors(front.image, front.figure, head, whole_px, around);
    return back;
  }
  // Seen from behind, left is right.
  const BackPicture& picture = *options.back_picture;
  const PixelBox other = figureBox(picture.mask);
  const bool alike = (other.width() < other.height()) == (box.width() < box.height());
  const DrawingTexture texture =
      drawingTexture(picture.image, picture.mask, other,
                     alike ? halfOf(options.max_texture_px, other) : options.max_texture_px / 2);
  const auto behind = [&](const Eigen::Vector2d& uv) {
    const Eigen::Vector2d p = front.corner_px + uv.cwiseProduct(front.size_px);
    const Eigen::Vector2d at((p.x() - box.x0 + 0.5) / box.width(), (p.y() - box.y0 + 0.5) / box.height());
    return texture.uvFromImage(
        {other.x1 - 0.5 - at.x() * other.width(), other.y0 - 0.5 + at.y() * other.height()});
  };
  back.image = texture.image;
  back.corner = behind({0, 0});
  back.size = behind({1, 1}) - back.corner;
  return back;
}

// A piece of the figure on its way to the mesh.
struct Sheet {
  PixelBox box;  // of the image
  std::vector<Polygon> outline;
  PlanarMesh planar;
  std::vector<OutlineSample> rim;
  OutlineBand outline_band;
  std::vector<Eigen::Vector2d> place;  // of all vertices, image px: where they stand
  Heights z;
  Eigen::VectorXd middle;      // px before the drawing's plane, of all vertices
  std::vector<double> lip;     // and of the rim's before that
  std::vector<double> offset;  // px, of all vertices
  DrawingTexture front;
  std::optional<BackTexture> back;

  int inner() const { return planar.inner_count; }
  int size() const { return static_cast<int>(planar.vertices.size()); }
  int meshVertices() const { return size() + inner(); }
};

// Where a picture lies in the one that it is part of, texels.
struct TexturePlace {
  Eigen::Vector2d corner, size, whole;
  Eigen::RowVector2f operator()(const Eigen::Vector2d& uv) const {
    return (corner + uv.cwiseProduct(size)).cwiseQuotient(whole).cast<float>().transpose();
  }
};

struct JoinedTexture {
  Image image;
  std::vector<TexturePlace> places;
};

Eigen::Vector2d sizeOf(const Image& image) { return {image.width, image.height}; }

// Front and back in one picture, side by side or one over the other, whichever is the smaller.
JoinedTexture joinTwo(const Image& a, const Image& b) {
  const bool beside = a.width + b.width <= a.height + b.height;
  JoinedTexture joined;
  joined.image = Image(beside ? a.width + b.width : std::max(a.width, b.width),
                       beside ? std::max(a.height, b.height) : a.height + b.height);
  // What neither covers repeats the nearest: no seam of another colour where a picture is shrunk.
  const auto copy = [&](const Image& part, int x0, int y0, int x1, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        std::copy_n(part.pixel(std::min(x - x0, part.width - 1), std::min(y - y0, part.height - 1)), 4,
                    joined.image.pixel(x, y));
  };
  const int split_x = beside ? a.width : 0, split_y = beside ? 0 : a.height;
  const Image& both = joined.image;
  copy(a, 0, 0, beside ? a.width : both.width, beside ? both.height : a.height);
  copy(b, split_x, split_y, both.width, both.height);
  joined.places = {{{0, 0}, sizeOf(a), sizeOf(both)}, {{split_x, split_y}, sizeOf(b), sizeOf(both)}};
  return joined;
}

JoinedTexture joinTextures(const std::vector<const Image*>& images) {
  if (images.size() == 1) {
    return {*images[0], {{{0, 0}, {1, 1}, {1, 1}}}};
  }
  if (images.size() == 2) return joinTwo(*images[0], *images[1]);
  std::vector<AtlasTile> tiles;
  for (const Image* image : images) tiles.push_back({*image});
  TextureAtlas atlas = packAtlas(tiles);
  JoinedTexture joined{std::move(atlas.image), {}};
  for (std::size_t k = 0; k < tiles.size(); ++k)
    joined.places.push_back({atlas.offset[k].matrix().cast<double>().cwiseProduct(sizeOf(joined.image)),
                             sizeOf(*images[k]), sizeOf(joined.image)});
  return joined;
}

std::vector<Sheet> sheetsOf(const std::vector<FigurePiece>& pieces, const Silhouette& silhouette,
                            const PixelBox& box) {
  std::vector<Sheet> sheets(std::max<std::size_t>(1, pieces.size()));
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    sheets[i].box = pieces.empty() ? box : pieces[i].box;
    for (const Polygon& corners : pieces.empty() ? silhouette.outline : traceOutline(pieces[i].mask))
      sheets[i].outline.push_back(sideMiddles(corners));
  }
  return sheets;
}

// Of pieces, within their boxes.
void triangulate(const std::vector<FigurePiece>& pieces, const Silhouette& silhouette, double cell_px,
                 std::vector<Sheet>& sheets) {
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const Plane8& mask = pieces.empty() ? silhouette.mask : pieces[i].mask;
    sheets[i].planar =
        triangulateFigure(mask, pieces.empty() ? sheets[i].box : figureBox(mask), sheets[i].outline, cell_px);
  }
}

double vertexCount(const std::vector<Sheet>& sheets) {
  double count = 0;
  for (const Sheet& sheet : sheets) count += sheet.meshVertices();
  return count;
}

// The limit of one piece's texture so that all are as fine as the whole figure's would be.
int shareOf(int max_texture_px, const PixelBox& piece, const PixelBox& figure) {
  const double shrink =
      std::max(1., std::max(figure.width(), figure.height()) / double(max_texture_px - 2 * kTextureMargin));
  return std::max(
      kLeastTexture,
      static_cast<int>(std::ceil(std::max(piece.width(), piece.height()) / shrink)) + 2 * kTextureMargin);
}

// What its front wears, and where a drawn outline lies. `mask`: the piece; `colored`: where it shows its own
// colours; both of the size of `image`.
void dress(const Image& image, const Plane8& mask, const Plane8& colored, bool thin_outline,
           int max_texture_px, Sheet& sheet) {
  sheet.outline_band = {std::vector<double>(sheet.inner(), 0),
                        std::vector<bool>(sheet.inner(), false),
                        {},
                        sheet.planar.vertices};
  if (thin_outline) {
    sheet.rim = drawnOutline(image, mask, sheet.outline);
    sheet.outline_band = outlineBand(sheet.planar, sheet.rim);
  }
  sheet.front = drawingTexture(image, colored, figureBox(mask), max_texture_px);
}

// Within its box; then the sheet goes to its place in the image.
void dressPiece(const Image& image, const FigurePiece& piece, const Plane8& drawn, bool thin_outline,
                int max_texture_px, Sheet& sheet) {
  const PixelBox& box = piece.box;
  Image part(box.width(), box.height());
  for (int y = 0; y < part.height; ++y)
    std::copy_n(image.pixel(box.x0, box.y0 + y), 4 * std::size_t(part.width), part.pixel(0, y));
  const Plane8 colored =
      (piece.mask != 0 && drawn.block(box.y0, box.x0, part.height, part.width) != 0).cast<std::uint8_t>();
  const Image filled =
      fillHidden(std::move(part), Plane8((colored != 0 && piece.hidden == 0).cast<std::uint8_t>()),
                 Plane8((colored != 0 && piece.hidden != 0).cast<std::uint8_t>()));
  dress(filled, piece.mask, colored, thin_outline, max_texture_px, sheet);
  const Eigen::Vector2d corner(box.x0, box.y0);
  for (OutlineSample& sample : sheet.rim) sample.point += corner;
  for (std::vector<Eigen::Vector2d>* points :
       {&sheet.planar.vertices, &sheet.outline_band.ink, &sheet.outline_band.drawn})
    for (Eigen::Vector2d& p : *points) p += corner;
  sheet.front.corner_px += corner;
}

// The bones and feet of a piece of a figure; of one in one piece all.
BodyDepth depthOf(const BodyDepth& body, const std::vector<FigurePiece>& pieces, std::size_t piece) {
  if (pieces.empty()) return body;
  const auto holds = [](const FigurePiece& p, const Eigen::Vector2d& at) {
    const int x = static_cast<int>(std::lround(at.x())) - p.box.x0,
              y = static_cast<int>(std::lround(at.y())) - p.box.y0;
    return x >= 0 && y >= 0 && x < p.mask.cols() && y < p.mask.rows() && p.mask(y, x) != 0;
  };
  // What its limb's piece does not hold belongs to the first that does.
  const auto isOf = [&](int limb, const Eigen::Vector2d& at) {
    const auto first = [&](const auto& fits) {
      return static_cast<std::size_t>(std::find_if(pieces.begin(), pieces.end(), fits) - pieces.begin());
    };
    std::size_t owner = first([&](const FigurePiece& p) { return p.layer == limb && holds(p, at); });
    if (owner == pieces.size()) owner = first([&](const FigurePiece& p) { return holds(p, at); });
    if (owner == pieces.size()) owner = first([&](const FigurePiece& p) { return p.layer == limb; });
    return owner == piece || (owner == pieces.size() && piece == 0);
  };
  BodyDepth own;
  for (const DepthBone& bone : body.bones)
    if (isOf(bone.layer, (bone.from + bone.to) / 2)) own.bones.push_back(bone);
  for (const DepthFoot& foot : body.feet)
    if (isOf(foot.layer, foot.foot)) own.feet.push_back(foot);
  if (piece == 0) own.neck = body.neck, own.sections = body.sections, own.capes = body.capes;
  return own;
}

// Of the band of the front's outline what the back shows as well.
std::vector<double> bandBehind(const Sheet& sheet) {
  std::vector<double> band = sheet.outline_band.width_px;
  if (!sheet.back) return band;
  const Image &front = sheet.front.image, &back = sheet.back->image;
  for (int v = 0; v < sheet.inner(); ++v) {
    if (band[v] == 0) continue;
    const Eigen::Vector2d at = sheet.front.uvFromImage(sheet.outline_band.ink[v])
                                   .cwiseProduct(Eigen::Vector2d(front.width, front.height));
    const int x = std::clamp(static_cast<int>(at.x()), 0, front.width - 1),
              y = std::clamp(static_cast<int>(at.y()), 0, front.height - 1);
    if (!std::equal(front.pixel(x, y), front.pixel(x, y) + 3, back.pixel(x, y))) band[v] = 0;
  }
  return band;
}

// The rim stands forward where only the front shows the outline (`band`, `behind`: of the inner vertices):
// the flange then looks inwards, and who looks from the side sees the back's colours up to the rim.
std::vector<double> lipOf(const PlanarMesh& mesh, const std::vector<double>& band,
                          const std::vector<double>& behind) {
  const std::size_t inner = static_cast<std::size_t>(mesh.inner_count), rim = mesh.vertices.size() - inner;
  std::vector<double> width(rim, 0), lip(rim, 0);
  std::vector<int> beside(rim, 0);
  for (const auto& t : mesh.triangles)
    for (const int a : t)
      for (const int b : t) {
        if (a < mesh.inner_count || b >= mesh.inner_count) continue;
        const std::size_t at = static_cast<std::size_t>(a) - inner;
        ++beside[at];
        if (behind[b] == 0) width[at] += band[b];
      }
  for (std::size_t v = 0; v < rim; ++v) width[v] /= std::max(1, beside[v]);
  // Smooth along the rim.
  lip = width;
  for (const auto& [a, b] : mesh.rim)
    for (const auto& [to, from] : {std::pair{a, b}, {b, a}}) lip[to - inner] += width[from - inner];
  for (double& value : lip) value *= kLip / 3;
  return lip;
}

// Behind a flange, z of the inner vertices rises to the height that the body has without one (`plain`): an
// outline that is wide for its limb must not make that flat.
Eigen::VectorXd heightsBehind(const PlanarMesh& mesh, const std::vector<DepthThere>& depths,
                              const std::vector<double>& band, const Eigen::VectorXd& plain,
                              const Eigen::VectorXd& plain_mean, double range_px) {
  Eigen::VectorXd z = inflatedHeights(mesh, depths, band);
  const Eigen::VectorXd mean = localMean(mesh, z, range_px);
  for (int v = 0; v < mesh.inner_count; ++v)
    if (band[v] == 0) z[v] = std::min(plain[v], z[v] * std::max(1., plain_mean[v] / mean[v]));
  return z;
}

// How far legs that are seen from the side lie before the drawing's plane.
Eigen::VectorXd asideOf(const BodyDepth& body, double range_px, const PlanarMesh& mesh) {
  Eigen::VectorXd aside = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.vertices.size()));
  if (std::none_of(body.bones.begin(), body.bones.end(),
                   [](const DepthBone& bone) { return bone.to_aside_px != 0; }))
    return aside;
  for (Eigen::Index v = 0; v < aside.size(); ++v)
    aside[v] = asideAt(body.bones, mesh.vertices[static_cast<std::size_t>(v)]);
  return localMean(mesh, aside, range_px);
}

// 1 on capes, 0 elsewhere, of all vertices; between them it goes over within the range.
Eigen::VectorXd capesOf(const DepthCapes& capes, double range_px, const PlanarMesh& mesh) {
  Eigen::VectorXd share(static_cast<Eigen::Index>(mesh.vertices.size()));
  for (Eigen::Index v = 0; v < share.size(); ++v) {
    const Eigen::Vector2d& p = mesh.vertices[static_cast<std::size_t>(v)];
    const int x = std::clamp(static_cast<int>(p.x()), 0, static_cast<int>(capes.mask.cols()) - 1),
              y = std::clamp(static_cast<int>(p.y()), 0, static_cast<int>(capes.mask.rows()) - 1);
    share[v] = capes.mask(y, x) != 0;
  }
  return localMean(mesh, share, range_px);
}

// z of the inner vertices of a body without an outline, px.
Eigen::VectorXd plainHeights(const BodyDepth& body, const std::vector<DepthThere>& depths, double long_px,
                             const PlanarMesh& mesh) {
  constexpr double kCapeRange = 0.02;  // of the figure's long side
  Eigen::VectorXd z = inflatedHeights(mesh, depths, std::vector<double>(depths.size(), 0));
  if (body.sections) z = z.cwiseMax(leastHeights(mesh, *body.sections));
  if (body.capes) {
    const Eigen::VectorXd share = capesOf(*body.capes, kCapeRange * long_px, mesh);
    z.array() *= 1 - (1 - body.capes->thickness) * share.head(mesh.inner_count).array();
  }
  if (body.neck) z.array() *= neckProfile(mesh, z, *body.neck).array();
  return z;
}

// How thick it is, and where its points stand; sheet.middle must be known. `long_px`: the figure's long side.
void giveDepth(const BodyDepth& body, bool own_back, double long_px, Sheet& sheet) {
  constexpr double kAround = 0.07;       // of the figure's long side: how far the depth of a part reaches
  constexpr double kMiddleOfMean = 1.3;  // half depth in the middle of a tube or a ball by its mean, about
  const std::vector<DepthThere> depths = depthsOf(sheet.planar, body.bones);
  const std::vector<double>& band = sheet.outline_band.width_px;
  const std::vector<double> none(band.size(), 0);
  // A back that shows no outline is round up to the rim.
  const std::vector<double> behind = own_back ? bandBehind(sheet) : band;
  const Eigen::VectorXd plain = plainHeights(body, depths, long_px, sheet.planar);
  const double range_px = kAround * long_px;
  const Eigen::VectorXd plain_mean = localMean(sheet.planar, plain, range_px);
  const auto heights = [&](const std::vector<double>& flange) {
    return flange == none ? plain : heightsBehind(sheet.planar, depths, flange, plain, plain_mean, range_px);
  };
  sheet.z.front = heights(band);
  sheet.z.back = behind == band ? sheet.z.front : heights(behind);
  sheet.lip = lipOf(sheet.planar, band, behind);
  sheet.place = sheet.planar.vertices;
  if (own_back) {
    Eigen::VectorXd forward(sheet.inner());
    for (int v = 0; v < sheet.inner(); ++v) forward[v] = depths[v].forward;
    sheet.middle += kMiddleOfMean * localMean(sheet.planar, forward.cwiseProduct(plain), range_px);
    sheet.z.front.array() *= 1 - forward.array();
    sheet.z.back.array() *= 1 + forward.array();
  }
  putOnShoes(sheet.planar, body.feet, behind, sheet.outline_band, sheet.z, sheet.place);
}

// Brings each piece before those behind it.
void layPieces(std::vector<Sheet>& sheets, const std::vector<FigurePiece>& pieces, const PixelBox& box) {
  for (Sheet& sheet : sheets) sheet.offset.assign(sheet.middle.begin(), sheet.middle.end());
  if (sheets.size() == 1) return;
  const double cell_px = sheets.front().planar.cell_px, margin = 2 * cell_px + 2;
  Relief relief({box.x0 - margin, box.y0 - margin}, {box.x1 + margin, box.y1 + margin}, cell_px / 2);
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    if (i > 0 && pieces[i].behind) continue;
    if (i > 0) {
      Eigen::VectorXd behind = -sheets[i].middle;
      behind.head(sheets[i].inner()) += sheets[i].z.back;
      const std::vector<double> lift = layOver(relief, sheets[i].planar, behind, pieces[i]);
      for (std::size_t v = 0; v < lift.size(); ++v) sheets[i].offset[v] += lift[v];
    }
    relief.raise(sheets[i].planar, sheets[i].z.front, sheets[i].offset);
  }
}

}  // namespace

TriangleMesh inflate(const Image& image, const Silhouette& silhouette, const InflateOptions& options,
                     const std::vector<FigurePiece>& pieces) {
  SKEL_CHECK(silhouette.found());
  SKEL_CHECK_EQ(silhouette.mask.rows(), image.height);
  SKEL_CHECK_EQ(silhouette.mask.cols(), image.width);
  SKEL_CHECK(options.spacing_px >= 0 && options.thickness > 0 && options.max_texture_px >= kLeastMaxTexture);

  const PixelBox box = figureBox(silhouette.mask);
  SKEL_CHECK(box.width() > 0);
  std::vector<Sheet> sheets = sheetsOf(pieces, silhouette, box);
  VertexEstimate estimate;
  for (const Sheet& sheet : sheets) addTo(estimate, sheet.outline);
  const double px_per_grid_px = std::max(box.width(), box.height()) / double(kWorkingGridSize);
  double cell_px = options.spacing_px * px_per_grid_px;
  if (cell_px == 0) cell_px = estimate.cell(kVertexCount);
  if (estimate.count(cell_px) > kMaxInflatedVertices) {
    std::ostringstream message;
    message << "a mesh spacing of " << options.spacing_px << " px would give more than "
            << kMaxInflatedVertices << " vertices; use "
            << estimate.cell(kMaxInflatedVertices) / px_per_grid_px << " or more";
    throw UsageError(message.str());
  }
  triangulate(pieces, silhouette, cell_px, sheets);
  // A figure full of holes smaller than a cell loses them, and with them vertices that were counted on.
  for (int attempt = 0; attempt < 4 && options.spacing_px == 0; ++attempt) {
    const double count = vertexCount(sheets);
    if (count > 0.7 * kVertexCount && count < 1.3 * kVertexCount) break;
    cell_px *= std::sqrt(count / kVertexCount);
    triangulate(pieces, silhouette, cell_px, sheets);
  }

  TriangleMesh mesh;
  mesh.model_from_image.turned_rad = options.turned_rad;
  const auto upright = [&](const Eigen::Vector2d& p) { return mesh.model_from_image.upright(p); };
  // Bridges show the paper: they take the colours of what they join.
  const Plane8 drawn = silhouette.bridges.size() == 0
                           ? silhouette.mask
                           : Plane8((silhouette.bridges != 0)
                                        .select(Plane8::Zero(silhouette.mask.rows(), silhouette.mask.cols()),
                                                silhouette.mask));
  const bool same_back = options.back == Back::kSame && !options.back_picture;
  const int max_texture_px = same_back ? options.max_texture_px : halfOf(options.max_texture_px, box);
  if (pieces.empty()) {
    dress(image, silhouette.mask, drawn, options.thin_outline, max_texture_px, sheets.front());
  } else {
    for (std::size_t i = 0; i < sheets.size(); ++i)
      dressPiece(image, pieces[i], drawn, options.thin_outline,
                 shareOf(max_texture_px / 2, pieces[i].box, box), sheets[i]);
  }
  for (std::size_t i = 0; i < sheets.size() && !same_back; ++i) {
    // A picture of the back has all pieces in it.
    if (i > 0 && options.back_picture) break;
    InflateOptions of_piece = options;
    if (i > 0) of_piece.head.reset();
    const DrawingTexture& front = sheets[i].front;
    const int whole_px =
        pieces.empty()
            ? 0
            : static_cast<int>(std::max(box.width(), box.height()) * front.image.width / front.size_px.x()) +
                  2 * kTextureMargin;
    const WholeFigure around{image, silhouette.mask, front.corner_px, front.size_px.x() / front.image.width};
    sheets[i].back =
        backTexture(front, sheets[i].box, of_piece, whole_px, pieces.empty() ? nullptr : &around);
  }
  constexpr double kAsideRange = 0.03;
  const double long_px = std::max(box.width(), box.height());
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const BodyDepth body = depthOf(options.body, pieces, i);
    sheets[i].middle = asideOf(body, kAsideRange * long_px, sheets[i].planar);
    giveDepth(body, !same_back && !options.back_picture, long_px, sheets[i]);
  }
  layPieces(sheets, pieces, box);

  Eigen::Vector2d low = upright(sheets.front().planar.vertices.front()), high = low;
  for (const Sheet& sheet : sheets)
    for (const Eigen::Vector2d& p : sheet.planar.vertices)
      low = low.cwiseMin(upright(p)), high = high.cwiseMax(upright(p));
  mesh.model_from_image.scale.setConstant(options.length_m > 0 ? options.length_m / (high - low).maxCoeff()
                                                               : options.height_m / (high.y() - low.y()));
  // Turned back into the drawing; exactly what it was where nothing is turned.
  const Eigen::Vector2d soles(0.5 * (low.x() + high.x()), high.y());
  mesh.model_from_image.origin_px =
      options.turned_rad == 0 ? soles : Eigen::Vector2d(Eigen::Rotation2Dd(options.turned_rad) * soles);

  std::vector<const Image*> textures;
  for (const Sheet& sheet : sheets) textures.push_back(&sheet.front.image);
  for (const Sheet& sheet : sheets)
    if (sheet.back) textures.push_back(&sheet.back->image);
  JoinedTexture texture = joinTextures(textures);

  int vertices = 0, triangles = 0;
  for (const Sheet& sheet : sheets) {
    vertices += sheet.meshVertices();
    triangles += static_cast<int>(sheet.planar.triangles.size());
  }
  mesh.vertices.resize(vertices, 3);
  mesh.uv.resize(vertices, 2);
  if (!same_back) mesh.back_uv.resize(vertices, 2);
  if (!pieces.empty()) mesh.layer.resize(vertices);
  mesh.triangles.resize(2 * triangles, 3);
  mesh.first_back = same_back ? 0 : triangles;
  const double px_depth = options.thickness * mesh.model_from_image.scale.y();
  int first = 0, first_triangle = 0;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    // The front's inner vertices, the rim, the back's inner vertices.
    const Sheet& sheet = sheets[i];
    const int inner = sheet.inner(), size = sheet.size();
    const Sheet& backs = options.back_picture ? sheets.front() : sheet;
    const TexturePlace& front_place = texture.places[i];
    const TexturePlace& back_place =
        same_back ? front_place : texture.places[sheets.size() + (options.back_picture ? 0 : i)];
    for (int v = 0; v < sheet.meshVertices(); ++v) {
      const int drawn_vertex = v < size ? v : v - size;
      const Eigen::Vector2d& q = sheet.outline_band.drawn[drawn_vertex];
      const Eigen::Vector2d p = mesh.model_from_image(sheet.place[drawn_vertex]);
      const double z = drawn_vertex >= inner ? sheet.lip[static_cast<std::size_t>(drawn_vertex - inner)]
                       : v < size            ? sheet.z.front[drawn_vertex]
                                             : -sheet.z.back[drawn_vertex];
      mesh.vertices.row(first + v) << p.cast<float>().transpose(),
          static_cast<float>((z + sheet.offset[drawn_vertex]) * px_depth);
      mesh.uv.row(first + v) = sheet.front.uvFromImage(q).cast<float>();
      if (!same_back) mesh.back_uv.row(first + v) = backs.front.uvFromImage(q).cast<float>();
      if (!pieces.empty()) mesh.layer[first + v] = pieces[i].layer;
    }
    // Only now to the joined texture, so that compilers round to float before: one skin has the same bytes as
    // ever.
    for (int v = first; v < first + sheet.meshVertices(); ++v) {
      mesh.uv.row(v) = front_place(mesh.uv.row(v).transpose().cast<double>());
      if (same_back) continue;
      const Eigen::Vector2d uv = mesh.back_uv.row(v).transpose().cast<double>();
      mesh.back_uv.row(v) =
          back_place((backs.back->corner + uv.cwiseProduct(backs.back->size)).cwiseMax(0).cwiseMin(1));
    }
    const auto behind = [&](int v) { return first + (v < inner ? v + size : v); };
    for (const auto& [a, b, c] : sheet.planar.triangles) {
      mesh.triangles.row(first_triangle) << first + a, first + b, first + c;
      mesh.triangles.row(triangles + first_triangle) << behind(a), behind(c), behind(b);
      ++first_triangle;
    }
    first += sheet.meshVertices();
  }
  mesh.texture = std::move(texture.image);
  std::vector<OutlineSample> rim;
  for (const Sheet& sheet : sheets) rim.insert(rim.end(), sheet.rim.begin(), sheet.rim.end());
  mesh.ink = inkLine(image, rim, long_px, mesh.model_from_image.scale.y());
  return mesh;
}

}  // namespace skel
