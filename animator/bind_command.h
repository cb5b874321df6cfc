// The commands `skel-animate bind MODEL` and `skel-animate weights MODEL`.
#pragma once

#include <string>

#include "animator/rig_source.h"
#include "animator/skin_request.h"
#include "libskel/cli/joint_options.h"
#include "libskel/core/error.h"

namespace skel {

struct BindOptions {
  RigSource source;
  SkinRequest skin;
  std::string weights;  // a .weights.json instead of `skin`
  std::string output;   // empty: out/<stem>.glb
  JointOptions joints;
};
void bindBindOptions(CLI::App& app, BindOptions& options);
ExitCode runBind(const BindOptions& options);

struct WeightsOptions {
  RigSource source;
  SkinRequest skin;
  std::string output;  // empty: out/<stem>.weights.json
};
void bindWeightsOptions(CLI::App& app, WeightsOptions& options);
ExitCode runWeights(const WeightsOptions& options);

}  // namespace skel
