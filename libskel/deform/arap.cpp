#include "libskel/deform/arap.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <complex>
#include <limits>
#include <optional>
#include <vector>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/segment.h"

namespace skel {
namespace {

// Points of the plane as complex numbers: turning and scaling is one multiplication.
using Complex = std::complex<double>;
using Eigen::Vector2d;

// Cotangents below this, of triangles that are nearly flat, would let edges pull themselves apart.
constexpr double kLeastCotangent = 0.05;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

MeshHandle handleAt(const Vector2d& p, const Eigen::MatrixX2d& v, const Eigen::MatrixX3i& triangles) {
  double nearest = std::numeric_limits<double>::infinity();
  MeshHandle handle{};
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    std::array<Vector2d, 3> c;
    for (int k = 0; k < 3; ++k) c[std::size_t(k)] = v.row(triangles(t, k));
    const double area = cross(c[1] - c[0], c[2] - c[0]);
    const auto sharesOf = [&](const Vector2d& q) {
      return std::array<double, 3>{cross(c[1] - q, c[2] - q) / area, cross(c[2] - q, c[0] - q) / area,
                                   cross(c[0] - q, c[1] - q) / area};
    };
    std::array<double, 3> shares = sharesOf(p);
    double distance = 0;
    if (*std::min_element(shares.begin(), shares.end()) < 0) {
      distance = std::numeric_limits<double>::infinity();
      Vector2d at;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector2d q = nearestOnSegment(p, c[k], c[(k + 1) % 3]);
        if ((q - p).norm() < distance) distance = (q - p).norm(), at = q;
      }
      shares = sharesOf(at);
    }
    if (distance < nearest) {
      nearest = distance;
      handle = {{triangles(t, 0), triangles(t, 1), triangles(t, 2)}, shares};
    }
    if (nearest == 0) break;
  }
  return handle;
}

}  // namespace

struct ArapMesh::Content {
  struct Edge {
    int from, to;
    double cotangent;  // of the angle that faces it
    Complex rest;
  };
  Eigen::Index vertex_count = 0;
  std::vector<std::array<Edge, 3>> triangles;
  std::vector<MeshHandle> handles;
  ArapOptions options;
  double handle_weight = 0;
  std::optional<Untangler> untangler;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complex>> free;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> rigid;
};

ArapMesh::ArapMesh(const Eigen::MatrixX2d& vertices, const Eigen::MatrixX3i& triangles,
                   const Eigen::MatrixX2d& handles, const ArapOptions& options) {
  if (triangles.rows() == 0) throw UsageError("a mesh without triangles cannot be deformed");
  if (!vertices.allFinite() || !handles.allFinite())
    throw UsageError("a vertex or a handle of the mesh is no number");
  std::vector<MeshHandle> held;
  for (Eigen::Index h = 0; h < handles.rows(); ++h)
    held.push_back(handleAt(handles.row(h), vertices, triangles));
  prepare(vertices, triangles, held, options);
}

ArapMesh::ArapMesh(const Eigen::MatrixX2d& vertices, const Eigen::MatrixX3i& triangles,
                   const std::vector<int>& handles, const ArapOptions& options) {
  if (triangles.rows() == 0) throw UsageError("a mesh without triangles cannot be deformed");
  if (!vertices.allFinite()) throw UsageError("a vertex of the mesh is no number");
  std::vector<MeshHandle> held;
  for (const int vertex : handles) held.push_back({{vertex, vertex, vertex}, {1, 0, 0}});
  prepare(vertices, triangles, held, options);
}

