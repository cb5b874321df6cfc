// Pictures of a model, made in software: for traces, previews and the README.
#pragma once

#include <optional>

#include "libskel/image/image.h"
#include "libskel/mesh/triangle_mesh.h"

namespace skel {

struct Camera {
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  // model frame; in the middle of the picture
  double yaw_rad = 0;                                // 0: from the front (+z); positive: from +x
  double pitch_rad = 0;                              // positive: from above
  double view_height_m = 2;  // what the picture's height shows at the target's distance
  double distance_m = 8;     // from the eye to the target
};

// Where points of the model are seen, px; a point behind the eye gives nothing.
class Projection {
 public:
  Projection(const Camera& camera, int width, int height);
  std::optional<Eigen::Vector2d> operator()(const Eigen::Vector3d& model) const;
  // How many px a metre is at that point.
  double pxPerMetre(const Eigen::Vector3d& model) const;

 private:
  Eigen::Matrix3d eye_;
  Camera camera_;
  double scale_;
  Eigen::Vector2d middle_;
};

struct RenderOptions {
  int width = 512, height = 512;
  int samples = 2;                              // each way, a pixel
  Eigen::Vector3f plain_rgb = {205, 205, 210};  // 0…255, where the mesh has no texture
  float shading = 0.45f;                        // 0: the texture's colours as they are; 1: black in the shade
  bool ink = true;                              // with the line around it that is drawn in front
};

// A rotation to the eye's axes: x right, y up, z towards the eye.
Eigen::Matrix3d eyeFromModel(const Camera& camera);

// Model frame.
Eigen::Vector3d eyeOf(const Camera& camera);

// Shows all of the points, whatever the size of the picture.
Camera framingCamera(const Eigen::MatrixX3f& vertices, double yaw_rad = 0, double pitch_rad = 0,
                     double width_over_height = 1);

// `vertices`: those of the mesh, or as many in another pose. The background is clear.
Image renderMesh(const Eigen::MatrixX3f& vertices, const TriangleMesh& mesh, const Camera& camera,
                 const RenderOptions& options = {});

}  // namespace skel
