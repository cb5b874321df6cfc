// Pictures of a cut-out in its poses.
#pragma once

#include <vector>

#include "libskel/cutout/cut_out.h"

namespace skel {

class CutOutPainter {
 public:
  // The cut-out outlives the painter. `px_per_m`: of the pictures, about.
  CutOutPainter(const CutOut& cut_out, double px_per_m);

  // Over what `image` shows. `places`: of each sheet, where its lattice's vertices are, image px. May be
  // called from several threads.
  void paint(const std::vector<Eigen::MatrixX2d>& places, Image& image) const;

 private:
  // A sheet's picture, as fine as the film needs it, its colours multiplied by their alpha.
  struct Texture {
    Image image;
    double scale = 1;  // its px a px of the sheet's picture
    // Of its pixels: the copy of a square that they are of, -1: clear, or of any.
    Eigen::Array<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> square_of;
  };
  const CutOut& cut_out_;
  std::vector<Texture> textures_;
};

}  // namespace skel
