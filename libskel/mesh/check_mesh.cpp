#include "libskel/mesh/check_mesh.h"

#include "libskel/core/error.h"
#include "libskel/image/check_image.h"

namespace skel {

void checkMesh(const TriangleMesh& mesh, const std::string& name) {
  const Eigen::Index vertices = mesh.vertices.rows(), triangles = mesh.triangles.rows();
  const auto refuse = [&](const std::string& why) { throw UsageError(name + why); };
  if (vertices == 0 || triangles == 0) refuse(" is empty: it has no vertices or no triangles");
  if (!mesh.vertices.allFinite()) refuse(".vertices holds a number that is not finite");
  if (!(mesh.vertices.cwiseAbs().maxCoeff() <= float(kFarthest)))
    refuse(".vertices holds a vertex farther than 1e6 from the origin");
  if (mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= vertices)
    refuse(".triangles names a vertex that there is not, of " + std::to_string(vertices));
  const auto checkRows = [&](const char* member, Eigen::Index rows) {
    if (rows != 0 && rows != vertices)
      refuse(std::string(member) + " has " + std::to_string(rows) + " rows for " + std::to_string(vertices) +
             " vertices");
  };
  checkRows(".uv", mesh.uv.rows());
  checkRows(".back_uv", mesh.back_uv.rows());
  checkRows(".layer", mesh.layer.rows());
  checkRows(".file_vertex", mesh.file_vertex.rows());
  if (!mesh.uv.allFinite() || !mesh.back_uv.allFinite()) refuse(".uv holds a number that is not finite");
  if (mesh.first_back < 0 || mesh.first_back > triangles)
    refuse(".first_back is none of " + std::to_string(triangles) + " triangles");
  if (!(mesh.ink.width_m >= 0 && mesh.ink.width_m <= float(kFarthest)))
    refuse(".ink.width_m must be a finite number of 0 or more");
  if (!(mesh.ink.rgb.minCoeff() >= 0 && mesh.ink.rgb.maxCoeff() <= 255))
    refuse(".ink.rgb must be from 0 to 255");
  checkImage(mesh.texture, name + ".texture");
}

}  // namespace skel
