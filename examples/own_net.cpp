// The same with a net that skel-train joints has made: example_own_net hero.png mine.bin hero.glb
#include <cstdio>
#include <exception>
#include <memory>

#include "libskel/core/files.h"
#include "libskel/export/write_character.h"
#include "libskel/pipeline/rig_drawing.h"

int main(int argc, char** argv) try {
  if (argc != 4) return std::fputs("usage: example_own_net DRAWING NET.bin OUT.glb\n", stderr), 1;
  skel::RigOptions options = skel::rigOptions();
  options.joint_net = std::make_shared<const skel::JointNet>(
      skel::readyToRun(skel::parseJointNet(skel::readFile(argv[2]), argv[2])));
  const skel::RiggedDrawing drawing = skel::rigDrawing(argv[1], options);
  skel::writeFile(argv[3], skel::encodeGlb(drawing.character, drawing.clips));
  return 0;
} catch (const std::exception& e) {
  return std::fprintf(stderr, "%s\n", e.what()), 2;
}
