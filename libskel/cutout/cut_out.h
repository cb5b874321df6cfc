// A drawing as a figure of cut paper: sheets that lie over one another, dragged by the bones, as rigidly as
// possible (deform/arap.h).
#pragma once

#include <memory>
#include <vector>

#include "libskel/cutout/flat_pose.h"
#include "libskel/cutout/lattice.h"
#include "libskel/deform/arap.h"
#include "libskel/layers/layer_map.h"
#include "libskel/mesh/triangle_mesh.h"

namespace skel {

// A drawing and what is known of it. All belong together.
struct DrawnFigure {
  const Image& image;
  const Silhouette& silhouette;
  const Skeleton& skeleton;  // with places in the image and in the model
  const SkeletonTemplate& body_plan;
  const LayerMap& layers;
  const ModelFromImage& model_from_image;
};

// One piece of paper: what it shows, also where another one hides it.
struct CutOutSheet {
  int layer = 0;          // FigurePiece::layer
  Image picture;          // straight alpha
  Lattice lattice;        // of the picture's pixels
  ModelFromImage placed;  // of the picture's px
  std::vector<int> part;  // of each square: 0 trunk and head, else the limb that moves it, from 1
  struct Handle {
    int vertex;
    std::size_t joint;
  };
  std::vector<Handle> handles;  // vertices that one joint alone moves; where joints meet, paper bends
  std::shared_ptr<const ArapMesh> mesh;
};

struct CutOutOptions {
  int squares = 900;  // about, of all sheets
  // What is painted after what: 0 trunk and head, else the limb, from 1, each once. Empty: as it is drawn.
  std::vector<int> order = {};
};

struct CutOut {
  std::vector<CutOutSheet> sheets;
  struct Patch {
    std::size_t sheet, square;
  };
  std::vector<Patch> patches;  // what is painted, back to front
};

// Limbs of `layers` are sheets of their own; where they hang on the trunk, both sheets show the same. What
// others hide is filled from around it. Far limbs of a figure from the side lie behind its trunk, free legs
// and those that come out from under a skirt, too; free arms before it. The silhouette must be found.
CutOut makeCutOut(const DrawnFigure& figure, const CutOutOptions& options = {});

// Of each sheet, where its lattice's vertices come to lie: #V×2, model frame, m.
std::vector<Eigen::MatrixX2d> posedSheets(const CutOut& cut_out, const FlatPose& pose);

// The share of the paper that a pose tears: squares with a side above 2.5 times as long as it was, or turned
// over. `posed`: posedSheets().
double tornShare(const CutOut& cut_out, const std::vector<Eigen::MatrixX2d>& posed);

}  // namespace skel
