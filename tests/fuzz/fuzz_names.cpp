// Names out of files, on their way to become names of files.
#include <algorithm>
#include <filesystem>

#include "libskel/core/file_names.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const TempDir dir;
  namespace fs = std::filesystem;
  const std::string text(textOf(data, size)), name = safeFileName(text);
  require(!name.empty() && name.size() <= 120 && name.front() != '.' && name.front() != '-',
          "a name is seen, and no option");
  require(std::none_of(name.begin(), name.end(),
                       [](char c) { return c == '/' || c == '\\' || c == '\n' || c == '\0'; }),
          "a name is of one folder, on one line");
  require(safeFileName(name) == name, "a safe name stays as it is");
  mayRefuse([&] {
    const fs::path inside = pathInside(dir.path(), text, "fuzz");
    const fs::path below = inside.lexically_normal().lexically_relative(fs::path(dir.path()));
    require(!below.empty() && *below.begin() != "..", "a path stays in its folder");
  });
  return 0;
}
