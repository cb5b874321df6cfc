// Painted layers: PNG files, or bytes that paint rectangles in colours of limbs, of parts, and in others.
// What is read is cut into bodies, and is the same map when it was written again.
#include <array>

#include "libskel/image/read_image.h"
#include "libskel/layers/layer_map.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/synthetic_figure.h"

namespace skel {
namespace {

constexpr int kSize = 64;
constexpr std::array<std::uint8_t, 6> kAlphas = {255, 170, 213, 212, 128, 0};

// For each stroke: colour, x, y, width and height, how opaque.
Image paintingFrom(std::string_view bytes) {
  Image picture(kSize, kSize);
  picture.rgba.setZero();
  const auto at = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  for (std::size_t i = 0; i + 5 <= bytes.size(); i += 5) {
    const int kind = at(i) % 16;
    std::array<std::uint8_t, 3> color = layerColor(kind);
    if (kind >= 5 && kind < 9)
      color = partColor(std::array{Part::kHair, Part::kSkirt, Part::kAppendix, Part::kThing}[kind - 5]);
    if (at(i) == 255) color = {1, 2, 3};  // nothing's
    for (int y = at(i + 2) % kSize, y1 = std::min(kSize, y + 1 + at(i + 3) / 16 * 4); y < y1; ++y)
      for (int x = at(i + 1) % kSize, x1 = std::min(kSize, x + 1 + at(i + 3) % 16 * 4); x < x1; ++x) {
        std::copy(color.begin(), color.end(), picture.pixel(x, y));
        picture.pixel(x, y)[3] = kAlphas[at(i + 4) % kAlphas.size()];
      }
  }
  return picture;
}

}  // namespace
}  // namespace skel

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const CapsuleFigure figure{.size = kSize};
  static const Silhouette silhouette = extractSilhouette(capsuleImage(figure));
  static const Skeleton skeleton = capsuleSkeleton(figure);
  static const SkeletonTemplate body_plan = loadTemplate("biped");
  const std::string_view bytes = textOf(data, size);
  mayRefuse([&] {
    const Image picture = bytes.starts_with("\x89PNG") ? decodeImage(bytes, "fuzz.png") : paintingFrom(bytes);
    const LayerMap layers = layersOfPicture(picture, silhouette, body_plan, "fuzz.png");
    if (layers.any())
      require(layers.limb.maxCoeff() <= static_cast<int>(body_plan.limbs.size()),
              "limbs are of the body plan");
    const LayerMap again =
        layersOfPicture(layerPicture(layers, silhouette.mask), silhouette, body_plan, "again.png");
    require(again.any() == layers.any() && (!layers.any() || (again.limb == layers.limb).all()),
            "what is written is read as it was");
    for (const FigurePiece& piece : figurePieces(layers, silhouette, skeleton, body_plan))
      require(piece.layer <= static_cast<int>(body_plan.limbs.size()) && (piece.mask != 0).any() &&
                  piece.hidden.rows() == piece.mask.rows() && piece.over.cols() == piece.mask.cols(),
              "bodies are limbs or the trunk, and something");
  });
  return 0;
}
