// A performer as a figure of cut paper (libskel/cutout) that is dragged by the joints of a flat motion.
#pragma once

#include <string>
#include <vector>

#include "libskel/cutout/cut_out.h"
#include "libskel/style/poses.h"
#include "stylizer/performer.h"

namespace skel {

struct Puppet {
  SkeletonTemplate body_plan;
  Skeleton skeleton;
  ModelFromImage model_from_image;
  CutOut cut_out;
  PoseMatrix rest;  // 2J×1, the drawing's joints in the order of the template, image px
};

// What can lie over each other: "body", with the head, "left_arm" and so on.
std::vector<std::string> puppetParts(const SkeletonTemplate& body_plan);

// `order`: of all parts, back to front; empty: as they are drawn. Throws UsageError: an order that does not
// name each part once.
Puppet makePuppet(const Performer& performer, const std::vector<std::string>& order = {});

// Of each sheet, #V×2, px of the drawing, for joints at `pose` (2J, in the same px). `torn`: tornShare().
std::vector<Eigen::MatrixX2d> posedSheets(const Puppet& puppet, const Eigen::VectorXd& pose,
                                          double* torn = nullptr);

}  // namespace skel
