// Pictures of few colours, given pixel by pixel.
#include "tests/fuzz/rig_checks.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  if (size < 3) return 0;
  const int width = 1 + data[0] % 64, zoom = 1 + data[1] % 2;
  const int height =
      static_cast<int>(std::min<std::size_t>((size - 2) / static_cast<std::size_t>(width), 64));
  if (height == 0) return 0;
  RigInput input;
  input.image = Image(width * zoom, height * zoom);
  for (int y = 0; y < input.image.height; ++y)
    for (int x = 0; x < input.image.width; ++x) {
      // Two bits each for red, green, blue and clearness: 0 is opaque white.
      const std::uint8_t value = data[2 + y / zoom * width + x / zoom];
      for (int c = 0; c < 4; ++c)
        input.image.pixel(x, y)[c] = static_cast<std::uint8_t>(255 - 85 * (value >> 2 * c & 3));
    }
  RigOptions options = rigOptions(size);
  if (size % 3 == 0) options.silhouette.method = SilhouetteMethod::kPaper;
  mayRefuse([&] { requireSound(rigCharacter(std::move(input), options)); });
  return 0;
}
