#include "stylizer/puppet.h"

#include <algorithm>

#include "libskel/core/error.h"
#include "libskel/core/text.h"

namespace skel {
namespace {

// As CutOutOptions has it.
std::vector<int> orderOf(const std::vector<std::string>& names, const std::vector<std::string>& parts) {
  std::vector<int> order;
  for (const std::string& name : names)
    order.push_back(int(std::find(parts.begin(), parts.end(), name) - parts.begin()));
  std::vector<int> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; !names.empty() && i < parts.size(); ++i)
    if (sorted.size() != parts.size() || sorted[i] != int(i))
      throw UsageError("--order names each part once, back to front; the parts are " + joined(parts));
  return order;
}

}  // namespace

std::vector<std::string> puppetParts(const SkeletonTemplate& body_plan) {
  std::vector<std::string> parts = {"body"};
  for (std::size_t k = 0; k < body_plan.limbs.size(); ++k) {
    std::string name = limbName(body_plan, int(k) + 1);
    std::replace(name.begin(), name.end(), ' ', '_');
    parts.push_back(name);
  }
  return parts;
}

Puppet makePuppet(const Performer& performer, const std::vector<std::string>& order) {
  CutOutOptions options;
  options.order = orderOf(order, puppetParts(performer.body_plan));
  Puppet puppet{performer.body_plan, performer.skeleton, performer.model_from_image, {}, {}};
  puppet.cut_out = makeCutOut({performer.image, performer.silhouette, performer.skeleton, performer.body_plan,
                               performer.layers, performer.model_from_image},
                              options);
  const std::vector<TemplateJoint>& joints = performer.body_plan.joints;
  puppet.rest.resize(2 * Eigen::Index(joints.size()), 1);
  for (std::size_t j = 0; j < joints.size(); ++j)
    puppet.rest.col(0).segment<2>(2 * Eigen::Index(j)) =
        performer.skeleton.joints[std::size_t(performer.skeleton.index(joints[j].name))].image;
  return puppet;
}

std::vector<Eigen::MatrixX2d> posedSheets(const Puppet& puppet, const Eigen::VectorXd& pose, double* torn) {
  std::vector<Eigen::Vector2d> places;
  for (const Joint& joint : puppet.skeleton.joints) places.push_back(joint.position.head<2>());
  for (std::size_t j = 0; j < puppet.body_plan.joints.size(); ++j)
    places[std::size_t(puppet.skeleton.index(puppet.body_plan.joints[j].name))] =
        puppet.model_from_image(pose.segment<2>(2 * Eigen::Index(j)));
  std::vector<Eigen::MatrixX2d> sheets =
      posedSheets(puppet.cut_out, flatPose(puppet.skeleton, puppet.body_plan, std::move(places)));
  if (torn) *torn = tornShare(puppet.cut_out, sheets);
  for (Eigen::MatrixX2d& sheet : sheets)
    for (Eigen::Index v = 0; v < sheet.rows(); ++v)
      sheet.row(v) = puppet.model_from_image.inverse(sheet.row(v).transpose()).transpose();
  return sheets;
}

}  // namespace skel
