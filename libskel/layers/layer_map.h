// Which limb each pixel of a drawing belongs to.
#pragma once

#include <string>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/mesh/figure_piece.h"
#include "libskel/mesh/triangle_mesh.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/template.h"

namespace skel {

// Limbs that are drawn over the body, or against it with a line between. Those that are free, and those that
// nothing tells from the body, belong to it.
struct LayerMap {
  // Of the image's size: 0 outside of the figure, on its trunk and its head, else the limb, numbered from 1
  // in the template's order. Empty: one skin.
  Plane8 limb;

  bool any() const { return limb.size() != 0; }
};

// From the lines and colours across each limb's bones. Conservative: a limb becomes a layer where most of
// what divides it from the body is drawn. `skeleton` has the template's joints, in image px.
LayerMap findLayers(const Image& image, const Silhouette& silhouette, const Skeleton& skeleton,
                    const SkeletonTemplate& body_plan);

// The bodies that the figure is made of, the farthest first: what each shows and what others hide of it, and
// where it hangs on the trunk, which there has the same pixels. Empty: the map has no limb, or none that is
// more than its root.
std::vector<FigurePiece> figurePieces(const LayerMap& layers, const Silhouette& silhouette,
                                      const Skeleton& skeleton, const SkeletonTemplate& body_plan);

// Of each joint of the skeleton, the layer whose vertices it moves: that of the limb it belongs to, if the
// mesh has it, else 0.
std::vector<int> jointLayers(const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                             const TriangleMesh& mesh);

// As a picture, one colour a limb: the figure's other pixels grey, the rest clear.
Image layerPicture(const LayerMap& layers, const Plane8& mask);

// The map of such a picture. Throws InputError: another size than the figure's picture, a colour that is no
// limb's; `file` is what it calls the picture.
LayerMap layersOfPicture(const Image& picture, const Silhouette& silhouette,
                         const SkeletonTemplate& body_plan, const std::string& file);

}  // namespace skel
