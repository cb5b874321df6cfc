#include "libskel/pipeline/rig_character.h"

#include <algorithm>
#include <chrono>
#include <numbers>

#include "libskel/animation/clip_library.h"
#include "libskel/animation/retarget.h"
#include "libskel/classifier/features.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/error.h"
#include "libskel/deform/bound_stretch.h"
#include "libskel/deform/limb_depth.h"
#include "libskel/deform/measure_figure.h"
#include "libskel/jointnet/net_joints.h"
#include "libskel/mesh/front_view.h"
#include "libskel/pipeline/body_depth.h"
#include "libskel/pipeline/check_rig.h"
#include "libskel/pipeline/facing.h"
#include "libskel/pipeline/folded_arms.h"
#include "libskel/pipeline/rig_memory.h"
#include "libskel/pipeline/worn_parts.h"
#include "libskel/recognition/complete_skeleton.h"
#include "libskel/recognition/facing_net.h"
#include "libskel/recognition/joint_note.h"
#include "libskel/recognition/paper_recognizer.h"
#include "libskel/recognition/silhouette_confidence.h"
#include "libskel/recognition/tree_recognition.h"
#include "libskel/silhouette/even_light.h"
#include "libskel/silhouette/line_art.h"
#include "libskel/silhouette/outline.h"
#include "libskel/skeleton/hanging.h"
#include "libskel/skeleton/lift.h"
#include "libskel/skeleton/mark_placed.h"

namespace skel {
namespace {

// Runs the stages and notes how long each took; with a memory, only those of which something has changed.
class StageRunner {
 public:
  StageRunner(std::vector<StageTime>& times, RigMemory* memory) : times_(times), memory_(memory) {}

