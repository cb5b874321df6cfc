#include "libskel/deform/untangle.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace skel {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::MatrixX2d;

constexpr int kRings = 2;   // of triangles around what is turned over that move with it, at first
constexpr int kSteps = 15;  // before twice as many rings
constexpr double kLeastEpsilon = 1e-3, kShrink = 0.2;
// Of a handle, beside the area of triangles: at first, and as a share of that whenever the patch grows.
constexpr double kHold = 10, kLoosen = 0.3;
constexpr double kLeastStep = 1e-4;

double chi(double det, double epsilon) { return (det + std::hypot(epsilon, det)) / 2; }

}  // namespace

// Some vertices that move between others that stay.
class Untangler::Patch {
 public:
  Patch(const Untangler& mesh, const std::vector<char>& moves, const MatrixX2d& targets, double hold)
      : targets_(targets), hold_(hold), unknown_(moves.size(), -1) {
    for (std::size_t v = 0; v < moves.size(); ++v)
      if (moves[v]) {
        unknown_[v] = int(vertices_.size());
        vertices_.push_back(int(v));
      }
    const auto any = [&](const auto& corners) {
      return std::any_of(corners.begin(), corners.end(), [&](int v) { return moves[std::size_t(v)]; });
    };
    for (const Triangle& t : mesh.triangles_)
      if (any(t.corners)) triangles_.push_back(&t);
    for (std::size_t h = 0; h < mesh.handles_.size(); ++h)
      if (any(mesh.handles_[h].vertices)) handles_.push_back({&mesh.handles_[h], Index(h)});
  }

  // One step of Newton's method. False if none leads downwards.
  bool step(double epsilon, MatrixX2d& posed) {
    const Index n = 2 * Index(vertices_.size());
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(n);
    entries_.clear();
    double before = 0;
    for (const Triangle* t : triangles_) before += expand(*t, epsilon, posed, slope);
    for (const Held& h : handles_) before += expand(h, posed, slope);
    Eigen::SparseMatrix<double> bend(n, n);
    bend.setFromTriplets(entries_.begin(), entries_.end());
    if (!analysed_) solver_.analyzePattern(bend);
    analysed_ = true;
    solver_.factorize(bend);
    if (solver_.info() != Eigen::Success) return false;
    const Eigen::VectorXd way = -solver_.solve(slope);
    const double downwards = way.dot(slope);
    const MatrixX2d from = posed;
    for (double share = 1; share > kLeastStep; share /= 2) {
      for (std::size_t i = 0; i < vertices_.size(); ++i)
        posed.row(vertices_[i]) = from.row(vertices_[i]) + share * way.segment<2>(2 * Index(i)).transpose();
      if (energy(epsilon, posed) <= before + 0.1 * share * downwards) return true;
    }
    posed = from;
    return false;
  }

 private:
  struct Held {
    const MeshHandle* handle;
    Index target;
  };

  double energy(double epsilon, const MatrixX2d& posed) const {
    double sum = 0;
    for (const Triangle* t : triangles_) {
      const Matrix2d j = jacobian(*t, posed);
      const double det = j.determinant();
      sum += t->area * (j.squaredNorm() + det * det + 1) / chi(det, epsilon);
    }
    for (const Held& h : handles_) sum += hold_ * off(h, posed).squaredNorm();
    return sum;
  }

  Eigen::Vector2d off(const Held& held, const MatrixX2d& posed) const {
    return held.handle->of(posed) - targets_.row(held.target).transpose();
  }

  double expand(const Held& held, const MatrixX2d& posed, Eigen::VectorXd& slope) {
    const Eigen::Vector2d way = off(held, posed);
    const MeshHandle& handle = *held.handle;
    for (std::size_t a = 0; a < 3; ++a) {
      const int row = unknown_[std::size_t(handle.vertices[a])];
      if (row < 0) continue;
      slope.segment<2>(2 * row) += 2 * hold_ * handle.shares[a] * way;
      for (std::size_t b = 0; b < 3; ++b) {
        const int column = unknown_[std::size_t(handle.vertices[b])];
        if (column < 0) continue;
        for (int r = 0; r < 2; ++r)
          entries_.emplace_back(2 * row + r, 2 * column + r, 2 * hold_ * handle.shares[a] * handle.shares[b]);
      }
    }
    return hold_ * way.squaredNorm();
  }

