// Biovision Hierarchy: a skeleton and its motion as text (Meredith & Maddock, "Motion Capture File Formats
// Explained", 2001).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "libskel/animation/clip_limits.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/core/file_names.h"
#include "libskel/export/formats.h"
#include "libskel/export/joint_names.h"
#include "libskel/export/number_text.h"
#include "libskel/skeleton/joint_lookup.h"
#include "libskel/skin/bones.h"

namespace skel {

namespace {

using Eigen::Vector3d;

constexpr double kCentimetres = 100;
constexpr double kRate_hz = 30;

void appendVector(std::string& text, const Vector3d& v) {
  for (int k = 0; k < 3; ++k) {
    text += ' ';
    appendNumber(text, v[k], 4);
  }
}

// As they can stand at the end of a line, on which a program may look for a brace, too, and still all
// different.
std::vector<std::string> namesOnLines(const Skeleton& skeleton, JointNaming naming) {
  std::vector<std::string> names = exportedJointNames(skeleton, naming);
  std::set<std::string> taken(names.begin(), names.end());
  for (std::string& name : names) {
    std::string fit = name;
    for (char& c : fit)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '_';
    if (fit.empty() || fit.back() == ' ' || fit.back() == '{') fit += '_';
    if (fit.front() == ' ') fit.front() = '_';
    if (fit == name) continue;
    while (!taken.insert(fit).second) fit += '_';
    name = std::move(fit);
  }
  return names;
}

// Nobody reads a line that begins beyond this.
constexpr int kDeepestIndent = 40;

// Joints in the file's order: each before its children, branch by branch. Not by recursion: the depth is the
// character's. `moved`: joints that the clip moves out of their places.
void appendHierarchy(std::string& text, std::vector<int>& order, const ExportInput& input,
                     const std::vector<bool>& moved) {
  const Skeleton& skeleton = input.character.skeleton;
  const std::size_t count = skeleton.joints.size();
  std::vector<std::vector<int>> children(count);
  for (std::size_t j = count; j-- > 1;) children[std::size_t(skeleton.joints[j].parent)].push_back(int(j));
  std::vector<Vector3d> tips(count, Vector3d::Zero());  // of leaves
  for (const Bone& bone : skeletonBones(skeleton))
    tips[std::size_t(bone.joint)] = (bone.to - bone.from).cast<double>();
  const std::vector<std::string> names = namesOnLines(skeleton, input.options.naming);
  std::vector<int> open;  // from the root to the joint at hand
  const auto indent = [&](int deeper) {
    return std::string(std::size_t(2 * std::min(int(open.size()) + deeper, kDeepestIndent)), ' ');
  };
  const auto begin = [&](int joint) {
    const Joint& self = skeleton.joints[joint];
    const bool root = self.parent < 0;
    text += indent(0) + (root ? "ROOT " : "JOINT ") + names[std::size_t(joint)] + "\n";
    text += indent(0) + "{\n" + indent(1) + "OFFSET";
    // The root's place is in its position channels.
    appendVector(text,
                 root ? Vector3d::Zero()
                      : Vector3d(kCentimetres * (self.position - skeleton.joints[self.parent].position)));
    text += "\n" + indent(1) +
            (moved[joint] ? "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
                          : "CHANNELS 3 Zrotation Xrotation Yrotation\n");
    if (children[joint].empty()) {
      text += indent(1) + "End Site\n" + indent(1) + "{\n" + indent(2) + "OFFSET";
      appendVector(text, kCentimetres * tips[joint]);
      text += "\n" + indent(1) + "}\n";
    }
    order.push_back(joint);
    open.push_back(joint);
  };
  begin(0);
  while (!open.empty()) {
    std::vector<int>& left = children[open.back()];
    if (left.empty()) {
      open.pop_back();
      text += indent(0) + "}\n";
    } else {
      const int next = left.back();
      left.pop_back();
      begin(next);
    }
  }
}

// Rz(z) · Rx(x) · Ry(y) = rotation, as (z, x, y) in degrees.
Vector3d zxyDegrees(const Eigen::Quaternionf& rotation) {
  const Eigen::Matrix3d r = rotation.cast<double>().normalized().toRotationMatrix();
  const Vector3d zxy(std::atan2(-r(0, 1), r(1, 1)), std::asin(std::clamp(r(2, 1), -1.0, 1.0)),
                     std::atan2(-r(2, 0), r(2, 2)));
  return zxy * 180 / std::numbers::pi;
}

std::string encodeBvh(const ExportInput& input, const Clip& clip) {
  const Skeleton& skeleton = input.character.skeleton;
  std::string text = "HIERARCHY\n";
  std::vector<int> order;
  std::vector<bool> moved(skeleton.joints.size(), false);
  moved[0] = true;
  const JointLookup joints(skeleton);
  for (const JointTrack& track : clip.tracks)
    if (const int joint = joints.find(track.joint); joint >= 0 && !track.translation_times_s.empty())
      moved[joint] = true;
  appendHierarchy(text, order, input, moved);
  const int frames = int(std::lround(clip.duration_s() * kRate_hz)) + 1;
  checkMoments(clip, frames, order.size());
  text += "MOTION\nFrames: " + std::to_string(frames) + "\nFrame Time: ";
  appendNumber(text, 1 / kRate_hz, 7);
  text += '\n';
  const auto heights = input.character.mesh.vertices.col(1);
  const double height = heights.size() > 0 ? heights.maxCoeff() - heights.minCoeff() : 0;
  const ClipSampler sampler(clip, skeleton);
  for (int frame = 0; frame < frames; ++frame) {
    const Pose pose = sampler.at(float(frame / kRate_hz));
    const std::size_t line = text.size();
    for (const int joint : order) {
      if (moved[joint]) {
        const Joint& self = skeleton.joints[joint];
        Vector3d at = self.position;
        if (self.parent < 0)
          at += height * pose.root_translation.cast<double>();
        else
          at -= skeleton.joints[self.parent].position;
        if (!pose.translations_m.empty()) at += pose.translations_m[joint].cast<double>();
        appendVector(text, kCentimetres * at);
      }
      appendVector(text, zxyDegrees(pose.rotations[joint]));
    }
    text.erase(line, 1);  // the blank before the first number
    text += '\n';
  }
  return text;
}

}  // namespace

std::vector<std::string> bvhSuffixes(const std::string&, const std::vector<Clip>& clips) {
  if (clips.empty()) return {".bvh"};
  std::vector<std::string> suffixes;
  for (const Clip& clip : clips) {
    const std::string name = safeFileName(clip.name);
    std::string suffix = "-" + name + ".bvh";
    // Two clips may come to one name.
    for (int number = 2; std::find(suffixes.begin(), suffixes.end(), suffix) != suffixes.end(); ++number)
      suffix = "-" + name + "-" + std::to_string(number) + ".bvh";
    suffixes.push_back(std::move(suffix));
  }
  return suffixes;
}

std::vector<ExportedFile> exportBvh(const ExportInput& input) {
  const std::vector<std::string> suffixes = bvhSuffixes(input.options.name, input.clips);
  if (input.clips.empty()) return {{suffixes[0], encodeBvh(input, Clip())}};
  std::vector<ExportedFile> files;
  for (std::size_t i = 0; i < input.clips.size(); ++i)
    files.push_back({suffixes[i], encodeBvh(input, input.clips[i])});
  return files;
}

}  // namespace skel
