// A photo that was taken again under its name: what a person had mended of the one before is kept.
#pragma once

#include <string>
#include <vector>

#include "infer/infer_options.h"
#include "libskel/mended/earlier_picture.h"

namespace skel {

// Gives results that were left out another name before they are written over: <stem>.skeleton.old.json,
// <stem>.old.silhouette.png, or with a number where that is taken. Throws OutputError.
std::vector<KeptFile> keepEarlier(const MendedFiles& files, const InferOptions& options,
                                  const std::string& skeleton_path);

}  // namespace skel