  template <class Work>
  auto operator()(const char* stage, const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    auto result = work();
    times_.push_back(
        {stage, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
    return result;
  }

  // `of`: the changes of all that `work` looks at.
  template <class T, class Work>
  T operator()(const char* stage, Made<T> RigMemory::*kept, const std::vector<Change>& of, const Work& work) {
    if (!memory_) return (*this)(stage, work);
    Made<T>& made = memory_->*kept;
    if (!made.isOf(of)) made.take((*this)(stage, work), of);
    return made.value;
  }

  Change of(RigPart part) const { return memory_ ? memory_->changes.of(part) : 0; }
  template <class T>
  Change of(Made<T> RigMemory::*kept) const {
    return memory_ ? (memory_->*kept).change : 0;
  }

 private:
  std::vector<StageTime>& times_;
  RigMemory* memory_;
};

// To the hundredth of a pixel that a skeleton file keeps, so that to go on from the file is to go on from
// here.
void roundToFile(Skeleton& skeleton) {
  for (Joint& joint : skeleton.joints) joint.image = (joint.image * 100).array().round() / 100;
}

// Those that follow from others follow them; of what the rules of the paper have not seen, so do guesses. The
// net's guesses are its best and stay. What was said of the joints before is stale, but for what is still
// missing.
void placeJoints(const RigInput& input, const SkeletonTemplate& body_plan, const Silhouette& silhouette,
                 bool guesses_stay, Recognition& found) {
  std::vector<Joint>& joints = found.skeleton.joints;
  std::vector<bool> known;
  for (const Joint& joint : joints)
    known.push_back(joint.origin == JointOrigin::kRecognized ||
                    (guesses_stay && joint.origin == JointOrigin::kCompleted));
  std::vector<int> placed;
  for (const auto& [name, image] : input.placed) {
    placed.push_back(found.skeleton.find(name));
    if (placed.back() < 0)
      throw UsageError("\"" + name + "\" is no joint of the template \"" + body_plan.name + "\"");
    known[std::size_t(placed.back())] = true;
    std::erase(found.missing, name);
  }
  const auto place = [&] {
    for (std::size_t i = 0; i < placed.size(); ++i)
      joints[std::size_t(placed[i])].image = input.placed[i].second;
  };
  place();
  found.confidence = markPlaced(found.skeleton, placed, found.confidence);
  completeSkeleton(found.skeleton, known, body_plan, silhouette);
  place();  // also where a joint lies on another, or outside of the figure
  markPlaced(found.skeleton, placed, found.confidence);
  found.warnings.clear();
  if (!found.missing.empty()) found.warnings.push_back(missingNote(found.missing));
}

const JointNets& jointNetsOf(const RigOptions& options) {
  return options.joint_nets ? *options.joint_nets : builtInJointNets();
}

const JointNet& jointNetOf(const RigOptions& options, const SkeletonTemplate& body_plan) {
  const JointNet* net = options.joint_net && body_plan.name == options.body_plan.name
                            ? options.joint_net.get()
                            : jointNetFor(body_plan, jointNetsOf(options));
  if (!net)
    throw UsageError(
        "no net is built in that knows the joints of the template \"" + body_plan.name +
        "\"; give a net of it (--joint-net), or recognise by the rules of the paper (--recognizer paper)");
  return *net;
}

// Another body plan that the figure fits where the one that was asked for leaves doubt.
std::optional<std::string> betterBodyPlan(const Image& image, const Silhouette& silhouette,
                                          const RigOptions& options) {
  const JointNets& nets = jointNetsOf(options);
  for (const std::string_view name : nets.bodyPlans()) {
    if (name == options.body_plan.name) continue;
    const Recognition other =
        recognizeByTree(image, silhouette, loadTemplate(std::string(name)), nets.of(name));
    if (other.likeness >= 0.5) return std::string(name);
  }
  return std::nullopt;
}

// How far a figure is turned in the drawing: as was found, but not if its joints, which somebody may have
// placed since, say that it stands there and would be turned upside down.
int turnedAs(const Skeleton& skeleton, int found_deg) {
  constexpr double kStands = 0.7;  // cosine of the lean
  const int neck = skeleton.find("neck");
  if (neck < 0) return found_deg;
  const Eigen::Vector2d trunk = skeleton.joints[std::size_t(neck)].image - skeleton.joints[0].image;
  const Eigen::Vector2d upright = Eigen::Rotation2Dd(-found_deg * std::numbers::pi / 180) * trunk;
  const double least = kStands * trunk.norm();
  return -trunk.y() > least && upright.y() > least ? 0 : found_deg;
}

// By the net of the body plan, or of the other one where the first leaves doubt and the other less.
FoundJoints recognizeByNet(const RigOptions& options, const Image& image, const Silhouette& silhouette) {
  constexpr double kSure = .8, kFits = .5, kMayFit = .1;
  TreeRecognizerOptions recognizer;
  recognizer.try_orientations = !options.upright;
  const auto recognize = [&](const SkeletonTemplate& body_plan) {
    return recognizeByTree(image, silhouette, body_plan, jointNetOf(options, body_plan), recognizer);
  };
  Recognition found = recognize(options.body_plan);
  if (options.otherwise) {
    if (found.likeness >= kSure) return {std::move(found), options.body_plan};
    Recognition other = recognize(options.otherwise->body_plan);
    if (other.likeness < kMayFit || other.likeness <= found.likeness)
      return {std::move(found), options.body_plan};
    return {std::move(other), options.otherwise->body_plan};
  }
  if (found.likeness < kFits)
    if (const auto better = betterBodyPlan(image, silhouette, options))
      found.warnings.push_back("it looks like a " + *better + ": try --template " + *better);
  return {std::move(found), options.body_plan};
}

Image picture(const Plane8& mask) {
  Image image(static_cast<int>(mask.cols()), static_cast<int>(mask.rows()));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      std::fill_n(image.pixel(x, y), 4, static_cast<std::uint8_t>(mask(y, x) ? 150 : 255));
  image.rgba.col(3).setConstant(255);
  return image;
}

// The disc around the head joint that touches the outline first.
std::optional<HeadDisc> headDisc(const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                                 const Silhouette& silhouette, double turned_rad) {
  if (body_plan.head < 0) return std::nullopt;
  const int head = skeleton.find(body_plan.joints[static_cast<size_t>(body_plan.head)].name);
  if (head < 0) return std::nullopt;
  const Eigen::Vector2d& center = skeleton.joints[static_cast<size_t>(head)].image;
  return HeadDisc{center, distanceToOutline(silhouette.outline, center),
                  Eigen::Rotation2Dd(turned_rad) * Eigen::Vector2d(0, -1)};
}

// As a person has said, or as somebody on two legs is seen to look.
std::optional<Facing> facingIn(const RiggedDrawing& drawing, const RigOptions& options, bool inflated) {
  if (options.facing_rad) return Facing::at(*options.facing_rad);
  if (!inflated || drawing.body_plan.from_side) return std::nullopt;
  const std::optional<FacingEvidence> evidence =
      facingEvidence(drawing.recognition.skeleton, drawing.silhouette,
                     drawing.recognition.turned_deg * std::numbers::pi / 180);
  return evidence ? std::optional(builtInFacingNet().of(*evidence)) : std::nullopt;
}

// Who is drawn from the side shows the same on the other.
Back backOf(const RiggedDrawing& drawing) {
  constexpr double kSide = 0.9;  // of the way from the viewer to the side
  const std::optional<Facing>& facing = drawing.character.facing;
  return drawing.body_plan.from_side || (facing && std::abs(std::sin(facing->yaw_rad)) > kSide)
             ? Back::kSame
             : Back::kPlain;
}

InflateOptions inflateOptions(const RigInput& input, const RiggedDrawing& drawing, const RigOptions& options,
                              const std::vector<FigurePiece>& pieces) {
  InflateOptions inflate = options.inflate;
  inflate.back = options.back ? *options.back : backOf(drawing);
  if (options.height_m > 0)
    inflate.height_m = options.height_m;
  else
    inflate.length_m = drawing.body_plan.length_m;
  inflate.turned_rad = drawing.recognition.turned_deg * std::numbers::pi / 180;
  std::vector<int> cut;
  for (const FigurePiece& piece : pieces) cut.push_back(piece.layer);
  inflate.body = bodyDepth(drawing.recognition.skeleton, drawing.body_plan, drawing.silhouette,
                           drawing.layers.far, cut, drawing.layers.part);
  inflate.head =
      headDisc(drawing.recognition.skeleton, drawing.body_plan, drawing.silhouette, inflate.turned_rad);
  if (input.back) {
    SilhouetteOptions silhouette;
    silhouette.page_net = options.silhouette.page_net;
    const Silhouette behind = extractSilhouette(input.back->image, silhouette);
    if (!behind.found()) throw InputError(input.back->file, behind.reason);
    inflate.back_picture = std::make_shared<const BackPicture>(BackPicture{input.back->image, behind.mask});
  }
  return inflate;
}

// A shoe reaches further before the ankle than behind it.
void putAnklesBelowKnees(Skeleton& skeleton, const SkeletonTemplate& body_plan) {
  if (body_plan.from_side) return;
  for (const TemplateLimb& limb : body_plan.limbs) {
    if (limb.limb_class != JointClass::kLeg) continue;
    const auto joint = [&](int i) {
      return skeleton.find(body_plan.joints[std::size_t(limb.joints[std::size_t(i)])].name);
    };
    if (const int knee = joint(1), foot = joint(2); knee >= 0 && foot >= 0)
      skeleton.joints[std::size_t(foot)].position.z() = skeleton.joints[std::size_t(knee)].position.z();
  }
}

// The clips as this figure can do them.
std::vector<Clip> clipsOf(const RiggedCharacter& character, const std::vector<Clip>& clips,
                          const FigureShape& shape, const RigOptions& options) {
  RetargetOptions retarget;
  retarget.into_picture = options.into_picture;
  retarget.shape = shape;
  std::vector<Clip> result;
  for (const Clip& clip : clips) result.push_back(retargetToRest(clip, character.skeleton, retarget));
  return result;
}

// Weights that clips do not stretch far. Those are the same whatever is asked for: the clips that come with
// skel decide.
BoundSkin boundSkin(const RiggedCharacter& character, const SkeletonTemplate& body_plan,
                    const RigOptions& options) {
  BoundSkin skin;
  skin.own = clipsFor(builtinClips(), body_plan);
  SkinWeights weights = character.weights;
  StretchBound stretch;
  do {
    for (const HeldArm& arm : stretch.uprooted) holdArm(character.mesh, character.skeleton, arm, weights);
    skin.weights = weights;
    skin.shape = measureFigure(character.mesh, weights, character.skeleton, character.facing);
    skin.own_fitted = clipsOf(character, skin.own, skin.shape, options);
    stretch = boundStretch(character.mesh, character.skeleton, skin.own_fitted, options.skin.max_influences,
                           skin.weights);
  } while (!stretch.uprooted.empty());
  return skin;
}

}  // namespace

const SkeletonTemplate& planNamed(std::string_view name, const RigOptions& options) {
  const bool other = options.otherwise && name == options.otherwise->body_plan.name;
  return other ? options.otherwise->body_plan : options.body_plan;
}

namespace {

RiggedDrawing runStages(RigInput input, const RigOptions& options, RigMemory* memory, LastStage last,
                        bool draft) {
  using M = RigMemory;
  RiggedDrawing drawing;
  drawing.body_plan = options.body_plan;
  StageRunner stage(drawing.times, memory);

  const bool inflated = !input.model;
  if (input.model) standUpright(*input.model);
  const bool own_view = input.image.empty();
  if (own_view) {
    if (!input.model)
      throw InputError(input.file.empty() ? "the input" : input.file, "has neither a picture nor a model");
    FrontView view = stage("front view", &M::front_view, {stage.of(RigPart::kModel)},
                           [&] { return frontSilhouette(*input.model); });
    input.model->model_from_image = view.model_from_image;
    input.image = picture(view.mask);
    input.mask = std::move(view.mask);
  }
  const Change image_change = own_view ? stage.of(&M::front_view) : stage.of(RigPart::kImage);
  const Change mask_change = own_view ? stage.of(&M::front_view) : stage.of(RigPart::kMask);

  drawing.silhouette = stage(
      "silhouette", &M::silhouette, {image_change, mask_change, stage.of(RigPart::kSilhouetteOptions)}, [&] {
        if (input.mask) return silhouetteFromMask(*input.mask, input.image, options.silhouette);
        return input.figures ? input.figures->take(input.image, options.silhouette.figure)
                             : extractSilhouette(input.image, options.silhouette);
      });
  drawing.image = std::move(input.image);
  if (!drawing.found()) return drawing;
  if (const auto doubt = silhouetteDoubt(drawing.silhouette, builtInSilhouetteConfidence()))
    drawing.silhouette.warnings.push_back(*doubt + ": look at the mask (skel-label FILE)");
  const Silhouette& silhouette = drawing.silhouette;
  if (needsPaper(drawing.image, silhouette.mask)) drawing.image = laidOnPaper(std::move(drawing.image));
  // Of the figure as it is drawn: picture and silhouette.
  const auto figureAnd = [&](std::vector<Change> others) {
    others.push_back(image_change), others.push_back(stage.of(&M::silhouette));
    return others;
  };

  if (last == LastStage::kSilhouette) return drawing;

  if (inflated)
    drawing.even_light = stage("even light", &M::even_light, figureAnd({}),
                               [&] { return evenLight(drawing.image, silhouette); });
  drawing.candidates =
      stage("candidates", &M::candidates, {stage.of(&M::silhouette), stage.of(RigPart::kCandidateOptions)},
            [&] { return extractCandidates(silhouette, options.candidates); });
  drawing.features = stage("features", [&] { return features(drawing.candidates); });
  drawing.classes = stage("classes", [&] { return classify(options.mlp, drawing.features); });
  if (last == LastStage::kClasses) return drawing;

  FoundJoints joints;
  if (input.skeleton) {
    joints.body_plan = planNamed(input.skeleton->template_name, options);
    joints.recognition.skeleton = *input.skeleton;
    joints.recognition.likeness = 1;  // as whoever hands it in says
    joints.recognition.turned_deg = options.upright ? 0 : input.turned_deg;
  } else {
    joints = stage("recognition", &M::recognized,
                   figureAnd({stage.of(RigPart::kRecognitionOptions), stage.of(&M::candidates)}), [&] {
                     if (options.recognizer == Recognizer::kPaper)
                       return FoundJoints{recognizeByRules(silhouette, drawing.candidates, drawing.classes,
                                                           options.body_plan),
                                          options.body_plan};
                     return recognizeByNet(options, drawing.image, silhouette);
                   });
  }
  drawing.body_plan = std::move(joints.body_plan);
  drawing.recognition = std::move(joints.recognition);
  const SkeletonTemplate& body_plan = drawing.body_plan;
  if (!input.placed.empty())
    placeJoints(input, body_plan, silhouette, options.recognizer == Recognizer::kTree, drawing.recognition);
  if (input.skeleton || !input.placed.empty())
    drawing.recognition.turned_deg = turnedAs(drawing.recognition.skeleton, drawing.recognition.turned_deg);
  roundToFile(drawing.recognition.skeleton);
  drawing.character.skeleton = drawing.recognition.skeleton;
  if (last == LastStage::kJoints) return drawing;
  // Of the joints in the picture, and so of whatever they depend on.
  const auto jointsAnd = [&](std::vector<Change> others) {
    others.insert(others.end(), {input.skeleton ? 0 : stage.of(&M::recognized), stage.of(RigPart::kSkeleton),
                                 stage.of(RigPart::kRecognitionOptions)});
    return figureAnd(std::move(others));
  };

  const std::vector<Clip>& asked_clips =
      body_plan.name == options.body_plan.name ? options.clips : options.otherwise->clips;
  const Skeleton& skeleton = drawing.recognition.skeleton;
  std::vector<FigurePiece> pieces;
  if (inflated && options.layers) {
    const auto find = [&] {
      LayerMap found = findLayers(drawing.image, silhouette, skeleton, body_plan,
                                  options.part_net ? *options.part_net : builtInPartNet());
      // Only the net's confidence tells a guess.
      if (options.recognizer == Recognizer::kPaper && !found.hands_linked) found.hidden.clear();
      if (!options.cut_limbs) found = inOnePiece(std::move(found), body_plan);
      return found;
    };
    drawing.layers = draft ? memory->layers.value
                           : stage("layers", &M::layers, jointsAnd({stage.of(RigPart::kLayerOptions)}), find);
    if (input.layers) {
      LayerMap given = layersOfPicture(input.layers->image, silhouette, body_plan, input.layers->file);
      const auto keep = [&](const std::vector<int>& limbs, std::vector<int>& kept) {
        for (const int limb : limbs)
          if (!given.has(limb)) kept.push_back(limb);
      };
      keep(drawing.layers.hidden, given.hidden);
      keep(drawing.layers.at_rest, given.at_rest);
      given.hands_linked = drawing.layers.hands_linked && given.hidden.size() == drawing.layers.hidden.size();
      given.far = std::move(drawing.layers.far);
      drawing.found_limbs = std::move(drawing.layers.limb);
      drawing.layers = std::move(given);
    }
    if (last == LastStage::kLayers) return drawing;
    const auto cut = [&] { return figurePieces(drawing.layers, silhouette, skeleton, body_plan); };
    pieces = draft ? memory->pieces.value
                   : stage("pieces", &M::pieces,
                           jointsAnd({stage.of(RigPart::kLayers), stage.of(&M::layers)}), cut);
  }
  if (last == LastStage::kLayers) return drawing;
  const std::optional<Facing> facing = facingIn(drawing, options, inflated);
  drawing.character.facing = facing;
  const std::vector<Change> mesh_of =
      jointsAnd({stage.of(RigPart::kModel), stage.of(RigPart::kBack), stage.of(RigPart::kMeshOptions),
                 stage.of(RigPart::kLayerOptions), stage.of(RigPart::kLayers)});
  const auto makeMesh = [&] {
    if (!input.model)
      return inflate(drawing.colors(), silhouette, inflateOptions(input, drawing, options, pieces), pieces);
    if (!own_view) input.model->model_from_image = bindByBoundingBox(silhouette.mask, *input.model);
    return std::move(*input.model);
  };
  drawing.character.mesh = draft ? memory->mesh.value : stage("mesh", &M::mesh, mesh_of, makeMesh);
  std::vector<int> joint_layers;
  if (!pieces.empty() || !drawing.layers.hidden.empty())
    joint_layers = jointLayers(skeleton, body_plan, drawing.character.mesh, drawing.layers);
  drawing.recognition.skeleton = stage("lift", [&] {
    Skeleton lifted = drawing.recognition.skeleton;
    liftToModel(lifted, drawing.character.mesh, joint_layers);
    if (inflated) putAnklesBelowKnees(lifted, body_plan);
    return lifted;
  });
  drawing.character.skeleton = drawing.recognition.skeleton;
  if (!facing && inflated && body_plan.from_side)
    drawing.character.facing = Facing::at(skel::facing(drawing.character));
  const auto bind = [&] {
    TriangleMesh& mesh = drawing.character.mesh;
    Skinned skinned{{}, drawing.character.skeleton, {}};
    skinned.weights =
        computeSkinWeights(mesh, skinned.skeleton, options.skin_method, options.skin, joint_layers);
    if (inflated) {
      foldArms(skinned.skeleton, body_plan, skinned.weights);
      carryWornParts(mesh, body_plan, drawing.layers, skinned.skeleton, skinned.weights);
      partLimbsInDepth(mesh, skinned.skeleton, skinned.weights, body_plan, facing.value_or(Facing()).yaw_rad,
                       drawing.layers.far);
    }
    skinned.vertices = mesh.vertices;
    return skinned;
  };
  Skinned skinned =
      draft ? stage("skin", bind)
            : stage("skin", &M::skinned, {stage.of(&M::mesh), stage.of(RigPart::kSkinOptions)}, bind);
  drawing.character.mesh.vertices = std::move(skinned.vertices);
  drawing.character.skeleton = std::move(skinned.skeleton);
  drawing.character.weights = std::move(skinned.weights);
  if (inflated) drawing.recognition.skeleton = withoutHanging(drawing.character.skeleton);
  if (options.rest_pose != RestPose::kDrawn)
    drawing.character = stage("rest pose", [&] { return poseToRest(drawing.character, options.rest_pose); });
  if (last == LastStage::kModel) return drawing;
  std::optional<BoundSkin> bound;
  if (inflated && !draft) {
    bound = stage("stretch", &M::bound,
                  {stage.of(&M::skinned), stage.of(RigPart::kRestPose), stage.of(RigPart::kRetargetOptions)},
                  [&] { return boundSkin(drawing.character, body_plan, options); });
    drawing.character.weights = std::move(bound->weights);
  }
  drawing.clips = stage("clips", [&] {
    if (asked_clips.empty()) return std::vector<Clip>();
    if (bound && asked_clips == bound->own) return std::move(bound->own_fitted);
    const RiggedCharacter& character = drawing.character;
    return clipsOf(
        character, asked_clips,
        bound ? bound->shape
              : measureFigure(character.mesh, character.weights, character.skeleton, character.facing),
        options);
  });
  return drawing;
}

}  // namespace

RiggedDrawing rigCharacter(RigInput input, const RigOptions& options) {
  return rigCharacter(std::move(input), options, nullptr, options.last, false);
}

RiggedDrawing rigCharacter(RigInput input, const RigOptions& options, RigMemory* memory, LastStage last,
                           bool draft) {
  const std::string file = input.file;
  return throwingErrors(file, [&] {
    checkRig(input, options);
    return runStages(std::move(input), options, memory, last, draft);
  });
}

}  // namespace skel
