// Which limb each pixel of a drawing belongs to.
#pragma once

#include <array>
#include <cstdint>
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
  // Arms of which nothing is seen: no layer, against the rest of the figure all along, and the net is unsure
  // where they end. They would only tear the body; its pixels stay with it, and these limbs move nothing.
  std::vector<int> hidden = {};

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
// mesh has it, -1 (none) if it is hidden, else 0.
std::vector<int> jointLayers(const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                             const TriangleMesh& mesh, const LayerMap& layers = {});

// The colour of a limb in such pictures; grey for 0.
std::array<std::uint8_t, 3> layerColor(int limb);

// "left arm" for a limb that ends in left_hand, "right hind leg" for one that ends in right_hind_foot.
std::string limbName(const SkeletonTemplate& body_plan, int limb);

// As a picture, one colour a limb: the figure's other pixels grey, the rest clear.
Image layerPicture(const LayerMap& layers, const Plane8& mask);

// The map of such a picture. Throws InputError: another size than the figure's picture, a colour that is no
// limb's; `file` is what it calls the picture.
LayerMap layersOfPicture(const Image& picture, const Silhouette& silhouette,
                         const SkeletonTemplate& body_plan, const std::string& file);

}  // namespace skel
