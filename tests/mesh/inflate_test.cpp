#include "libskel/mesh/inflate.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "libskel/core/error.h"
#include "libskel/core/rng.h"
#include "libskel/image/read_image.h"
#include "tests/support/catch.h"
#include "tests/support/mesh_checks.h"

using namespace skel;

namespace {

Image paint(const Plane8& mask) {
  Image image(static_cast<int>(mask.cols()), static_cast<int>(mask.rows()));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t value = mask(y, x) ? 40 : 250;
      std::fill_n(image.pixel(x, y), 3, value);
      image.pixel(x, y)[3] = 255;
    }
  }
  return image;
}

TriangleMesh inflateMask(const Plane8& mask, const InflateOptions& options = {}) {
  const Silhouette silhouette = silhouetteFromMask(mask);
  INFO(silhouette.reason);
  REQUIRE(silhouette.found());
  return inflate(paint(mask), silhouette, options);
}

Plane8 disc(int size, double radius) {
  Plane8 mask = Plane8::Zero(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      if (std::hypot(x - 0.5 * (size - 1), y - 0.5 * (size - 1)) <= radius) mask(y, x) = 255;
    }
  }
  return mask;
}

}  // namespace

TEST_CASE("a disc becomes a body about as thick as wide, in the model's frame") {
  const TriangleMesh mesh = inflateMask(disc(301, 140));
  const MeshReport report = checkMesh(mesh);
  CHECK(report.problem == "");
  CHECK(report.parts == 1);
  CHECK(report.euler == 2);
  CHECK(mesh.vertices.rows() > 2000);
  CHECK(mesh.vertices.rows() < 5000);
  const Eigen::RowVector3f low = mesh.vertices.colwise().minCoeff(),
                           high = mesh.vertices.colwise().maxCoeff();
  CHECK(low.y() == Approx(0).margin(1e-6));
  CHECK(high.y() == Approx(kModelHeight_m));
  CHECK(high.x() == Approx(-low.x()));
  CHECK(high.z() == Approx(-low.z()));
  CHECK(2 * high.z() == Approx(0.79 * kModelHeight_m).epsilon(0.03));
  CHECK(mesh.model_from_image(Eigen::Vector2d(150, 150)).norm() == Approx(kModelHeight_m / 2).epsilon(0.01));
}
