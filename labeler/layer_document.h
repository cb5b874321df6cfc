// The file of the limbs before the body that were painted by hand.
#pragma once

#include <memory>
#include <string>

#include "libskel/layers/layer_map.h"

namespace skel {

class LayerDocument {
 public:
  explicit LayerDocument(std::string path = {}) : path_(std::move(path)) {}

  const std::string& path() const { return path_; }
  const std::shared_ptr<const LayerMap>& saved() const { return saved_; }  // null: no file, or not read
  // Null where there is no such file. `silhouette` must be found. Throws InputError.
  std::shared_ptr<const LayerMap> read(const Silhouette& silhouette, const SkeletonTemplate& body_plan);
  // The file was painted for a picture before this one: it is given another name, not removed (keepAside()).
  void areOfEarlierPicture() { earlier_ = true; }
  // Null: the file goes. `mask`: of the figure. Throws OutputError.
  void write(const std::shared_ptr<const LayerMap>& layers, const Plane8& mask);

 private:
  std::string path_;
  std::shared_ptr<const LayerMap> opened_, saved_;
  bool earlier_ = false;
};

}  // namespace skel