  // The triangle's energy; adds its slope and its bend, in which χ counts as a line, so that it is convex in
  // J and det J: (2/χ)(|dJ − J q d|² + ((1 − det q)² + q²) d²) with q = χ'/χ and d the change of det J.
  double expand(const Triangle& t, double epsilon, const MatrixX2d& posed, Eigen::VectorXd& slope) {
    const Matrix2d j = jacobian(t, posed);
    const double det = j.determinant(), x = chi(det, epsilon), q = 1 / std::hypot(epsilon, det);
    const double value = t.area * (j.squaredNorm() + det * det + 1) / x;
    Matrix2d cofactors;
    cofactors << j(1, 1), -j(1, 0), -j(0, 1), j(0, 0);
    // Where corner a goes by p, J changes by p g_aᵀ and det J by p · n_a.
    const Eigen::Matrix<double, 2, 3> n = cofactors * t.gradients, along = j * t.gradients;
    const Eigen::Matrix3d inner = t.gradients.transpose() * t.gradients;
    const double stretch = q * q * j.squaredNorm() + (1 - det * q) * (1 - det * q) + q * q;
    const double scale = 2 * t.area / x;
    for (int a = 0; a < 3; ++a) {
      const int row = unknown_[std::size_t(t.corners(a))];
      if (row < 0) continue;
      slope.segment<2>(2 * row) += scale * (along.col(a) + det * n.col(a)) - value * q * n.col(a);
      for (int b = 0; b < 3; ++b) {
        const int column = unknown_[std::size_t(t.corners(b))];
        if (column < 0) continue;
        const Matrix2d block =
            scale * (inner(a, b) * Matrix2d::Identity() -
                     q * (along.col(a) * n.col(b).transpose() + n.col(a) * along.col(b).transpose()) +
                     stretch * n.col(a) * n.col(b).transpose());
        for (int r = 0; r < 2; ++r)
          for (int c = 0; c < 2; ++c) entries_.emplace_back(2 * row + r, 2 * column + c, block(r, c));
      }
    }
    return value;
  }

  const MatrixX2d& targets_;
  const double hold_;
  std::vector<Held> handles_;
  std::vector<int> unknown_;   // of each vertex of the mesh, or -1
  std::vector<int> vertices_;  // that move
  std::vector<const Triangle*> triangles_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  bool analysed_ = false;
};

Untangler::Untangler(const MatrixX2d& rest, const Eigen::MatrixX3i& triangles,
                     const std::vector<MeshHandle>& handles)
    : vertex_count_(rest.rows()), handles_(handles) {
  for (Index t = 0; t < triangles.rows(); ++t) {
    Matrix2d edges;
    edges << (rest.row(triangles(t, 1)) - rest.row(triangles(t, 0))).transpose(),
        (rest.row(triangles(t, 2)) - rest.row(triangles(t, 0))).transpose();
    const Matrix2d inverse = edges.inverse();
    Triangle triangle{triangles.row(t), std::abs(edges.determinant()) / 2, {}};
    triangle.gradients << -(inverse.row(0) + inverse.row(1)).transpose(), inverse.row(0).transpose(),
        inverse.row(1).transpose();
    triangles_.push_back(triangle);
  }
}

Matrix2d Untangler::jacobian(const Triangle& triangle, const MatrixX2d& posed) {
  Matrix2d j = Matrix2d::Zero();
  for (int k = 0; k < 3; ++k)
    j += posed.row(triangle.corners(k)).transpose() * triangle.gradients.col(k).transpose();
  return j;
}

Eigen::VectorXd Untangler::areaShares(const MatrixX2d& posed) const {
  Eigen::VectorXd shares(Index(triangles_.size()));
  for (Index t = 0; t < shares.size(); ++t)
    shares(t) = jacobian(triangles_[std::size_t(t)], posed).determinant();
  return shares;
}

void Untangler::untangle(MatrixX2d& posed, const MatrixX2d& targets) const {
  Eigen::VectorXd shares = areaShares(posed);
  double hold = kHold;
  for (int rings = kRings; shares.minCoeff() < kLeastAreaShare; rings *= 2, hold *= kLoosen) {
    std::vector<char> moves(std::size_t(vertex_count_), 0);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (shares(Index(t)) < kLeastAreaShare)
        for (const int v : triangles_[t].corners) moves[std::size_t(v)] = 1;
    for (int ring = 1; ring < rings; ++ring) {
      std::vector<char> wider = moves;
      for (const Triangle& t : triangles_)
        if (std::any_of(t.corners.begin(), t.corners.end(), [&](int v) { return moves[std::size_t(v)]; }))
          for (const int v : t.corners) wider[std::size_t(v)] = 1;
      moves = std::move(wider);
    }
    Patch patch(*this, moves, targets, hold);
    for (int step = 0; step < kSteps && shares.minCoeff() < kLeastAreaShare; ++step) {
      const double epsilon = std::hypot(kLeastEpsilon, kShrink * std::min(0., shares.minCoeff()));
      if (!patch.step(epsilon, posed)) break;
      shares = areaShares(posed);
    }
    if (std::all_of(moves.begin(), moves.end(), [](char m) { return m != 0; })) return;
  }
}

}  // namespace skel
