// Labels, moves joints and mends the mask without end, and says after each step what is on the disk now: to
// be killed by kill_test.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "tests/labeler/drawing_folder.h"

using namespace skel;

int main(int argc, char** argv) {
  if (argc != 3) return 1;
  Document document(argv[1], documentOptions());
  const Eigen::Vector2d middle(300, 300);
  for (int step = std::atoi(argv[2]);; ++step) {
    if (!document.go(step % static_cast<int>(document.items().size()))) return 2;
    // The place of the joint tells the step; every third step changes the mask as well.
    document.beginStep();
    document.moveJoint(document.bodyPlan().find("head"), Eigen::Vector2d(step % 500, step / 500));
    const auto candidates = static_cast<int>(document.state().labels.size());
    document.label({step % candidates}, static_cast<JointClass>(step % kJointClassCount));
    if (step % 3 == 0 && !document.editsMotion())
      document.paintMask(middle, middle, 3 + step % 7, step % 2 == 0);
    document.endStep();
    if (!document.saveProblem().empty()) return 2;
    if (write(STDOUT_FILENO, &step, sizeof step) != sizeof step) return 3;
  }
}
