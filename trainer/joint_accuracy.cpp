#include "trainer/joint_accuracy.h"

#include <algorithm>

#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
#include "libskel/image/read_image.h"
#include "libskel/recognition/tree_recognition.h"

namespace skel {

std::vector<JointAccuracy> jointAccuracies(const std::vector<JointedDrawing>& drawings, const JointNet& net,
                                           const SkeletonTemplate& body_plan, int threads) {
  ProgressBar bar("measuring", drawings.size());
  std::vector<JointAccuracy> each(drawings.size());
  parallelFor(drawings.size(), threads, [&](std::size_t i) {
    const Image image = readImage(drawings[i].image);
    const Silhouette silhouette = silhouetteOf(image, drawings[i]);
    const Recognition found = recognizeByTree(image, silhouette, body_plan, net);
    const double long_side = kWorkingGridSize / silhouette.grid.scale;
    int count = 0;
    JointAccuracy sum{0, 0, 1};
    for (const auto& [name, place] : drawings[i].joints) {
      const int joint = body_plan.find(name);
      if (joint < 0 || body_plan.joints[static_cast<std::size_t>(joint)].derived || !place) continue;
      const Joint& guess = found.skeleton.joints[static_cast<std::size_t>(found.skeleton.index(name))];
      const double error = (guess.image - *place).norm() / long_side;
      ++count;
      sum.within_5 += error <= .05;
      sum.within_10 += error <= .1;
      if (error > .15) sum.usable = 0;
    }
    each[i] = {sum.within_5 / std::max(count, 1), sum.within_10 / std::max(count, 1), sum.usable};
    bar.advance();
  });
  return each;
}

JointAccuracy mean(const std::vector<JointAccuracy>& accuracies) {
  JointAccuracy sum;
  for (const JointAccuracy& a : accuracies) {
    sum.within_5 += a.within_5;
    sum.within_10 += a.within_10;
    sum.usable += a.usable;
  }
  const auto count = static_cast<double>(accuracies.size());
  return {sum.within_5 / count, sum.within_10 / count, sum.usable / count};
}

}  // namespace skel
