#include "labeler/layer_document.h"

#include <filesystem>

#include "labeler/save_drawing.h"
#include "libskel/core/files.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"

namespace skel {

std::shared_ptr<const LayerMap> LayerDocument::read(const Silhouette& silhouette,
                                                    const SkeletonTemplate& body_plan) {
  if (std::filesystem::is_regular_file(path_))
    opened_ = saved_ =
        std::make_shared<LayerMap>(layersOfPicture(readImage(path_), silhouette, body_plan, path_));
  return saved_;
}

void LayerDocument::write(const std::shared_ptr<const LayerMap>& layers, const Plane8& mask) {
  // One that does not fit this picture was not opened.
  if (earlier_ && !opened_) keepAside(path_);
  if (!opened_) earlier_ = false;
  if (layers == saved_) return;
  if (layers)
    replaceFile(path_, encodePng(layerPicture(*layers, mask)));
  else if (earlier_)
    keepAside(path_);
  else
    removeFile(path_);
  saved_ = layers;
}

}  // namespace skel
