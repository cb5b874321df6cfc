#include "libskel/layers/part_net.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "libskel/core/check.h"
#include "libskel/core/segment.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

constexpr std::array kWidths = {32, 48, 64, 96, 128};
constexpr std::array kDown = {1, 2, 2, 1};
constexpr std::array kUp = {1, 2, 1, 1};

// Channels of the input: colours and mask of 2×2 px, then what is known of the bones.
constexpr int kMaskChannel = 12, kLimbChannel = 16, kTrunkChannel = 24, kHeadChannel = 25, kTailChannel = 26,
              kAnimalChannel = 27, kPlaceChannel = 28;
constexpr double kNear = .045;  // of the figure's long side: within this a bone is felt

}  // namespace

bool knowsParts(const SkeletonTemplate& body_plan) { return body_plan.limbs.size() == 4; }

PartNet makePartNet() {
  ConvNetBuilder b({kPartMapSize, kPartMapSize, kPartInputChannels});
  const int first = b.convolution(0, kWidths[0], 3, true);
  b.convolution(hourglass(b, first, kWidths, kDown, kUp), kPartOutputChannels, 1, false);
  PartNet net;
  static_cast<ConvNet&>(net) = b.take();
  return net;
}

void encodeParts(const cv::Mat& rgb, const cv::Mat& mask, const PartSkeleton& skeleton,
                 std::vector<float>& input) {
  SKEL_CHECK(rgb.cols <= kPartNetSize && rgb.rows <= kPartNetSize && rgb.type() == CV_8UC3);
  SKEL_CHECK(mask.size() == rgb.size() && mask.type() == CV_8U);
  input.assign(MapShape{kPartMapSize, kPartMapSize, kPartInputChannels}.paddedSize(), 0.f);
  const auto at = [&](int y, int x) {
    return input.data() +
           static_cast<std::size_t>(paddedIndex(kPartMapSize, y / 2, x / 2)) * kPartInputChannels;
  };
  for (int y = 0; y < rgb.rows; ++y) {
    const auto* colours = rgb.ptr<cv::Vec3b>(y);
    const auto* inside = mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < rgb.cols; ++x) {
      if (inside[x] == 0) continue;
      float* o = at(y, x);
      const int k = 2 * (y % 2) + x % 2;
      for (int c = 0; c < 3; ++c) o[3 * k + c] = (static_cast<float>(colours[x][c]) - 160) / 64;
      o[kMaskChannel + k] = 1;
    }
  }
  const double reach = kNear * std::max(rgb.cols, rgb.rows);
  const auto nearness = [&](const Vec& p, const Vec& a, const Vec& b, double within) {
    return static_cast<float>(std::exp(-distanceToSegment<Vec>(p, a, b) / within));
  };
  const Vec neck = skeleton.neck(), pelvis = skeleton.pelvis();
  for (int y = 0; y < kPartMapSize; ++y)
    for (int x = 0; x < kPartMapSize; ++x) {
      float* o = at(2 * y, 2 * x);
      const float* inside = o + kMaskChannel;
      if (inside[0] + inside[1] + inside[2] + inside[3] == 0) continue;
      const Vec p(2 * x + 1, 2 * y + 1);
      for (int k = 0; k < 4; ++k) {
        const auto& [a, b, c] = skeleton.limbs[static_cast<std::size_t>(k)];
        // Also how far along the limb, 0 to 1.
        const double upper = (b - a).norm(), lower = (c - b).norm(), whole = std::max(1e-9, upper + lower);
        const Vec first = nearestOnSegment<Vec>(p, a, b), second = nearestOnSegment<Vec>(p, b, c);
        const bool is_first = (first - p).squaredNorm() < (second - p).squaredNorm();
        const double along = is_first ? (first - a).norm() : upper + (second - b).norm();
        const double d = ((is_first ? first : second) - p).norm();
        const auto close = static_cast<float>(std::exp(-d / reach));
        o[kLimbChannel + 2 * k] = close;
        o[kLimbChannel + 2 * k + 1] = close * static_cast<float>(along / whole);
      }
      o[kTrunkChannel] = std::max(nearness(p, neck, skeleton.body, 2 * reach),
                                  nearness(p, skeleton.body, pelvis, 2 * reach));
      o[kHeadChannel] = nearness(p, skeleton.head, skeleton.head, 2 * reach);
      if (skeleton.animal) {
        o[kTailChannel] = nearness(p, skeleton.tail_root, skeleton.tail, reach);
        o[kAnimalChannel] = 1;
      }
      o[kPlaceChannel] = 2 * static_cast<float>(p.x()) / static_cast<float>(rgb.cols) - 1;
      o[kPlaceChannel + 1] = 2 * static_cast<float>(p.y()) / static_cast<float>(rgb.rows) - 1;
    }
}

}  // namespace skel
