// A joint mended as an editor does it, without rigging all anew: example_edit hero.png left_hand 12 -5
// OUT.glb
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "libskel/core/files.h"
#include "libskel/export/write_character.h"
#include "libskel/image/read_image.h"
#include "libskel/pipeline/rig_document.h"
#include "libskel/pipeline/rig_drawing.h"

int main(int argc, char** argv) try {
  if (argc != 6) return std::fputs("usage: example_edit DRAWING JOINT RIGHT_PX DOWN_PX OUT.glb\n", stderr), 1;
  skel::RigDocument document(skel::rigOptions());
  document.setImage(skel::readImage(argv[1]));
  const auto found = document.rigged();
  if (!found->found()) return std::fprintf(stderr, "%s\n", found->silhouette.reason.c_str()), 2;

  const skel::Skeleton& skeleton = found->recognition.skeleton;
  const int joint = skeleton.find(argv[2]);
  if (joint < 0) return std::fprintf(stderr, "no joint is called %s\n", argv[2]), 1;
  const Eigen::Vector2d by(std::atof(argv[3]), std::atof(argv[4]));
  document.moveJoint(argv[2], skeleton.joints[static_cast<std::size_t>(joint)].image + by);
  document.draft();                       // at once, for the eye: while the mouse is down
  const auto mended = document.rigged();  // when it is up
  skel::writeFile(argv[5], skel::encodeGlb(mended->character, mended->clips));
  std::printf("%s:", argv[5]);
  for (const skel::StageTime& time : mended->times) std::printf(" %s", time.stage.c_str());
  std::printf("\n");
  return 0;
} catch (const std::exception& e) {
  return std::fprintf(stderr, "%s\n", e.what()), 2;
}
