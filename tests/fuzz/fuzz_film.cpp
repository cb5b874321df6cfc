// Animated WebP and GIF, frame by frame.
#include "libskel/video/video_reader.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  const std::string_view bytes = textOf(data, size);
  mayRefuse([&] {
    const auto reader = readVideo(fileOf(bytes, bytes.starts_with("RIFF") ? "fuzz.webp" : "fuzz.gif"));
    double before_s = -1;
    int count = 0;
    for (VideoFrame frame; count < 20 && reader->next(frame); ++count) {
      require(frame.time_s > before_s, "time goes on");
      before_s = frame.time_s;
    }
  });
  return 0;
}