void ArapMesh::prepare(const Eigen::MatrixX2d& vertices, const Eigen::MatrixX3i& triangles,
                       const std::vector<MeshHandle>& handles, const ArapOptions& options) {
  SKEL_CHECK(options.iterations >= 1);
  if (std::all_of(handles.begin(), handles.end(), [&](const MeshHandle& handle) {
        return handle.of(vertices) == handles.front().of(vertices);
      }))
    throw UsageError("a mesh is deformed by at least two handles at different places");
  auto content = std::make_unique<Content>();
  Content& c = *content;
  c.vertex_count = vertices.rows();
  c.options = options;

  std::vector<Eigen::Triplet<Complex>> free;
  std::vector<Eigen::Triplet<double>> rigid;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    std::array<Vector2d, 3> p;
    for (int k = 0; k < 3; ++k) p[std::size_t(k)] = vertices.row(triangles(t, k));
    const double twice_area = cross(p[1] - p[0], p[2] - p[0]);
    if (!(std::abs(twice_area) > 0)) throw UsageError("triangle " + std::to_string(t) + " has no area");
    std::array<Content::Edge, 3> edges;
    std::array<Complex, 3> facing;  // the edge that faces a corner
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      const double cotangent = (p[a] - p[k]).dot(p[b] - p[k]) / std::abs(twice_area);
      const Vector2d along = p[b] - p[a];
      facing[k] = {along.x(), along.y()};
      edges[k] = {triangles(t, Eigen::Index(a)), triangles(t, Eigen::Index(b)),
                  std::max(cotangent, kLeastCotangent), facing[k]};
    }
    c.triangles.push_back(edges);
    // Of how far the triangle is from being turned and scaled alone: the square of a sum over its corners
    // (least squares conformal maps, Lévy et al. 2002, equation 3, with the rest pose as the plane).
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        free.emplace_back(triangles(t, i), triangles(t, k),
                          std::conj(facing[std::size_t(i)]) * facing[std::size_t(k)] / std::abs(twice_area));
    for (const Content::Edge& e : edges) {
      rigid.emplace_back(e.from, e.from, e.cotangent);
      rigid.emplace_back(e.to, e.to, e.cotangent);
      rigid.emplace_back(e.from, e.to, -e.cotangent);
      rigid.emplace_back(e.to, e.from, -e.cotangent);
    }
  }
  c.handle_weight = options.handle_weight;
  c.handles = handles;
  for (const MeshHandle& handle : handles) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const double w = c.handle_weight * handle.shares[i] * handle.shares[k];
        free.emplace_back(handle.vertices[i], handle.vertices[k], w);
        rigid.emplace_back(handle.vertices[i], handle.vertices[k], w);
      }
  }
  Eigen::SparseMatrix<Complex> free_matrix(c.vertex_count, c.vertex_count);
  free_matrix.setFromTriplets(free.begin(), free.end());
  c.free.compute(free_matrix);
  Eigen::SparseMatrix<double> rigid_matrix(c.vertex_count, c.vertex_count);
  rigid_matrix.setFromTriplets(rigid.begin(), rigid.end());
  c.rigid.compute(rigid_matrix);
  if (c.free.info() != Eigen::Success || c.rigid.info() != Eigen::Success)
    throw UsageError("the mesh cannot be deformed: it is in several parts, of which some have no handle");
  c.untangler.emplace(vertices, triangles, c.handles);
  content_ = std::move(content);
}

ArapMesh::~ArapMesh() = default;
ArapMesh::ArapMesh(ArapMesh&&) noexcept = default;

Eigen::MatrixX2d ArapMesh::deform(const Eigen::MatrixX2d& targets) const {
  const Content& c = *content_;
  SKEL_CHECK_EQ(targets.rows(), Eigen::Index(c.handles.size()));
  SKEL_CHECK(targets.allFinite());
  Eigen::VectorXcd pull = Eigen::VectorXcd::Zero(c.vertex_count);
  for (std::size_t h = 0; h < c.handles.size(); ++h)
    for (std::size_t k = 0; k < 3; ++k)
      pull(c.handles[h].vertices[k]) += c.handle_weight * c.handles[h].shares[k] *
                                        Complex(targets(Eigen::Index(h), 0), targets(Eigen::Index(h), 1));

  Eigen::VectorXcd z = c.free.solve(pull);
  Eigen::MatrixX2d posed(c.vertex_count, 2);
  for (int i = 0; i < c.options.iterations; ++i) {
    Eigen::VectorXcd right = pull;
    for (const auto& edges : c.triangles) {
      Complex turn = 0;
      for (const Content::Edge& e : edges) turn += e.cotangent * std::conj(e.rest) * (z(e.to) - z(e.from));
      const double length = std::abs(turn);
      turn = length > 1e-300 ? turn / length : Complex(1);
      for (const Content::Edge& e : edges) {
        const Complex wanted = e.cotangent * turn * e.rest;
        right(e.to) += wanted;
        right(e.from) -= wanted;
      }
    }
    posed.col(0) = right.real();
    posed.col(1) = right.imag();
    posed = c.rigid.solve(posed).eval();
    z.real() = posed.col(0);
    z.imag() = posed.col(1);
  }
  c.untangler->untangle(posed, targets);
  return posed;
}

Eigen::MatrixX2d ArapMesh::handlesOf(const Eigen::MatrixX2d& vertices) const {
  SKEL_CHECK_EQ(vertices.rows(), content_->vertex_count);
  Eigen::MatrixX2d places(Eigen::Index(content_->handles.size()), 2);
  for (std::size_t h = 0; h < content_->handles.size(); ++h)
    places.row(Eigen::Index(h)) = content_->handles[h].of(vertices).transpose();
  return places;
}

int flippedTriangles(const Eigen::MatrixX2d& rest, const Eigen::MatrixX2d& posed,
                     const Eigen::MatrixX3i& triangles) {
  int count = 0;
  const auto area = [&](const Eigen::MatrixX2d& v, Eigen::Index t) {
    const Vector2d a = v.row(triangles(t, 0)), b = v.row(triangles(t, 1)), c = v.row(triangles(t, 2));
    return cross(b - a, c - a);
  };
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) count += area(rest, t) * area(posed, t) <= 0;
  return count;
}

}  // namespace skel
