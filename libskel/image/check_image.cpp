#include "libskel/image/check_image.h"

#include "libskel/core/error.h"

namespace skel {

std::string sizeInPx(Eigen::Index width, Eigen::Index height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void checkImage(const Image& image, const std::string& name) {
  const std::string size = name + " has a size of " + sizeInPx(image.width, image.height) + " px";
  if (image.width < 0 || image.height < 0) throw UsageError(size);
  if (image.rgba.rows() != Eigen::Index{image.width} * image.height)
    throw UsageError(size + ", its rgba has " + std::to_string(image.rgba.rows()) + " rows");
}

void checkPlaneOf(const Plane8& plane, const std::string& name, const Image& image,
                  const std::string& image_name) {
  if (plane.cols() != image.width || plane.rows() != image.height)
    throw UsageError(name + " is of " + sizeInPx(plane.cols(), plane.rows()) + " px, " + image_name +
                     " has " + sizeInPx(image.width, image.height));
}

}  // namespace skel
