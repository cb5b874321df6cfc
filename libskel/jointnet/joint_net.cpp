#include "libskel/jointnet/joint_net.h"

#include <algorithm>
#include <array>

#include "libskel/core/check.h"

namespace skel {
namespace {

// Channels at full, half, quarter and eighth resolution, and how many residual convolutions there are at the
// three lower ones on the way down, and at quarter and half on the way up.
struct NetSize {
  std::array<int, 4> widths;
  std::array<int, 3> down;
  std::array<int, 2> up;
};
constexpr NetSize kSize = {{32, 64, 96, 160}, {1, 2, 3}, {2, 2}};
constexpr NetSize kFormerSize = {{16, 32, 64, 96}, {1, 1, 2}, {1, 2}};

}  // namespace

JointNet makeJointNet(std::string body_plan, std::vector<std::string> joints, int hourglasses,
                      int input_channels) {
  SKEL_CHECK(!joints.empty() && joints.size() <= kMaxNetJoints && hourglasses >= 1);
  const NetSize& size = input_channels == kNetInputChannels ? kSize : kFormerSize;
  ConvNetBuilder b({kNetInputSize, kNetInputSize, input_channels});
  int map = hourglass(b, b.convolution(0, size.widths[0], 3, true), size.widths, size.down, size.up);
  // The others begin where the first one ends, at half its resolution.
  for (int i = 1; i < hourglasses; ++i)
    map = hourglass(b, map, std::span(size.widths).subspan(1), std::span(size.down).subspan(1), size.up);
  b.convolution(map, heatmapChannels(static_cast<int>(joints.size())), 1, false);
  JointNet net;
  net.hourglasses = hourglasses;
  static_cast<ConvNet&>(net) = b.take();
  net.body_plan = std::move(body_plan);
  net.joints = std::move(joints);
  return net;
}

FramePlacement FramePlacement::centred(const Plane8& mask, bool mirrored) {
  const int spare_x = static_cast<int>(kFrameSize - mask.cols()),
            spare_y = static_cast<int>(kFrameSize - mask.rows());
  return {(mirrored ? spare_x + 1 : spare_x) / 2, spare_y / 2, mirrored};
}

void encodeJointNetInput(const Plane8& mask, const FigureLook& look, const FramePlacement& placement,
                         int channels, std::vector<float>& input) {
  SKEL_CHECK(channels == kNetInputChannels || channels == kCoarseInputChannels ||
             channels == kColourlessInputChannels);
  const int width = static_cast<int>(mask.cols()), height = static_cast<int>(mask.rows());
  SKEL_CHECK(width <= kFrameSize && height <= kFrameSize);
  SKEL_CHECK(!look.known() || (look.lines.cols() == width && look.lines.rows() == height));
  constexpr int kSize = kNetInputSize;

  // Mask and look at half the resolution.
  struct Cell {
    int inside = 0, lines = 0, strongest = 0;
    std::array<int, 3> tones{};                // sums of differences to the mean
    std::array<bool, 4> pixels{};              // by row
    std::array<std::array<int, 4>, 4> fine{};  // of each px, lines and the three tones
  };
  std::array<Cell, kSize * kSize> cells{};
  for (int y = 0; y < height; ++y) {
    const int frame_y = y + placement.offset_y;
    if (frame_y < 0 || frame_y >= kFrameSize) continue;
    for (int x = 0; x < width; ++x) {
      if (mask(y, x) == 0) continue;
      int frame_x = x + placement.offset_x;
      if (placement.mirrored) frame_x = kFrameSize - 1 - frame_x;
      if (frame_x < 0 || frame_x >= kFrameSize) continue;
      Cell& cell = cells[frame_y / 2 * kSize + frame_x / 2];
      ++cell.inside;
      const int pixel = frame_y % 2 * 2 + frame_x % 2;
      cell.pixels[pixel] = true;
      if (!look.known()) continue;
      cell.lines += look.lines(y, x);
      cell.strongest = std::max<int>(cell.strongest, look.lines(y, x));
      cell.fine[pixel][0] = look.lines(y, x);
      for (int k = 0; k < 3; ++k) {
        const int tone = look.tones[k](y, x) - kMeanTone;
        cell.tones[k] += tone;
        cell.fine[pixel][k + 1] = tone;
      }
    }
  }

  // Steps to the outside; from cell to cell, so thickness as a rough measure.
  std::array<int, kSize * kSize> depth;
  const auto depthAt = [&](int y, int x) {
    return y < 0 || x < 0 || y >= kSize || x >= kSize ? 0 : depth[y * kSize + x];
  };
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      depth[y * kSize + x] =
          cells[y * kSize + x].inside < 2 ? 0 : 1 + std::min(depthAt(y - 1, x), depthAt(y, x - 1));
    }
  }
  for (int y = kSize - 1; y >= 0; --y) {
    for (int x = kSize - 1; x >= 0; --x) {
      int& d = depth[y * kSize + x];
      d = std::min(d, 1 + std::min(depthAt(y + 1, x), depthAt(y, x + 1)));
    }
  }

  // Background that is shut in.
  std::array<bool, kSize * kSize> open{};
  std::vector<int> stack;
  const auto visit = [&](int y, int x) {
    if (y < 0 || x < 0 || y >= kSize || x >= kSize) return;
    const int i = y * kSize + x;
    if (open[i] || cells[i].inside > 0) return;
    open[i] = true;
    stack.push_back(i);
  };
  for (int k = 0; k < kSize; ++k) {
    visit(0, k);
    visit(kSize - 1, k);
    visit(k, 0);
    visit(k, kSize - 1);
  }
  while (!stack.empty()) {
    const int y = stack.back() / kSize, x = stack.back() % kSize;
    stack.pop_back();
    visit(y - 1, x);
    visit(y + 1, x);
    visit(y, x - 1);
    visit(y, x + 1);
  }

  input.resize(MapShape{kSize, kSize, channels}.paddedSize());
  std::fill(input.begin(), input.end(), 0.f);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const int i = y * kSize + x;
      const Cell& cell = cells[i];
      float* o = input.data() + static_cast<std::size_t>(paddedIndex(kSize, y, x)) * channels;
      o[0] = static_cast<float>(cell.inside) / 4;
      o[1] = cell.inside > 0 ? 1.f : 0.f;
      o[2] = static_cast<float>(cell.lines) / (4 * 255);
      o[3] = static_cast<float>(cell.strongest) / 255;
      o[4] = static_cast<float>(std::min(depth[i], 24)) / 12;
      o[5] = cell.inside == 0 && !open[i] ? 1.f : 0.f;
      o[6] = (static_cast<float>(x) - (kSize - 1) / 2.f) / (kSize / 2);
      o[7] = (static_cast<float>(y) - (kSize - 1) / 2.f) / (kSize / 2);
      if (channels == kColourlessInputChannels) continue;
      for (int k = 0; k < 3; ++k) o[8 + k] = static_cast<float>(cell.tones[k]) / (4 * 64);
      o[11] = look.known() && cell.inside > 0 ? 1.f : 0.f;
      for (int k = 0; k < 4; ++k) o[12 + k] = cell.pixels[k] ? 1.f : 0.f;
      if (channels == kCoarseInputChannels) continue;
      for (int k = 0; k < 4; ++k) {
        o[16 + k] = static_cast<float>(cell.fine[k][0]) / 255;
        for (int tone = 1; tone < 4; ++tone)
          o[16 + 4 * tone + k] = static_cast<float>(cell.fine[k][tone]) / 64;
      }
    }
  }
}

}  // namespace skel
