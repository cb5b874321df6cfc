// skel-train loops: learns which of what a figure's lines enclose is ground.
#pragma once

#include "libskel/core/error.h"
#include "trainer/page_cases.h"

namespace skel {

ExitCode runLoopTraining(const PageCaseOptions& options);

}  // namespace skel
