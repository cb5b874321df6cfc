// Figures of the built-in clips on drawings: how far the skin is stretched, how much of the limbs goes
// into the rest of the body, and for how many drawings a clip shows nothing.
//   clip_quality [--one-skin] [--stretch-only] TEMPLATE DRAWING...
// A line a clip, then the ten drawings that stretch most, each with its worst clip and where in it. Stretch:
// see libskel/deform/stretch.h. Inside: the winding
// number of the skin just above a limb's surface is 1 more than at rest. Nothing shown: in the picture no
// hand, by what lies where it was drawn, goes a tenth of the figure's height, and less than a twentieth of
// its area .15 of it. Feet stay: in the picture one of the two, by what lies where it was drawn, goes less
// than .08 of the height, of clips that lift feet.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "libskel/animation/clip_library.h"
#include "libskel/core/error.h"
#include "libskel/core/parallel.h"
#include "libskel/deform/bound_stretch.h"
#include "libskel/deform/stretch.h"
#include "tests/support/clips_on_drawings.h"

namespace skel {
namespace {

using Eigen::Vector3d;

constexpr int kFrames = 8;
constexpr int kMoments = 11;
constexpr int kLimbPoints = 150;
constexpr double kFeet = 0.08;
constexpr double kAbove_m = 0.003 * kModelHeight_m;

Vector3d corner(const Eigen::MatrixX3f& vertices, const TriangleMesh& mesh, Eigen::Index t, int k) {
  return vertices.row(mesh.triangles(t, k)).transpose().cast<double>();
}

// Van Oosterom & Strackee, "The solid angle of a plane triangle" (1983).
double windingNumber(const Eigen::MatrixX3f& vertices, const TriangleMesh& mesh, const Vector3d& point) {
  double sum = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Vector3d a = corner(vertices, mesh, t, 0) - point, b = corner(vertices, mesh, t, 1) - point,
                   c = corner(vertices, mesh, t, 2) - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

// Triangles of the lower halves of arms and legs, evenly taken.
std::vector<Eigen::Index> limbTriangles(const RiggedCharacter& character) {
  std::vector<Eigen::Index> limbs, some;
  const TriangleMesh& mesh = character.mesh;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const std::string& joint =
        character.skeleton.joints[character.weights.joints(mesh.triangles(t, 0), 0)].name;
    if (joint.ends_with("elbow") || joint.ends_with("hand") || joint.ends_with("knee") ||
        joint.ends_with("foot"))
      limbs.push_back(t);
  }
  const std::size_t step = std::max<std::size_t>(1, limbs.size() / kLimbPoints);
  for (std::size_t i = 0; i < limbs.size(); i += step) some.push_back(limbs[i]);
  return some;
}

std::vector<bool> insideOthers(const Eigen::MatrixX3f& vertices, const TriangleMesh& mesh,
                               const std::vector<Eigen::Index>& triangles) {
  std::vector<bool> inside;
  for (const Eigen::Index t : triangles) {
    const Vector3d a = corner(vertices, mesh, t, 0), b = corner(vertices, mesh, t, 1),
                   c = corner(vertices, mesh, t, 2);
    const Vector3d above = (a + b + c) / 3 + kAbove_m * (b - a).cross(c - a).normalized();
    inside.push_back(windingNumber(vertices, mesh, above) > 0.5);
  }
  return inside;
}

// How far each vertex goes in the picture, in heights.
Eigen::VectorXf waysInPicture(const RiggedCharacter& character, const Clip& clip) {
  constexpr int kTimes = 24;
  Eigen::MatrixX2f low = posedVertices(character, clip, 0).leftCols<2>(), high = low;
  for (int k = 1; k < kTimes; ++k) {
    const Eigen::MatrixX3f posed = posedVertices(character, clip, clip.duration_s() * float(k) / kTimes);
    low = low.cwiseMin(posed.leftCols<2>()), high = high.cwiseMax(posed.leftCols<2>());
  }
  return (high - low).rowwise().norm() / heightOf(character.mesh);
}

// One a vertex: a third of the triangles about it, in the picture.
Eigen::VectorXf areasInPicture(const TriangleMesh& mesh) {
  Eigen::VectorXf areas = Eigen::VectorXf::Zero(mesh.vertices.rows());
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Vector3d a = corner(mesh.vertices, mesh, t, 0), b = corner(mesh.vertices, mesh, t, 1),
                   c = corner(mesh.vertices, mesh, t, 2);
    for (int k = 0; k < 3; ++k) areas[mesh.triangles(t, k)] += float(std::abs((b - a).cross(c - a).z()) / 6);
  }
  return areas;
}

// The mean of the ways of what lies where the joint was drawn; nothing: nothing lies there.
std::optional<double> wayAt(const Joint& joint, const TriangleMesh& mesh, const Eigen::VectorXf& ways,
                            const Eigen::VectorXf& areas) {
  constexpr float kReach = 0.05f;
  const Eigen::RowVector2f at = joint.position.head<2>().cast<float>().transpose();
  const Eigen::ArrayXf there =
      ((mesh.vertices.leftCols<2>().rowwise() - at).rowwise().norm().array() < kReach * heightOf(mesh))
          .select(areas.array(), 0);
  if (!(there.sum() > 0)) return std::nullopt;
  return double((there * ways.array()).sum() / there.sum());
}

struct Shown {
  bool nothing = true;
  double feet = 1;  // how far the foot goes that goes least
};

Shown shown(const RiggedCharacter& character, const Clip& clip) {
  constexpr float kMost = 0.15f, kOfArea = 0.05f;
  constexpr double kHand = 0.1;
  const TriangleMesh& mesh = character.mesh;
  const Eigen::VectorXf ways = waysInPicture(character, clip), areas = areasInPicture(mesh);
  Shown result;
  result.nothing = (ways.array() > kMost).select(areas, 0).sum() <= kOfArea * areas.sum();
  for (const Joint& joint : character.skeleton.joints) {
    const double way = wayAt(joint, mesh, ways, areas).value_or(0);
    if (joint.name.ends_with("hand") && way > kHand) result.nothing = false;
    if (joint.name.ends_with("foot")) result.feet = std::min(result.feet, way);
  }
  return result;
}

bool liftsFeet(const std::string& clip) {
  for (const Clip& made : builtinClips())
    if (made.name == clip)
      for (const FootContact& contact : made.contacts)
        if (contact.to_s - contact.from_s < made.duration_s() - 1e-3f) return true;
  return false;
}

struct Quality {
  double stretched = 0, inside = 0;  // shares, means over the frames
  double most_stretched = 0;         // of a frame
  float at_s = 0;                    // when
  Shown shown;
};

struct Measured {
  std::map<std::string, Quality> clips;
  int beyond = 0;  // triangles that some moment stretches above kMostStretch
  bool layered = false;
};

struct Request {
  bool layers = true, inside = true;
  std::string body_plan;
};

Measured measure(const std::string& path, const Request& request) {
  const RiggedDrawing drawing = rigWithClips(
      path, request.body_plan, clipsFor(builtinClips(), loadTemplate(request.body_plan)), request.layers);
  if (!drawing.found()) throw InputError(path, drawing.silhouette.reason);
  const RiggedCharacter& character = drawing.character;
  const TriangleMesh& mesh = character.mesh;
  const std::vector<RestTriangle> rest = restTriangles(mesh);
  double area = 0;
  for (const RestTriangle& t : rest) area += t.area;
  const std::vector<Eigen::Index> limbs =
      request.inside ? limbTriangles(character) : std::vector<Eigen::Index>();
  const std::vector<bool> inside_at_rest = insideOthers(mesh.vertices, mesh, limbs);
  Measured result;
  result.layered = mesh.layer.size() > 0;
  for (const Clip& clip : drawing.clips) {
    Quality& quality = result.clips[clip.name];
    quality.shown = shown(character, clip);
    for (int frame = 0; frame < kFrames; ++frame) {
      const float time_s = clip.duration_s() * (float(frame) + 0.5f) / kFrames;
      const Eigen::MatrixX3f posed = posedVertices(character, clip, time_s);
      double stretched = 0;
      for (const RestTriangle& t : rest)
        if (stretchOf(t, mesh, posed) > kFarStretch) stretched += t.area / area;
      quality.stretched += stretched / kFrames;
      if (stretched > quality.most_stretched) quality.most_stretched = stretched, quality.at_s = time_s;
      const std::vector<bool> inside = insideOthers(posed, mesh, limbs);
      for (std::size_t i = 0; i < limbs.size(); ++i)
        if (inside[i] && !inside_at_rest[i]) quality.inside += 1. / double(limbs.size()) / kFrames;
    }
  }
  std::vector<char> beyond(rest.size(), 0);
  for (const Clip& clip : drawing.clips)
    for (int moment = 0; moment < kMoments; ++moment) {
      const Eigen::MatrixX3f posed =
          posedVertices(character, clip, clip.duration_s() * float(moment) / kMoments);
      for (std::size_t t = 0; t < rest.size(); ++t)
        if (!beyond[t] && stretchOf(rest[t], mesh, posed) > kMostStretch) beyond[t] = 1;
    }
  result.beyond = int(std::count(beyond.begin(), beyond.end(), 1));
  return result;
}

struct Case {
  double share;
  std::string path, clip;
  float at_s;  // where most is stretched
};

void run(int argc, char** argv) {
  Request request;
  std::vector<std::string> paths(argv + 1, argv + argc);
  const auto flag = [&](const char* name) { return std::erase(paths, name) > 0; };
  request.layers = !flag("--one-skin");
  request.inside = !flag("--stretch-only");
  if (paths.size() < 2)
    throw UsageError("usage: clip_quality [--one-skin] [--stretch-only] TEMPLATE DRAWING...");
  request.body_plan = paths.front();
  paths.erase(paths.begin());
  std::vector<Measured> all(paths.size());
  parallelFor(paths.size(), 0, [&](std::size_t i) { all[i] = measure(paths[i], request); });
  std::map<std::string, std::vector<Quality>> by_clip;
  std::vector<Case> stretched, inside, still;
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (const auto& [clip, quality] : all[i].clips) {
      by_clip[clip].push_back(quality);
      stretched.push_back({quality.stretched, paths[i], clip, quality.at_s});
      inside.push_back({quality.inside, paths[i], clip, quality.at_s});
      if (clip == "walk") still.push_back({quality.shown.feet, paths[i], clip, 0});
    }
  std::printf("%d of %d drawings in layers\n",
              int(std::count_if(all.begin(), all.end(), [](const Measured& m) { return m.layered; })),
              int(all.size()));
  std::vector<int> beyond;
  for (const Measured& m : all) beyond.push_back(m.beyond);
  std::sort(beyond.begin(), beyond.end());
  const auto share = [&](int most) {
    return double(std::count_if(beyond.begin(), beyond.end(), [&](int n) { return n <= most; })) /
           double(beyond.size());
  };
  std::printf(
      "no triangle above %.1f in any clip: %.3f of the drawings; at most 5: %.3f, 20: %.3f, 100: %.3f\n",
      kMostStretch, share(0), share(5), share(20), share(100));
  std::printf(
      "clip       area stretched > 3: mean  worst     limbs inside others: mean  worst     nothing shown  "
      "feet: stay  median\n");
  for (const auto& [clip, qualities] : by_clip) {
    Quality mean, most;
    double nothing = 0, stay = 0;
    std::vector<double> feet;
    for (const Quality& q : qualities) {
      mean.stretched += q.stretched / double(qualities.size());
      mean.inside += q.inside / double(qualities.size());
      most.stretched = std::max(most.stretched, q.stretched);
      most.inside = std::max(most.inside, q.inside);
      nothing += q.shown.nothing / double(qualities.size());
      stay += (q.shown.feet < kFeet) / double(qualities.size());
      feet.push_back(q.shown.feet);
    }
    std::printf("%-10s %24.2f %% %6.2f %% %24.2f %% %6.2f %% %15.1f %%", clip.c_str(), 100 * mean.stretched,
                100 * most.stretched, 100 * mean.inside, 100 * most.inside, 100 * nothing);
    std::nth_element(feet.begin(), feet.begin() + std::ptrdiff_t(feet.size() / 2), feet.end());
    if (liftsFeet(clip)) std::printf(" %10.1f %% %7.3f", 100 * stay, feet[feet.size() / 2]);
    std::printf("\n");
  }
  const auto worst = [](const char* what, std::vector<Case>& list) {
    std::printf("%s most:\n", what);
    std::sort(list.begin(), list.end(), [](const Case& a, const Case& b) {
      return std::tie(b.share, a.path, a.clip) < std::tie(a.share, b.path, b.clip);
    });
    std::set<std::string> shown;
    for (const Case& c : list)
      if (shown.size() < 10 && c.share > 0 && shown.insert(c.path).second)
        std::printf("%6.2f %% %s %s at %.2f s\n", 100 * c.share, c.path.c_str(), c.clip.c_str(),
                    double(c.at_s));
  };
  worst("stretched", stretched);
  worst("inside", inside);
  std::printf("feet that walk less than %.2f:\n", kFeet);
  std::sort(still.begin(), still.end(), [](const Case& a, const Case& b) {
    return std::tie(a.share, a.path) < std::tie(b.share, b.path);
  });
  for (const Case& c : still)
    if (c.share < kFeet) std::printf("%6.3f %s\n", c.share, c.path.c_str());
}

}  // namespace
}  // namespace skel

int main(int argc, char** argv) {
  try {
    skel::run(argc, argv);
  } catch (const skel::Error& error) {
    std::fprintf(stderr, "clip_quality: %s\n", error.what());
    return int(error.exitCode());
  }
}
