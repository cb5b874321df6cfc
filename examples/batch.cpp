// Many drawings, one a core: example_batch OUT_FOLDER a.png b.png ...
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "libskel/core/files.h"
#include "libskel/core/parallel.h"
#include "libskel/export/write_character.h"
#include "libskel/pipeline/rig_drawing.h"

int main(int argc, char** argv) {
  if (argc < 3) return std::fputs("usage: example_batch OUT_FOLDER DRAWING...\n", stderr), 1;
  const std::vector<std::string> drawings(argv + 2, argv + argc);
  std::vector<std::string> failures(drawings.size());
  const skel::RigOptions options = skel::rigOptions();
  skel::parallelFor(drawings.size(), 0, [&](std::size_t i) {
    try {
      const skel::RiggedDrawing drawing = skel::rigDrawing(drawings[i], options);
      skel::writeFile(std::string(argv[1]) + "/" + std::to_string(i) + ".glb",
                      skel::encodeGlb(drawing.character, drawing.clips));
    } catch (const std::exception& e) {
      failures[i] = e.what();
    }
  });
  bool failed = false;
  for (const std::string& failure : failures) {
    if (failure.empty()) continue;
    failed = true;
    std::fprintf(stderr, "%s\n", failure.c_str());
  }
  return failed ? 2 : 0;
}
