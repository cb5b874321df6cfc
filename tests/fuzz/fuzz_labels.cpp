// Label files.
#include "libskel/labels/label_file.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  const std::string path = fileOf(textOf(data, size), "fuzz.labels.json");
  findProblems(path);
  mayRefuse([&] {
    const std::string text = formatLabelFile(readLabelFile(path));
    require(formatLabelFile(readLabelFile(fileOf(text, "again.labels.json"))) == text,
            "what is written is read as it was");
  });
  return 0;
}
