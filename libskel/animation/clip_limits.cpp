#include "libskel/animation/clip_limits.h"

#include <cmath>

#include "libskel/core/error.h"

namespace skel {
namespace {

constexpr double kMaxTurns = 2e6;  // of single joints: an hour of a biped at 30 poses a second

}  // namespace

void checkMoments(const Clip& clip, double moments, std::size_t joints) {
  if (moments * static_cast<double>(joints) <= kMaxTurns) return;
  throw Error(ExitCode::kInput, "the clip \"" + clip.name +
                                    "\" is too long: " + std::to_string(std::lround(moments)) + " poses of " +
                                    std::to_string(joints) + " joints; cut it into parts");
}

}  // namespace skel
