// What a person has mended of a drawing: named on the command line, or left beside the drawing and its
// results.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libskel/pipeline/drawing_notes.h"
#include "libskel/pipeline/rig_character.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {

class FormerNames;

// A figure of a drawing, and what the user has named for it. Paths; "": there is none.
struct MendRequest {
  std::string source;                 // the drawing
  std::string image_sha256;           // of its bytes
  std::string recolored_sha256 = {};  // of a picture before with the very same figure; "": none is known
  std::string results;                // where this run writes, without endings; "": nowhere
  std::string out_dir = {};           // the folder of all its results; "": that of these
  std::shared_ptr<FormerNames> former_names =
      {};                      // of a run over many drawings; looked for where there is none
  int figure = 1;              // 1 is the largest
  bool is_one_of_all = false;  // all figures of the drawing are rigged
  std::string skeleton;        // a .skeleton.json as it stands, or all joints of a .labels.json
  std::string mask, limbs, back;
  bool finds_limbs = true, finds_back = true;  // where none are named
  bool takes_up = true;                        // what nobody has named

  bool isOfPicture(const std::string& sha256) const {
    return sha256 == image_sha256 || (!recolored_sha256.empty() && sha256 == recolored_sha256);
  }
};

// Paths; "": there is none.
struct MendedFiles {
  std::string skeleton;  // a result with joints that a person has moved
  std::string labels;    // with joints that a person has placed
  std::string mask, limbs, back;
  bool painted_silhouette =
      false;  // the mask is a result of that name, painted in place: that one is not written
  bool painted_layers = false;  // the limbs are <stem>.layers.png, the same

  // Of each kind the first place's counts; files of later places that say something else.
  struct PassedOver {
    std::string file, for_file;
  };
  std::vector<PassedOver> passed_over;

  std::string facing;  // a result of which a person has said which way it looks
  double facing_deg = 0;

  std::map<std::string, std::string> former_name;  // of the picture, by a file that was made for it then

  std::vector<std::string> other_figure;  // made for another one than the largest, where all are rigged
  std::vector<std::string> other_plan;    // of another body plan than is asked for: not among those above
  std::string other_plan_name;            // "": none that skel brings along
  std::string unknown_joint;              // of labels, of no body plan: with file and place; else ""

  // A photo that was taken again has the name of the one before.
  std::optional<SkeletonSource> earlier_result;  // what was found in that one
  bool has_result = false;                       // of this one or of that
  std::vector<std::string> earlier;              // files made for that one: not among those above
  std::map<std::string, std::string>
      other_size;                        // of those: that are not of the picture's size, which is told
  std::string fits_again;                // a skeleton that was kept and is of this picture
  std::vector<std::string> kept_layers;  // painted limbs that were kept: one may be of this picture
  bool mask_before = false;              // the mask was there before the picture changed
  bool limbs_before = false;             // the limbs may have been
};

// Those that are named, and what a person has left in the folders of mend_places.h, of each kind the first:
// an edited skeleton, a silhouette that is not outlined as its skeleton file says, or was that file's mask
// already, layers with other pixels than they were written with (sealed_png.h); <source's stem>.mask.png,
// .labels.json, .limbs.png and .back.png (labels and back of the first figure; <stem>-2.mask.png and
// <stem>-2.limbs.png are the second one's, unless a drawing is called so), elsewhere than beside the
// drawing where they, or the result there, name its picture; where there is none of a kind, what was made for
// the picture under another name (former_names.h). Beside a drawing with <stem>.joints.json nothing
// is looked for: that is annotated, not mended. What was made for another picture than the request's is left
// out (earlier_picture.h).
MendedFiles mendedFiles(const MendRequest& request);

// Joints that a person has placed.
struct PlacedJoints {
  std::vector<std::pair<std::string, Eigen::Vector2d>> joints;  // image px
  std::string body_plan;                                        // that they belong to; "": either
  std::optional<SkeletonFile::Labels> labels;                   // where some of them are from; path as given
  bool has_of_labels = false;                                   // of a label file, newer than the skeleton
  bool has_plan_of_labels = false;        // another than the first of those that are tried, without a joint
  std::size_t of_own_labels = 0;          // that stand so in the labels, too
  std::vector<std::string> contradicted;  // joints that the skeleton and the label file place elsewhere
  bool labels_count = false;              // for those; else the skeleton does
  std::string outline_sha256;             // of the figure when they were mended; or ""
  // The result that they are in, which stands as it is: a person has seen all of it. Nothing where labels
  // have changed since.
  std::optional<SkeletonFile> skeleton;
};

// Where all figures of the drawing are rigged, moves a mask that nobody named and that has no pixel of the
// largest figure, and labels with it, from their place in `files` to `other_figure`. `figures`: of the image.
void leaveOutOtherFigures(MendedFiles& files, const MendRequest& request, const Image& image,
                          FigureFinder& figures);
std::optional<Note> otherFigureNote(const MendedFiles& files);

// Moves a skeleton and labels that nobody named, and whose joints are of none of the options' body plans,
// from their place in `files` to `other_plan`; labels with a joint of no plan at all to `unknown_joint`.
// Throws InputError: the skeleton lies where the run writes.
void leaveOutOtherPlans(MendedFiles& files, const MendRequest& request, const RigOptions& rig);

// How they are taken up; nothing where none were left out.
std::optional<Note> otherPlanNote(const MendedFiles& files, const RigOptions& rig);
std::optional<Note> unknownJointNote(const MendedFiles& files);

// Of skeleton and labels. What the skeleton has from labels goes where it has gone, or been moved, in those.
// Where both place a joint, each elsewhere, or are of different body plans, the file
// that was written later counts; always the skeleton, if it was made with those very labels. Throws
// InputError: made for another figure; labels that were named and hold no joints, or are of another picture
// or body plan.
PlacedJoints placedJoints(const MendedFiles& files, const MendRequest& request, const RigOptions& rig,
                          const Image& image);

// The options for the body plan of that name alone; as they are for "".
RigOptions forBodyPlan(const RigOptions& rig, const std::string& body_plan);

// Which of two files counts, where they contradict each other; nothing where they do not. `kept`: what the
// skeleton is called now; "": it stays.
std::optional<Note> contradictionNote(const MendedFiles& files, const PlacedJoints& placed,
                                      const std::string& kept = "");

// Which of them were taken up though nobody named them; nothing where none was.
std::optional<Note> mendedNote(const MendedFiles& files, const MendRequest& request,
                               const PlacedJoints& placed);

}  // namespace skel
