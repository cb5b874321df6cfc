// Which part of the figure each pixel of a drawing is, and which limbs are bodies of their own.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/layers/part_net.h"
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
  // Arms of which nothing is seen, or which nothing tells from the body that they are against, and of which
  // it is a guess where they end. They would only tear the body; its pixels stay with it, and these limbs
  // move nothing.
  std::vector<int> hidden = {};
  // Those of the hidden ones that could be told from the body: inOnePiece().
  std::vector<int> at_rest = {};
  // The hands hold one thing, or each other, which either arm by itself would break: both are among the
  // hidden ones.
  bool hands_linked = false;
  // Of a picture that somebody handed in: each limb of it is meant to move by itself.
  bool painted = false;
  // Of each pair of limbs of a figure drawn from the side, the farther one, which lies behind the trunk.
  // Layers or not.
  std::vector<int> far = {};
  // Of the image's size: a Part on the figure. Empty: not known.
  Plane8 part = {};

  bool any() const { return limb.size() != 0; }
  // Whether this limb is a layer.
  bool has(int number) const { return (limb == static_cast<std::uint8_t>(number)).any(); }
};

// By a net that tells all parts, their borders on the drawing's own lines: a limb becomes a layer where it
// lies against the rest of the figure, most of what divides it from that is drawn, and it is more probably a
// limb than not (limb_net.h). `skeleton` has the template's joints, in image px. Nothing for a body plan that
// the net does not know (knowsParts()).
LayerMap findLayers(const Image& image, const Silhouette& silhouette, const Skeleton& skeleton,
                    const SkeletonTemplate& body_plan, const PartNet& net);

// The map without layers, the figure in one piece. Arms that were layers are hidden: what is drawn where an
// arm lies against the body fits as it is drawn alone, and people would rather see it stay than see it come
// off (docs/looks.md). Legs that were move, as those do that nothing tells from the body.
LayerMap inOnePiece(LayerMap layers, const SkeletonTemplate& body_plan);

// The bodies that the figure is made of, the trunk, then the limbs, the farthest first: what each shows and
// what others hide of it, and where it hangs on the trunk, which there has the same pixels or, of far limbs,
// hides it. Empty: the map has no limb, or none that is more than its root.
std::vector<FigurePiece> figurePieces(const LayerMap& layers, const Silhouette& silhouette,
                                      const Skeleton& skeleton, const SkeletonTemplate& body_plan);

// Of a limb of the map: pixels beside its largest connected part, which no body shows as the limb's. Those
// that are the limb's in `found`, too, do not count; empty: all do.
int loosePixels(const LayerMap& layers, int limb, const Plane8& found = {});

// Of each joint of the skeleton, the layer whose vertices it moves: that of the limb it belongs to, if the
// mesh has it, -1 (none) if it is hidden, else 0.
std::vector<int> jointLayers(const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                             const TriangleMesh& mesh, const LayerMap& layers = {});

// The colour of a limb in such pictures; grey for 0.
std::array<std::uint8_t, 3> layerColor(int limb);
// The colour of a part that is no limb.
std::array<std::uint8_t, 3> partColor(Part part);

// "left arm" for a limb that ends in left_hand, "right hind leg" for one that ends in right_hind_foot.
std::string limbName(const SkeletonTemplate& body_plan, int limb);

// As a picture, one colour a limb, translucent where the limb is one with the body: the figure's other pixels
// grey or in the colour of their part, the rest clear.
Image layerPicture(const LayerMap& layers, const Plane8& mask);

// The map of such a picture; translucent limbs are one with the body. Throws InputError: another size than
// the figure's picture, a colour that is no limb's; `file` is what it calls the picture.
LayerMap layersOfPicture(const Image& picture, const Silhouette& silhouette,
                         const SkeletonTemplate& body_plan, const std::string& file);

}  // namespace skel
