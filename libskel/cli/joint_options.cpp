#include "libskel/cli/joint_options.h"

#include <map>

#include "libskel/cli/names.h"

namespace skel {
namespace {

const std::map<std::string, JointNaming> kNamingNames = {
    {"skel", JointNaming::kSkel}, {"vrm", JointNaming::kVrm}, {"mixamo", JointNaming::kMixamo}};
const std::map<std::string, BoneStyle> kBoneStyleNames = {
    {"along", BoneStyle::kAlong}, {"ends", BoneStyle::kEnds}, {"plain", BoneStyle::kPlain}};

}  // namespace

void bindJointOptions(CLI::App& app, JointOptions& options) {
  app.add_option("--names", options.naming, "What exported joints of a biped are called")
      ->check(namesOf(kNamingNames))
      ->capture_default_str();
  app.add_option("--bones", options.bones,
                 "Axes of the .glb's joints: along the bones, as Blender draws them; ends: so, too, and the\n"
                 "last bones reach toes and fingertips; plain: the model's, for code that turns joints")
      ->check(namesOf(kBoneStyleNames))
      ->capture_default_str();
}

ExportOptions exportOptions(const std::string& name, const JointOptions& options) {
  return {name, kNamingNames.at(options.naming), kBoneStyleNames.at(options.bones)};
}

std::string namingNote(const Skeleton& skeleton, const JointOptions& options) {
  if (namesFit(skeleton, kNamingNames.at(options.naming))) return "";
  return "the joints keep their names: --names " + options.naming +
         " is for bipeds whose joints are called as skel's are (pelvis, left_elbow ...)";
}

}  // namespace skel
