// skel-train silhouettes: learns how sure one may be of a silhouette that was found on a page.
#pragma once

#include "libskel/core/error.h"
#include "trainer/page_cases.h"

namespace skel {

ExitCode runSilhouetteTraining(const PageCaseOptions& options);

}  // namespace skel
