// A character as AnimatedDrawings (Smith et al., "A Method for Animating Children's Drawings of the Human
// Figure", 2023) reads it: a crop of the drawing, its mask, and sixteen joints in the crop's pixels.
#include <algorithm>
#include <array>
#include <cmath>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/sha256.h"
#include "libskel/export/formats.h"
#include "libskel/image/write_image.h"

namespace skel {

namespace {

struct NamedJoint {
  const char *name, *parent, *ours;
};

// Its torso lies between the shoulders, its neck at the nose.
constexpr std::array<NamedJoint, 16> kJoints = {{
    {"root", nullptr, "pelvis"},
    {"hip", "root", "pelvis"},
    {"torso", "hip", "neck"},
    {"neck", "torso", "head"},
    {"right_shoulder", "torso", "right_shoulder"},
    {"right_elbow", "right_shoulder", "right_elbow"},
    {"right_hand", "right_elbow", "right_hand"},
    {"left_shoulder", "torso", "left_shoulder"},
    {"left_elbow", "left_shoulder", "left_elbow"},
    {"left_hand", "left_elbow", "left_hand"},
    {"right_hip", "root", "right_hip"},
    {"right_knee", "right_hip", "right_knee"},
    {"right_foot", "right_knee", "right_foot"},
    {"left_hip", "root", "left_hip"},
    {"left_knee", "left_hip", "left_knee"},
    {"left_foot", "left_knee", "left_foot"},
}};

// Clear pixels around the figure, also where it touches the drawing's border.
constexpr int kMargin_px = 4;

}  // namespace

std::vector<ExportedFile> exportCharCfg(const ExportInput& input) {
  if (!input.drawing || !input.mask)
    throw UsageError("the format char_cfg needs a drawing and its silhouette; a model alone has none");
  const Image& drawing = *input.drawing;
  const Plane8& mask = *input.mask;
  const Skeleton& skeleton = input.character.skeleton;
  SKEL_CHECK_EQ(mask.rows(), drawing.height);
  SKEL_CHECK_EQ(mask.cols(), drawing.width);

  int x0 = drawing.width, y0 = drawing.height, x1 = -1, y1 = -1;
  for (int y = 0; y < drawing.height; ++y)
    for (int x = 0; x < drawing.width; ++x)
      if (mask(y, x) >= 128) {
        x0 = std::min(x0, x), x1 = std::max(x1, x);
        y0 = std::min(y0, y), y1 = std::max(y1, y);
      }
  SKEL_CHECK(x1 >= 0);
  x0 -= kMargin_px, y0 -= kMargin_px;
  const int width = x1 + kMargin_px + 1 - x0, height = y1 + kMargin_px + 1 - y0;

  Image texture(width, height);
  texture.rgba.setZero();
  Plane8 crop = Plane8::Zero(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int from_x = x + x0, from_y = y + y0;
      if (from_x < 0 || from_y < 0 || from_x >= drawing.width || from_y >= drawing.height) continue;
      std::copy_n(drawing.pixel(from_x, from_y), 3, texture.pixel(x, y));
      const bool inside = mask(from_y, from_x) >= 128;
      texture.pixel(x, y)[3] = inside ? 255 : 0;
      crop(y, x) = inside ? 255 : 0;
    }

  std::string yaml = "height: " + std::to_string(height) + "\nskeleton:\n";
  for (const NamedJoint& joint : kJoints) {
    const int ours = skeleton.find(joint.ours);
    if (ours < 0)
      throw UsageError(std::string("the format char_cfg is for bipeds; the skeleton lacks \"") + joint.ours +
                       "\"");
    const Eigen::Vector2d at = skeleton.joints[ours].image - Eigen::Vector2d(x0, y0);
    const auto whole = [](double value, int size) {
      return std::clamp(int(std::lround(value)), 0, size - 1);
    };
    yaml += "- loc:\n  - " + std::to_string(whole(at.x(), width)) + "\n  - " +
            std::to_string(whole(at.y(), height)) + "\n  name: " + joint.name +
            "\n  parent: " + (joint.parent ? joint.parent : "null") + "\n";
    // Its reader goes by the keys that it knows.
    if (skeleton.joints[ours].origin != JointOrigin::kEdited)
      yaml += "  skel_found: [" + std::to_string(whole(at.x(), width)) + ", " +
              std::to_string(whole(at.y(), height)) + "]\n";
  }
  const std::string mask_png = encodePng(crop);
  if (!input.mask_is_given) yaml += "skel_found_mask: " + sha256(mask_png) + "\n";
  yaml += "width: " + std::to_string(width) + "\n";
  return {{"/mask.png", mask_png}, {"/texture.png", encodePng(texture)}, {"/char_cfg.yaml", yaml}};
}

}  // namespace skel
