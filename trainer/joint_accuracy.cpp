#include "trainer/joint_accuracy.h"

#include <algorithm>

#include "libskel/core/parallel.h"
#include "libskel/image/read_image.h"
#include "libskel/recognition/tree_recognition.h"

namespace skel {

JointAccuracy jointAccuracy(const std::vector<JointedDrawing>& drawings, const JointNet& net,
                            const SkeletonTemplate& body_plan, int threads) {
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
  });
  JointAccuracy mean;
  for (const JointAccuracy& a : each) {
    mean.within_5 += a.within_5 / static_cast<double>(each.size());
    mean.within_10 += a.within_10 / static_cast<double>(each.size());
    mean.usable += a.usable / static_cast<double>(each.size());
  }
  return mean;
}

}  // namespace skel
