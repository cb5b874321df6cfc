#include "labeler/figure.h"

#include <algorithm>
#include <limits>

#include "libskel/classifier/features.h"

namespace skel {
namespace {

std::shared_ptr<const Figure> figureOf(Silhouette silhouette, const Mlp& mlp) {
  auto figure = std::make_shared<Figure>();
  figure->silhouette = std::move(silhouette);
  if (!figure->silhouette.found()) return figure;
  figure->candidates = extractCandidates(figure->silhouette);
  const ClassProbabilities classes = classify(mlp, features(figure->candidates));
  for (Eigen::Index i = 0; i < classes.rows(); ++i) {
    const JointCandidate& candidate = figure->candidates.maxima[static_cast<size_t>(i)];
    figure->centers_px.push_back(figure->silhouette.grid.imageFromGrid({candidate.x, candidate.y}));
    Eigen::Index best = 0;
    figure->certainties.push_back(classes.row(i).maxCoeff(&best));
    figure->suggestions.push_back(static_cast<JointClass>(best));
  }
  return figure;
}

CandidateLabels carriedLabels(const std::vector<Eigen::Vector2d>& centers_px,
                              const std::vector<Eigen::Vector2d>& old_centers_px,
                              const std::vector<double>& old_radii_px, const CandidateLabels& old_labels) {
  CandidateLabels labels;
  for (const Eigen::Vector2d& center : centers_px) {
    auto& label = labels.emplace_back();
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < old_centers_px.size(); ++i) {
      const double distance = (old_centers_px[i] - center).norm();
      if (distance > old_radii_px[i] || distance >= nearest) continue;
      nearest = distance;
      label = old_labels[i];
    }
  }
  return labels;
}

bool isInside(const Eigen::Vector2d& p, const Polygon& polygon) {
  bool inside = false;
  for (size_t i = 0, k = polygon.size() - 1; i < polygon.size(); k = i++) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[k];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

}  // namespace

std::shared_ptr<const Figure> figureOf(const Image& image, const MaskVersion* mask, int number,
                                       const Mlp& mlp) {
  SilhouetteOptions options;
  options.figure = number;
  if (!mask) return figureOf(extractSilhouette(image, options), mlp);
  Silhouette silhouette = silhouetteFromMask(mask->pixels, image, options);
  if (!silhouette.found() && number > 1) silhouette = silhouetteFromMask(mask->pixels, image);
  return figureOf(std::move(silhouette), mlp);
}

CandidateLabels carriedLabels(const Figure& figure, const Figure& old_figure,
                              const CandidateLabels& old_labels) {
  std::vector<double> radii_px;
  for (const JointCandidate& candidate : old_figure.candidates.maxima)
    radii_px.push_back(candidate.radius / old_figure.silhouette.grid.scale);
  return carriedLabels(figure.centers_px, old_figure.centers_px, radii_px, old_labels);
}

CandidateLabels carriedLabels(const Figure& figure, const std::vector<JointCandidate>& old_candidates,
                              const CandidateLabels& old_labels) {
  const WorkingGrid& grid = figure.silhouette.grid;
  std::vector<Eigen::Vector2d> centers_px;
  std::vector<double> radii_px;
  for (const JointCandidate& candidate : old_candidates) {
    centers_px.push_back(grid.imageFromGrid({candidate.x, candidate.y}));
    radii_px.push_back(candidate.radius / grid.scale);
  }
  return carriedLabels(figure.centers_px, centers_px, radii_px, old_labels);
}

bool samePlaces(const std::vector<JointCandidate>& a, const std::vector<JointCandidate>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const JointCandidate& p, const JointCandidate& q) {
                      return p.x == q.x && p.y == q.y && p.radius == q.radius;
                    });
}

int countLabels(const CandidateLabels& labels) {
  return static_cast<int>(
      std::count_if(labels.begin(), labels.end(), [](const auto& label) { return label.has_value(); }));
}

int mostUnsure(const Figure& figure, const CandidateLabels& labels) {
  int best = -1;
  for (size_t i = 0; i < labels.size(); ++i)
    if (!labels[i] && (best < 0 || figure.certainties[i] < figure.certainties[static_cast<size_t>(best)]))
      best = static_cast<int>(i);
  return best;
}

int candidateAt(const Figure& figure, const Eigen::Vector2d& image_px, double radius_px) {
  const int centre = nearestPoint({figure.centers_px.begin(), figure.centers_px.end()}, image_px, radius_px);
  if (centre >= 0) return centre;
  int best = -1;
  double best_distance = std::numeric_limits<double>::infinity();
  for (const int index : figure.candidates.kept) {
    const auto i = static_cast<size_t>(index);
    const double distance = (figure.centers_px[i] - image_px).norm();
    const double disc_px = figure.candidates.maxima[i].radius / figure.silhouette.grid.scale;
    if (distance > disc_px || distance >= best_distance) continue;
    best = index;
    best_distance = distance;
  }
  return best;
}

std::vector<int> candidatesNear(const Figure& figure, const Eigen::Vector2d& image_px, double radius_px) {
  std::vector<int> found;
  for (size_t i = 0; i < figure.centers_px.size(); ++i)
    if ((figure.centers_px[i] - image_px).norm() <= radius_px) found.push_back(static_cast<int>(i));
  return found;
}

std::vector<int> candidatesInside(const Figure& figure, const Polygon& lasso) {
  std::vector<int> found;
  for (size_t i = 0; i < figure.centers_px.size(); ++i)
    if (isInside(figure.centers_px[i], lasso)) found.push_back(static_cast<int>(i));
  return found;
}

int nearestPoint(const std::vector<std::optional<Eigen::Vector2d>>& points, const Eigen::Vector2d& to,
                 double radius) {
  int best = -1;
  for (size_t i = 0; i < points.size(); ++i) {
    if (!points[i] || (*points[i] - to).norm() > radius) continue;
    best = static_cast<int>(i);
    radius = (*points[i] - to).norm();
  }
  return best;
}

}  // namespace skel
