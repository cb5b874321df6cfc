// From the words of the command line to what the pipeline wants.
#pragma once

#include <map>
#include <string>

#include "infer/infer_options.h"
#include "libskel/core/error.h"
#include "libskel/pipeline/rig_character.h"

namespace skel {

inline const std::map<std::string, Recognizer> kRecognizerNames = {{"paper", Recognizer::kPaper},
                                                                   {"tree", Recognizer::kTree}};
inline const std::map<std::string, CandidateMethod> kCandidateNames = {{"maxima", CandidateMethod::kMaxima},
                                                                       {"strict", CandidateMethod::kStrict},
                                                                       {"discs", CandidateMethod::kDiscs}};
inline const std::map<std::string, SkinMethod> kSkinNames = {{"geodesic", SkinMethod::kGeodesic},
                                                             {"heat", SkinMethod::kHeat},
                                                             {"euclidean", SkinMethod::kEuclidean},
                                                             {"idw", SkinMethod::kIdw},
                                                             {"idw-region", SkinMethod::kIdwRegion}};
inline const std::map<std::string, RestPose> kRestPoseNames = {
    {"drawn", RestPose::kDrawn}, {"A", RestPose::kA}, {"T", RestPose::kT}};

// Everything but the figure's number. Reads template and weights. Throws InputError, UsageError.
RigOptions rigOptions(const InferOptions& options);

// Says on stderr that the weights that were named decide nothing.
void noteUnusedWeights(const InferOptions& options);

}  // namespace skel
