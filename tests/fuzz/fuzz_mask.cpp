// Masks: bytes draw rectangles, lines and runs of single pixels.
#include "tests/fuzz/rig_checks.h"

namespace skel {
namespace {

// Width, height; then for each stroke: kind, x, y, and two more numbers.
Plane8 maskFrom(const std::uint8_t* data, std::size_t size) {
  const int width = 1 + data[0] % 96, height = 1 + data[1] % 96;
  Plane8 mask = Plane8::Zero(height, width);
  const auto set = [&](int x, int y, bool on) {
    if (x < width && y < height) mask(y, x) = on ? 255 : 0;
  };
  for (std::size_t at = 2; at + 5 <= size; at += 5) {
    const std::uint8_t kind = data[at];
    const int x = data[at + 1] % width, y = data[at + 2] % height, a = data[at + 3], b = data[at + 4];
    const bool on = (kind & 4) == 0;
    switch (kind & 3) {
      case 0:  // a rectangle
        for (int j = 0; j <= b % 32; ++j)
          for (int i = 0; i <= a % 32; ++i) set(x + i, y + j, on);
        break;
      case 1:  // a line
        for (int s = 0; s <= 200; ++s) set(x + (a % width - x) * s / 200, y + (b % height - y) * s / 200, on);
        break;
      case 2:  // pixels of a row
        for (int i = 0; i < 16; ++i)
          if ((a << 8 | b) >> i & 1) set(x + i, y, on);
        break;
      default:  // a disc
        for (int j = -(a % 24); j <= a % 24; ++j)
          for (int i = -(a % 24); i <= a % 24; ++i)
            if (i * i + j * j <= (a % 24) * (a % 24) && x + i >= 0 && y + j >= 0) set(x + i, y + j, on);
    }
  }
  return mask;
}

}  // namespace
}  // namespace skel

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  if (size < 2) return 0;
  RigInput input;
  input.mask = maskFrom(data, size);
  input.image = Image(static_cast<int>(input.mask->cols()), static_cast<int>(input.mask->rows()));
  input.image.rgba.setConstant(255);
  RigOptions options = rigOptions(size);
  options.silhouette.fill_holes = size % 2 == 0;
  options.candidates.method = static_cast<CandidateMethod>(size % 3);
  if (size % 31 == 0) options.inflate.spacing_px = 0;
  mayRefuse([&] {
    const RiggedDrawing drawing = rigCharacter(std::move(input), options);
    requireSound(drawing);
    if (!drawing.found()) return;
    const MeshReport report = checkMesh(drawing.character.mesh);
    require(report.problem.empty(), "the mesh is a closed manifold: " + report.problem);
    require(report.parts == 1, "the mesh is in one part");
    if (options.candidates.method == CandidateMethod::kDiscs)
      require(uncoveredShare(drawing.candidates, 2) == 0, "every pixel is within 2 radii of a kept disc");
  });
  return 0;
}
