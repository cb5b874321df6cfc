// Style files.
#include "stylizer/style_file.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  mayRefuse([&] {
    const std::string text = formatStyleFile(readStyleFile(fileOf(textOf(data, size), "fuzz.style.json")));
    // Numbers are rounded once, frames and shapes stay.
    const StyleFile first = readStyleFile(fileOf(text, "first.style.json"));
    require(first.coding.activations.cols() == Eigen::Index(first.frames.size()),
            "there is one frame a column");
  });
  return 0;
}
