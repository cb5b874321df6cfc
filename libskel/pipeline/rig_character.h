// The whole way from a drawing to a rigged character. All tools and tests go through rigCharacter().
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/animation/retarget.h"
#include "libskel/candidates/candidates.h"
#include "libskel/classifier/mlp.h"
#include "libskel/classifier/weights_file.h"
#include "libskel/export/rest_pose.h"
#include "libskel/export/write_character.h"
#include "libskel/image/image.h"
#include "libskel/jointnet/joint_net.h"
#include "libskel/layers/layer_map.h"
#include "libskel/mesh/inflate.h"
#include "libskel/recognition/recognition.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/template.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

// A picture beside the drawing, and the file that complaints name.
struct NamedPicture {
  Image image = {};
  std::string file = {};
};

// What a character is made from. `image` is needed unless there is a `model`.
struct RigInput {
  Image image = {};
  std::string file = {};            // what complaints call the image
  std::optional<Plane8> mask = {};  // the figure, given by hand; of the image's size
  FigureFinder* figures = nullptr;  // of the image, where several of its figures are rigged; null: its own
  std::optional<TriangleMesh> model = {};   // take this mesh instead of inflating the silhouette
  std::optional<NamedPicture> back = {};    // the figure seen from behind, for the back of the model
  int turned_deg = 0;                       // of the `skeleton`'s figure, clockwise against upright
  std::optional<NamedPicture> layers = {};  // layerPicture(), mended: which limbs lie before the body
  // Go on from these joints (image px) instead of recognising any.
  std::optional<Skeleton> skeleton = {};
  // Joints of the body plan that a person has placed, image px: they are there and sure, the others are
  // recognised.
  std::vector<std::pair<std::string, Eigen::Vector2d>> placed = {};
};

// A body plan and the clips that fit it, for the canonical pose.
struct PlannedClips {
  SkeletonTemplate body_plan;
  std::vector<Clip> clips;
};

enum class Recognizer {
  kTree,   // a net that sees the whole figure, and a tree search (tree_recognition.h)
  kPaper,  // the rules of the paper (paper_recognizer.h)
};

// How far rigCharacter() goes: what comes after that stays empty.
enum class LastStage {
  kSilhouette,
  kClasses,  // candidates, and what the classifier says of them
  kJoints,   // in the drawing; those of the character, too
  kLayers,
  kModel,  // mesh, joints and skin in the rest pose, which is not yet bound to what clips stretch
  kClips,
};

struct RigOptions {
  LastStage last = LastStage::kClips;
  SilhouetteOptions silhouette = {};
  CandidateOptions candidates = {};
  Mlp mlp = defaultMlp();  // tells the classes of candidates apart
  SkeletonTemplate body_plan = loadTemplate("biped");
  // Of a figure that fits this body plan better, or whose given skeleton is of it: instead of `body_plan` and
  // `clips`. Of drawings that nobody has learned from the nets mistake 2 people of 322 and 3 animals of 62.
  std::optional<PlannedClips> otherwise = {};
  Recognizer recognizer = Recognizer::kTree;
  bool upright = false;                              // the figure is not turned: try no other orientations
  std::shared_ptr<const JointNets> joint_nets = {};  // of body plans; null: the built-in ones
  std::shared_ptr<const JointNet> joint_net = {};    // null: of `joint_nets` the one that knows the body plan
  bool layers = true;  // the figure's parts are told apart; false: one skin that knows of none
  // Limbs that are drawn over the body are bodies of their own; false: those of a mended layer map alone.
  bool cut_limbs = false;
  std::shared_ptr<const PartNet> part_net = {};  // tells them; null: the built-in one (part_net.h)
  InflateOptions inflate{.thin_outline = true};
  std::optional<Back> back = {};  // nothing: kPlain, or kSame for who is drawn from the side
  double height_m = 0;            // of the model, 1e-3 to 1e5; 0: the body plan's own
  // Which way the model looks, as a person has said: 0 to the viewer (+z), positive to the right; nothing: as
  // it is seen.
  std::optional<double> facing_rad = {};
  SkinMethod skin_method = SkinMethod::kGeodesic;
  SkinOptions skin = {};
  RestPose rest_pose = RestPose::kDrawn;
  std::vector<Clip> clips = {};                          // for the canonical pose
  double into_picture = RetargetOptions().into_picture;  // of the clips' limbs, see retarget.h
};

// The one of the options' body plans that is called so; the first if none is.
const SkeletonTemplate& planNamed(std::string_view name, const RigOptions& options);

struct StageTime {
  std::string stage;
  double time_s;
};

// Everything that was found on the way.
struct RiggedDrawing {
  Image image;       // what was looked at: the input's, or the model's front view
  Image even_light;  // the figure without a photographed page's light and ruling (even_light.h); mostly empty
  Silhouette silhouette;
  CandidateSet candidates;
  Features features;
  ClassProbabilities classes;
  SkeletonTemplate body_plan;  // that it was rigged by
  Recognition recognition;     // with positions in the model as it is drawn, whatever the rest pose
  LayerMap layers;             // empty for a model of a user's own
  Plane8 found_limbs = {};     // LayerMap::limb as it was found, where input.layers says another
  RiggedCharacter character;   // empty if the silhouette has not been found
  std::vector<Clip> clips;     // retargeted to the rest pose
  std::vector<StageTime> times;

  bool found() const { return silhouette.found(); }
  // The picture in the colours that the character wears.
  const Image& colors() const { return even_light.empty() ? image : even_light; }
};

// Stages 2 to 8, or up to options.last. Where there is no figure, `found()` is false and silhouette.reason
// says why. Throws UsageError if an input or an option makes no sense (check_rig.h) or no net knows the body
// plan, InputError if input.layers does not fit, or input.back shows no figure, UnavailableError's kind of
// Error if memory or threads do not suffice. Nothing but an Error leaves it.
RiggedDrawing rigCharacter(RigInput input, const RigOptions& options);

}  // namespace skel
