#include "libskel/pipeline/rig_character.h"

#include <algorithm>
#include <chrono>
#include <numbers>

#include "libskel/animation/clip_library.h"
#include "libskel/animation/retarget.h"
#include "libskel/classifier/features.h"
#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/deform/bound_stretch.h"
#include "libskel/deform/figure_shape.h"
#include "libskel/deform/limb_depth.h"
#include "libskel/jointnet/net_joints.h"
#include "libskel/mesh/front_view.h"
#include "libskel/pipeline/body_depth.h"
#include "libskel/pipeline/limb_roots.h"
#include "libskel/pipeline/worn_parts.h"
#include "libskel/recognition/complete_skeleton.h"
#include "libskel/recognition/paper_recognizer.h"
#include "libskel/recognition/silhouette_confidence.h"
#include "libskel/recognition/tree_recognition.h"
#include "libskel/silhouette/line_art.h"
#include "libskel/silhouette/outline.h"
#include "libskel/skeleton/hanging.h"
#include "libskel/skeleton/lift.h"

namespace skel {
namespace {

// Runs the stages and notes how long each took.
class Stopwatch {
 public:
  explicit Stopwatch(std::vector<StageTime>& times) : times_(times) {}

  template <class Work>
  auto operator()(const char* stage, const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    auto result = work();
    times_.push_back(
        {stage, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
    return result;
  }

 private:
  std::vector<StageTime>& times_;
};

// To the hundredth of a pixel that a skeleton file keeps, so that to go on from the file is to go on from
// here.
void roundToFile(Skeleton& skeleton) {
  for (Joint& joint : skeleton.joints) joint.image = (joint.image * 100).array().round() / 100;
}

// Those that follow from others, or were a guess, follow them. What was said of the joints before is stale.
void placeJoints(const RigInput& input, const SkeletonTemplate& body_plan, const Silhouette& silhouette,
                 Recognition& found) {
  std::vector<bool> known;
  for (const Joint& joint : found.skeleton.joints) known.push_back(joint.origin == JointOrigin::kRecognized);
  const auto place = [&] {
    for (const auto& [name, image] : input.placed) {
      const int index = found.skeleton.find(name);
      if (index < 0)
        throw UsageError("\"" + name + "\" is no joint of the template \"" + body_plan.name + "\"");
      Joint& joint = found.skeleton.joints[std::size_t(index)];
      joint.image = image;
      joint.confidence = 1;
      joint.origin = JointOrigin::kEdited;
      known[std::size_t(index)] = true;
      std::erase(found.missing, name);
    }
  };
  place();
  completeSkeleton(found.skeleton, known, body_plan, silhouette);
  place();  // also where a joint lies on another, or outside of the figure
  found.warnings.clear();
}

const JointNets& jointNetsOf(const RigOptions& options) {
  return options.joint_nets ? *options.joint_nets : builtInJointNets();
}

const JointNet& jointNetOf(const RigOptions& options, const SkeletonTemplate& body_plan) {
  const JointNet* net = options.joint_net && body_plan.name == options.body_plan.name
                            ? options.joint_net.get()
                            : jointNetFor(body_plan, jointNetsOf(options));
  if (!net)
    throw UsageError("no net is built in that knows the joints of the template \"" + body_plan.name +
                     "\"; name one by --joint-net, or use --recognizer paper");
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

// By the net of the body plan, or of the other one where the first leaves doubt and the other hardly any.
// Fills drawing.body_plan, too.
Recognition recognizeByNet(const RigOptions& options, RiggedDrawing& drawing) {
  constexpr double kSure = .8, kFits = .5;
  TreeRecognizerOptions recognizer;
  recognizer.try_orientations = !options.upright;
  const auto recognize = [&](const SkeletonTemplate& body_plan) {
    return recognizeByTree(drawing.image, drawing.silhouette, body_plan, jointNetOf(options, body_plan),
                           recognizer);
  };
  Recognition found = recognize(options.body_plan);
  if (options.otherwise) {
    if (found.likeness >= kSure) return found;
    Recognition other = recognize(options.otherwise->body_plan);
    if (other.likeness < kFits || other.likeness <= found.likeness) return found;
    drawing.body_plan = options.otherwise->body_plan;
    return other;
  }
  if (found.likeness < kFits)
    if (const auto better = betterBodyPlan(drawing.image, drawing.silhouette, options))
      found.warnings.push_back("it looks like a " + *better + ": try --template " + *better);
  return found;
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

InflateOptions inflateOptions(const RigInput& input, const RiggedDrawing& drawing,
                              const RigOptions& options) {
  InflateOptions inflate = options.inflate;
  inflate.back = options.back.value_or(drawing.body_plan.from_side ? Back::kSame : Back::kPlain);
  if (options.height_m > 0)
    inflate.height_m = options.height_m;
  else
    inflate.length_m = drawing.body_plan.length_m;
  inflate.turned_rad = drawing.recognition.turned_deg * std::numbers::pi / 180;
  inflate.body = bodyDepth(drawing.recognition.skeleton, drawing.body_plan, drawing.silhouette);
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

// The clips that were asked for, as this figure can do them, and weights that they do not stretch far. Those
// are the same whatever is asked for: the clips that come with skel decide.
std::vector<Clip> fitClips(const std::vector<Clip>& asked, const RigOptions& options,
                           const SkeletonTemplate& body_plan, bool bound, RiggedCharacter& character) {
  RetargetOptions retarget;
  retarget.into_picture = options.into_picture;
  const auto made = [&](const std::vector<Clip>& clips) {
    retarget.shape = measureFigure(character.mesh, character.weights, character.skeleton);
    std::vector<Clip> result;
    for (const Clip& clip : clips) result.push_back(retargetToRest(clip, character.skeleton, retarget));
    return result;
  };
  if (!bound) return made(asked);
  const std::vector<Clip> own = clipsFor(builtinClips(), body_plan), trying = made(own);
  const StretchBound stretch =
      boundStretch(character.mesh, character.skeleton, retarget.shape->joined, trying, character.weights);
  if (asked == own && !stretch.held_arms) return trying;
  return made(asked);
}

}  // namespace

const SkeletonTemplate& planNamed(std::string_view name, const RigOptions& options) {
  const bool other = options.otherwise && name == options.otherwise->body_plan.name;
  return other ? options.otherwise->body_plan : options.body_plan;
}

RiggedDrawing rigCharacter(RigInput input, const RigOptions& options) {
  RiggedDrawing drawing;
  drawing.body_plan = options.body_plan;
  Stopwatch timed(drawing.times);

  const bool inflated = !input.model;
  if (input.model) standUpright(*input.model);
  const bool own_view = input.image.empty();
  if (own_view) {
    SKEL_CHECK(input.model);
    FrontView view = timed("front view", [&] { return frontSilhouette(*input.model); });
    input.model->model_from_image = view.model_from_image;
    input.image = picture(view.mask);
    input.mask = std::move(view.mask);
  }
  drawing.image = std::move(input.image);

  drawing.silhouette = timed("silhouette", [&] {
    if (input.mask) return silhouetteFromMask(*input.mask, options.silhouette);
    return input.figures ? input.figures->take(drawing.image, options.silhouette.figure)
                         : extractSilhouette(drawing.image, options.silhouette);
  });
  if (!drawing.found()) return drawing;
  if (const auto doubt = silhouetteDoubt(drawing.silhouette, builtInSilhouetteConfidence()))
    drawing.silhouette.warnings.push_back(*doubt + ": look at the mask (skel-label FILE)");
  const Silhouette& silhouette = drawing.silhouette;
  if (needsPaper(drawing.image, silhouette.mask)) drawing.image = laidOnPaper(std::move(drawing.image));

  drawing.candidates = timed("candidates", [&] { return extractCandidates(silhouette, options.candidates); });
  drawing.features = timed("features", [&] { return features(drawing.candidates); });
  drawing.classes = timed("classes", [&] { return classify(options.mlp, drawing.features); });

  drawing.recognition = timed("recognition", [&] {
    Recognition found;
    if (input.skeleton) {
      drawing.body_plan = planNamed(input.skeleton->template_name, options);
      found.skeleton = *input.skeleton;
      found.likeness = 1;  // as whoever hands it in says
      found.turned_deg = input.turned_deg;
    } else if (options.recognizer == Recognizer::kPaper) {
      found = recognizeByRules(silhouette, drawing.candidates, drawing.classes, options.body_plan);
    } else {
      found = recognizeByNet(options, drawing);
    }
    if (!input.placed.empty()) placeJoints(input, drawing.body_plan, silhouette, found);
    return found;
  });
  roundToFile(drawing.recognition.skeleton);

  const SkeletonTemplate& body_plan = drawing.body_plan;
  const std::vector<Clip>& asked_clips =
      body_plan.name == options.body_plan.name ? options.clips : options.otherwise->clips;
  const Skeleton& skeleton = drawing.recognition.skeleton;
  std::vector<FigurePiece> pieces;
  if (inflated && options.layers) {
    drawing.layers = timed("layers", [&] {
      LayerMap found = findLayers(drawing.image, silhouette, skeleton, body_plan,
                                  options.part_net ? *options.part_net : builtInPartNet());
      // Only the net's confidence tells a guess.
      if (options.recognizer == Recognizer::kPaper) found.hidden.clear();
      if (!input.layers) return found;
      LayerMap given = layersOfPicture(input.layers->image, silhouette, body_plan, input.layers->file);
      for (const int limb : found.hidden)
        if (!(given.limb == limb).any()) given.hidden.push_back(limb);
      given.far = std::move(found.far);
      return given;
    });
    pieces = timed("pieces", [&] { return figurePieces(drawing.layers, silhouette, skeleton, body_plan); });
  }
  drawing.character.mesh = timed("mesh", [&] {
    if (!input.model)
      return inflate(drawing.image, silhouette, inflateOptions(input, drawing, options), pieces);
    if (!own_view) input.model->model_from_image = bindByBoundingBox(silhouette.mask, *input.model);
    return std::move(*input.model);
  });
  std::vector<int> joint_layers;
  if (!pieces.empty() || !drawing.layers.hidden.empty())
    joint_layers = jointLayers(skeleton, body_plan, drawing.character.mesh, drawing.layers);
  drawing.recognition.skeleton = timed("lift", [&] {
    Skeleton lifted = drawing.recognition.skeleton;
    liftToModel(lifted, drawing.character.mesh, joint_layers);
    if (inflated) putAnklesBelowKnees(lifted, body_plan);
    return lifted;
  });
  drawing.character.skeleton = drawing.recognition.skeleton;
  drawing.character.weights = timed("skin", [&] {
    SkinWeights weights = computeSkinWeights(drawing.character.mesh, drawing.character.skeleton,
                                             options.skin_method, options.skin, joint_layers);
    if (inflated) {
      tieLimbRoots(drawing.character.mesh, body_plan, pieces, drawing.layers, drawing.character.skeleton,
                   weights);
      carryWornParts(drawing.character.mesh, body_plan, drawing.layers, drawing.character.skeleton, weights);
    }
    return weights;
  });
  if (inflated) {
    drawing.character = timed("depth", [&] {
      RiggedCharacter parted = std::move(drawing.character);
      const double yaw_rad = measureFigure(parted.mesh, parted.weights, parted.skeleton).yaw_rad;
      partLimbsInDepth(parted.mesh, parted.skeleton, parted.weights, body_plan, yaw_rad, drawing.layers.far);
      return parted;
    });
    drawing.recognition.skeleton = withoutHanging(drawing.character.skeleton);
  }
  if (options.rest_pose != RestPose::kDrawn)
    drawing.character = timed("rest pose", [&] { return poseToRest(drawing.character, options.rest_pose); });
  drawing.clips =
      timed("clips", [&] { return fitClips(asked_clips, options, body_plan, inflated, drawing.character); });
  return drawing;
}

}  // namespace skel
