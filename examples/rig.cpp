// A drawing in, a character with all its clips out: example_rig hero.png hero.glb
#include <cstdio>
#include <exception>

#include "libskel/core/files.h"
#include "libskel/export/write_character.h"
#include "libskel/pipeline/rig_drawing.h"

int main(int argc, char** argv) try {
  if (argc != 3) return std::fputs("usage: example_rig DRAWING OUT.glb\n", stderr), 1;
  const skel::RiggedDrawing drawing = skel::rigDrawing(argv[1]);
  skel::writeFile(argv[2], skel::encodeGlb(drawing.character, drawing.clips));
  std::printf("%s: %d joints, %d vertices, %zu clips, confidence %.2f\n", argv[2],
              static_cast<int>(drawing.character.skeleton.joints.size()),
              static_cast<int>(drawing.character.mesh.vertices.rows()), drawing.clips.size(),
              drawing.recognition.confidence);
  return 0;
} catch (const std::exception& e) {
  return std::fprintf(stderr, "%s\n", e.what()), 2;
}
