// How the joints of exported files are: the options of all tools that write rigged models.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "libskel/export/joint_names.h"

namespace skel {

struct JointOptions {
  std::string naming = "skel", bones = "along";
};

void bindJointOptions(CLI::App& app, JointOptions& options);

ExportOptions exportOptions(const std::string& name, const JointOptions& options);

// What the user is told where joints keep their names for all that; empty: nothing.
std::string namingNote(const Skeleton& skeleton, const JointOptions& options);

}  // namespace skel
