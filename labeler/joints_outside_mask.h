// Joints that lie beside the mask: it is inverted then, or shows another figure or a part of this one. Limbs
// of which the figure has no candidate.
#pragma once

#include <optional>
#include <string>

#include "libskel/labels/label_file.h"
#include "libskel/skeleton/template.h"

namespace skel {

// "9 of 14 joints lie outside the mask a.mask.png"; "" where it is one or two, or a third of them or less.
// Joints that follow from others do not count. Throws InputError: the mask cannot be read.
std::string jointsOutsideMask(const LabelFile& labels, const SkeletonTemplate& body_plan,
                              const std::string& mask_path);

// "joints.left_foot: lies far outside of the figure; …" of the first joint that a person has placed so: by
// that skel-infer rigs nothing, and candidates get the classes of what is not there. "": there is none.
// `mask`: of the figure.
std::string jointFarOutsideFigure(const LabelFile& labels, const Plane8& mask);

// The class of limbs that a person has placed whole, although all candidates have other classes: their limbs
// lie before the body, or the silhouette joins them to it. Nothing: there is none.
std::optional<JointClass> classWithoutCandidate(const LabelFile& labels, const SkeletonTemplate& body_plan);

}  // namespace skel
