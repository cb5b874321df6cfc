// What a change of a drawing costs that is rigged already, beside rigging it anew:
//
//   bench-rerig [--once] DRAWING...
//
// Prints processor time, the least of three, ms. Instructions, which do not depend on what else the machine
// does:
//
//   valgrind --tool=callgrind bench-rerig --once DRAWING; callgrind_annotate --inclusive=yes callgrind.out.*
//
// tells those of each function of this file, one call each.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>
#include <string>

#include "libskel/image/read_image.h"
#include "libskel/pipeline/rig_document.h"
#include "libskel/pipeline/rig_drawing.h"

namespace skel {

using Rigged = std::shared_ptr<const RiggedDrawing>;

// With names of their own for the profile.
[[gnu::noinline]] Rigged riggedAnew(const RigDocument& document) {
  return std::make_shared<RiggedDrawing>(rigCharacter(document.input(), document.options()));
}
[[gnu::noinline]] Rigged movedJoint(RigDocument& document) { return document.rigged(); }
[[gnu::noinline]] Rigged draggedJoint(RigDocument& document) { return document.draft(); }
[[gnu::noinline]] Rigged strokeOfMask(RigDocument& document) { return document.rigged(); }
[[gnu::noinline]] Rigged otherSkin(RigDocument& document) { return document.rigged(); }
[[gnu::noinline]] Rigged otherClips(RigDocument& document) { return document.rigged(); }

namespace {

int repeats = 3;

// `change` is not measured, `rig` is.
template <class Change, class Rig>
void measure(const char* what, RigDocument& document, const Change& change, const Rig& rig) {
  double least_ms = 1e9;
  std::string stages;
  for (int i = 0; i < repeats; ++i) {
    change(i);
    const std::clock_t start = std::clock();
    const Rigged rigged = rig(document);
    const double ms = 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC;
    if (ms > least_ms) continue;
    least_ms = ms;
    stages.clear();
    for (const StageTime& time : rigged->times)
      if (time.time_s > 1e-4) stages += " " + time.stage;
  }
  std::printf("  %-28s %7.1f ms  %s\n", what, least_ms, stages.c_str());
}

void measure(const std::string& drawing) {
  std::printf("%s\n", drawing.c_str());
  const Image image = readImage(drawing);
  RigDocument document(rigOptions());
  document.setImage(image);
  const auto nothing = [](int) {};
  measure("anew", document, nothing, [](const RigDocument& d) { return riggedAnew(d); });
  const Rigged first = document.rigged();
  if (!first->found()) return;
  const Joint& joint = first->recognition.skeleton.joints.back();
  const auto move = [&](int i) {
    document.moveJoint(joint.name, joint.image + Eigen::Vector2d(3 * (i + 1), 2 * i));
  };
  measure("a moved joint", document, move, movedJoint);
  const auto drag = [&](int i) { move(i + 5); };
  measure("a joint that is dragged", document, drag, draggedJoint);
  document.rigged();
  const auto stroke = [&](int i) {
    Plane8 mask = first->silhouette.mask;
    const int x = static_cast<int>(joint.image.x()), y = static_cast<int>(joint.image.y()), r = 2 + i;
    const int x0 = std::max(0, x - r), y0 = std::max(0, y - r);
    mask.block(y0, x0, std::min<int>(y + r, int(mask.rows())) - y0,
               std::min<int>(x + r, int(mask.cols())) - x0)
        .setConstant(0);
    document.setMask(std::move(mask));
  };
  measure("a stroke, joints as they are", document, stroke, strokeOfMask);
  RigOptions options = document.options();
  const auto skin = [&](int i) {
    options.skin_method = i % 2 == 0 ? SkinMethod::kIdw : SkinMethod::kGeodesic;
    document.setOptions(options);
  };
  measure("another way to bind the skin", document, skin, otherSkin);
  const auto clips = [&](int i) {
    options.clips.resize(std::size_t(3 - i));
    document.setOptions(options);
  };
  measure("other clips", document, clips, otherClips);
}

}  // namespace
}  // namespace skel

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    if (std::string(argv[i]) == "--once")
      skel::repeats = 1;
    else
      skel::measure(argv[i]);
}
