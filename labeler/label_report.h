// What a folder of label files holds: its inconsistencies, its counts, and exports for other programs.
#pragma once

#include <string>
#include <vector>

#include "labeler/import_labels.h"
#include "libskel/skeleton/body_plans.h"

namespace skel {

// One line each, with file and JSON path: all that checkLabelFolder() finds, candidates that are not those of
// picture and mask, joints that the template does not have, or that a joints or skeleton file beside them has
// elsewhere, masks beside which joints lie; and joints files that cannot be read. Throws InputError: no label
// files.
std::vector<std::string> checkLabels(const std::string& dir, const BodyPlans& plans);

// Of label files whose pictures are the same, twinsSaid() and twinJointsSaid().
std::string twinsAmong(const std::string& dir);

// picturesWithout() labels.
std::string unlabelledAmong(const std::string& dir);

// overruledNote() and movedInSkeletonNote(), each if there is a file to name.
std::vector<std::string> overruledAmong(const std::string& dir);

// Counts of drawings, candidates and labels, of every class, of joints and masks, as text. Throws InputError.
std::string labelStats(const std::string& dir);

// One row a candidate: file, index, place and radius on the grid, the three features, the label (empty:
// none). Drawings whose picture or mask has changed, or of which checkLabels() has another complaint than a
// joints file or mask beside them, and those of another body plan, are left out: `on_error` is told. "": none
// is left. Throws InputError: no label files.
std::string labelsAsCsv(const std::string& dir, const BodyPlans& plans, const OnError& on_error);

// One annotation a drawing: placed joints as keypoints, found ones beside them, the outline as polygons.
// Pictures by their path below `dir`. Left out as above.
std::string labelsAsCoco(const std::string& dir, const BodyPlans& plans, const OnError& on_error);

}  // namespace skel
