#include "animator/rig_source.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/core/text.h"
#include "libskel/mesh/read_mesh.h"
#include "libskel/skeleton/place_in_mesh.h"
#include "libskel/skeleton/rig_file.h"
#include "libskel/skeleton/skeleton_file.h"
#include "libskel/skin/skin_weights.h"

namespace skel {
namespace {

constexpr double kMostOutside = .5;  // of the bones, that lie in the model

std::string percent(double share) {
  return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
}

bool isGlb(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".glb" || ending == ".GLB";
}

// Distances are squared in floats.
void checkSize(const TriangleMesh& mesh, const std::string& path) {
  const Eigen::RowVector3f size = mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff();
  if (!(size.maxCoeff() >= 1e-6f)) throw InputError(path, "is smaller than 1e-6; scale it to metres");
}

struct Extent {
  Eigen::Vector3d low, high;
  double longest() const { return (high - low).maxCoeff(); }
};

Extent extentOf(const TriangleMesh& mesh) {
  return {mesh.vertices.colwise().minCoeff().transpose().cast<double>(),
          mesh.vertices.colwise().maxCoeff().transpose().cast<double>()};
}

Extent extentOf(const Skeleton& skeleton) {
  Extent extent{skeleton.joints[0].position, skeleton.joints[0].position};
  const auto take = [&](const Eigen::Vector3d& point) {
    extent.low = extent.low.cwiseMin(point), extent.high = extent.high.cwiseMax(point);
  };
  for (const Joint& joint : skeleton.joints) {
    take(joint.position);
    if (joint.tail) take(*joint.tail);
  }
  return extent;
}

std::string lengthText(double length) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.3g", length);
  return text.data();
}

// Of a skeleton none of whose bones lies in the mesh: refused if it lies elsewhere, or has other units.
void checkOverlap(const Skeleton& skeleton, const TriangleMesh& mesh, const std::string& path) {
  constexpr double kOtherUnits = 5;
  const Extent bones = extentOf(skeleton), model = extentOf(mesh);
  const double ratio = bones.longest() > 0 ? model.longest() / bones.longest() : 1;
  const bool apart =
      (bones.low.array() > model.high.array()).any() || (bones.high.array() < model.low.array()).any();
  const bool other_units = ratio > kOtherUnits || ratio < 1 / kOtherUnits;
  if (!apart && !other_units) return;
  throw InputError(
      path, "does not overlap with the model: the skeleton's longest side is " + lengthText(bones.longest()) +
                ", the model's " + lengthText(model.longest()) +
                (other_units ? "; other units? Scale one of them by " + lengthText(std::max(ratio, 1 / ratio))
                             : "; move one of them to the other"));
}

}  // namespace

void bindRigSource(CLI::App& app, RigSource& source) {
  app.add_option("model", source.model, "The model: .obj, or a rigged .glb")->required()->type_name("MODEL");
  app.add_option("--skeleton", source.skeleton,
                 "Its skeleton: JSON with head and tail of each bone, or a .skeleton.json")
      ->type_name("FILE");
  app.add_option("--up", source.up,
                 "The axis that points up in the skeleton's file; auto: as it lies in the model")
      ->check(CLI::IsMember({"auto", "y", "z"}))
      ->capture_default_str();
}

std::string stemOf(const std::string& path) { return std::filesystem::path(path).stem().string(); }

Skeleton readSkeletonFor(const TriangleMesh& mesh, const std::string& path, const std::string& up,
                         std::string* note, std::string* warning) {
  const auto warn = [&](double inside) {
    if (warning && inside < kMostOutside)
      *warning = printable(path) + ": note: only " + percent(inside) +
                 " of its bones lie in the model: is it this model's, at its place and in its units?";
  };
  if (isSkelFile(path)) {
    const std::string text = readFile(path);
    Skeleton skeleton = parseSkeletonFile(text, path, loadTemplate(templateOfSkeleton(text, path))).skeleton;
    const double inside = shareInside(skeleton, mesh);
    if (inside == 0) checkOverlap(skeleton, mesh, path);
    if (note) *note = printable(path) + ": " + percent(inside) + " of its bones lie in the model";
    warn(inside);
    return skeleton;
  }
  std::string unused;
  const Skeleton as_is = readRigFile(path, &unused), turned = yUpFromZUp(as_is);
  checkBindable(mesh, as_is.joints.size(), path);
  const double y = shareInside(as_is, mesh), z = shareInside(turned, mesh);
  const bool z_up = up == "z" || (up == "auto" && z > y);
  if (y == 0 && z == 0) checkOverlap(z_up ? turned : as_is, mesh, path);
  if (note)
    *note = printable(path) + ": " + (z_up ? "z" : "y") + " is up" + (up == "auto" ? "" : " (--up)") + "; " +
            percent(z_up ? z : y) + " of its bones lie in the model, " + percent(z_up ? y : z) + " with " +
            (z_up ? "y" : "z") + " up" + (unused.empty() ? "" : "\n" + printable(unused));
  warn(z_up ? z : y);
  return z_up ? turned : as_is;
}

RigModel readRigModel(const RigSource& source) {
  RigModel result;
  if (isGlb(source.model)) {
    result.file = readGlb(source.model);
    if (source.skeleton.empty()) return result;
    result.file.clips.clear();
    result.file.character.weights = SkinWeights();
  } else {
    result.file.character.mesh = readMesh(source.model);
    result.file.name = stemOf(source.model);
    if (source.skeleton.empty())
      throw UsageError(source.model + " has no skeleton of its own; name one by --skeleton FILE");
  }
  checkSize(result.file.character.mesh, source.model);
  result.file.character.skeleton =
      readSkeletonFor(result.file.character.mesh, source.skeleton, source.up, &result.note, &result.warning);
  return result;
}

}  // namespace skel
