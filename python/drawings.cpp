#include <map>

#include "libskel/animation/clip_library.h"
#include "libskel/classifier/features.h"
#include "libskel/core/files.h"
#include "libskel/image/check_image.h"
#include "libskel/image/read_image.h"
#include "libskel/import/read_character.h"
#include "libskel/pipeline/rig_drawing.h"
#include "python/bindings.h"

namespace skel::python {
namespace {

// A character, and what was found out about the drawing that it comes from.
struct Drawing : Character {
  RiggedDrawing found;  // without character and clips
  RigOptions options;
};

constexpr double kMostFigures = 1e6;

template <class Value>
Value chosen(const std::string& option, const std::string& name, const std::map<std::string, Value>& values) {
  const auto found = values.find(name);
  if (found != values.end()) return found->second;
  std::string names;
  for (const auto& [text, value] : values) names += (names.empty() ? "" : ", ") + text;
  throw UsageError(option + ": \"" + name + "\" is none of " + names);
}

SkinMethod skinNamed(const std::string& name) {
  std::map<std::string, SkinMethod> methods;
  for (const SkinMethod method : skinMethods()) methods.emplace(skinMethodName(method), method);
  return chosen("skin", name, methods);
}

constexpr const char* kPictureOrArray = "the path of a file, or an array";

Image pictureOf(const py::object& image) {
  if (py::isinstance<py::array>(image)) return imageOf(image, "image");
  const std::string path = pathOf(image, "image", kPictureOrArray);
  return unlocked(path, [&] { return readImage(path); });
}

// What the picture is called, and its path among `sources` if it is a file's.
std::string sourceOf(const py::object& image, std::vector<std::string>& sources, const char* name) {
  if (image.is_none() || py::isinstance<py::array>(image)) return name;
  std::string path = pathOf(image, name, kPictureOrArray);
  std::error_code failure;
  sources.push_back(std::filesystem::absolute(path, failure).string());
  return path;
}

Plane8 figureOf(const py::object& mask, const Image& image) {
  const bool array = py::isinstance<py::array>(mask);
  const std::string name = array ? "mask" : pathOf(mask, "mask", kPictureOrArray);
  Plane8 plane = array ? maskOf(mask, name) : unlocked(name, [&] { return readMask(name); });
  if (plane.rows() != image.height || plane.cols() != image.width)
    throw InputError(name, "has " + sizeInPx(plane.cols(), plane.rows()) + " px, the drawing " +
                               sizeInPx(image.width, image.height));
  return plane;
}

std::shared_ptr<Drawing> rigged(RigInput input, const RigOptions& options, const std::string& source,
                                const std::vector<std::string>& sources) {
  return unlocked(source, [&] {
    auto drawing = std::make_shared<Drawing>();
    input.file = source;
    drawing->found = rigCharacter(std::move(input), options);
    if (!drawing->found.found()) throw InputError(source, drawing->found.silhouette.reason);
    drawing->options = options;
    drawing->character = std::move(drawing->found.character);
    drawing->clips = std::make_shared<const std::vector<Clip>>(std::move(drawing->found.clips));
    drawing->name = "character";
    drawing->drawn = true;
    drawing->sources = sources;
    return drawing;
  });
}

std::shared_ptr<Drawing> rig(const py::object& image, const py::object& mask, const std::string& body_plan,
                             std::int64_t figure, const std::optional<WeightsFile>& net,
                             const py::object& joint_net, const std::string& recognizer,
                             const std::string& skin, std::int64_t max_influences,
                             const std::string& rest_pose, double into_picture, double height_m, bool layers,
                             bool upright, bool clips) {
  RigOptions options = clips ? rigOptions(body_plan) : rigOptionsWithoutClips(body_plan);
  checkRange("figure", double(figure), 1, kMostFigures);
  checkRange("max_influences", double(max_influences), 1, 4);
  checkRange("into_picture", into_picture, 0, 1);
  if (height_m != 0) checkRange("height_m", height_m, 0.001, 1000);
  options.silhouette.figure = int(figure);
  if (net) options.mlp = net->mlp;
  std::vector<std::string> sources;
  if (!joint_net.is_none()) {
    const std::string path = pathOf(joint_net, "joint_net");
    options.joint_net = std::make_shared<const JointNet>(readyToRun(parseJointNet(readFile(path), path)));
    sourceOf(joint_net, sources, "joint_net");
  }
  options.recognizer = chosen<Recognizer>("recognizer", recognizer,
                                          {{"paper", Recognizer::kPaper}, {"tree", Recognizer::kTree}});
  options.silhouette.fill_holes = options.recognizer == Recognizer::kPaper;
  options.skin_method = skinNamed(skin);
  options.skin.max_influences = int(max_influences);
  options.rest_pose = chosen<RestPose>(
      "rest_pose", rest_pose, {{"drawn", RestPose::kDrawn}, {"A", RestPose::kA}, {"T", RestPose::kT}});
  options.into_picture = into_picture;
  options.height_m = height_m;
  options.layers = layers;
  options.upright = upright;
  RigInput input;
  input.image = pictureOf(image);
  if (!mask.is_none()) input.mask = figureOf(mask, input.image);
  const std::string source = sourceOf(image, sources, "image");
  sourceOf(mask, sources, "mask");
  sourceOf(py::str(body_plan), sources, "body_plan");
  return rigged(std::move(input), options, source, sources);
}

std::shared_ptr<Drawing> withJoints(const Drawing& drawing, const py::object& places) {
  RigInput input;
  input.image = drawing.found.image;
  input.mask = drawing.found.silhouette.mask;
  input.skeleton = drawing.found.recognition.skeleton;
  input.turned_deg = drawing.found.recognition.turned_deg;
  for (const auto& [name, numbers] : namedIn(places, "joints")) {
    const std::vector<double> xy = numbersIn(numbers, 2, "joints: \"" + name + "\"");
    const Eigen::Vector2d place(xy[0], xy[1]);
    const int joint = input.skeleton->find(name);
    if (joint < 0) throw UsageError("joints: the skeleton has no \"" + name + "\"");
    if (!(place.x() >= 0 && place.y() >= 0 && place.x() < input.image.width &&
          place.y() < input.image.height))
      throw UsageError("joints: \"" + name + "\" lies outside the drawing");
    Joint& moved = input.skeleton->joints[std::size_t(joint)];
    moved.image = place;
    moved.origin = JointOrigin::kEdited;
    moved.confidence = 1;
  }
  RigOptions options = drawing.options;
  const SkeletonTemplate& plan = drawing.found.body_plan;
  if (options.otherwise && options.otherwise->body_plan.name == plan.name) {
    options.body_plan = options.otherwise->body_plan;
    options.clips = options.otherwise->clips;
  }
  options.otherwise.reset();
  options.silhouette.figure = 1;  // of the mask, which has no other
  return rigged(std::move(input), options, "image", drawing.sources);
}

// Where joints may be, in image px, and how thick the figure is there.
struct FoundCandidates {
  Eigen::MatrixX2d points;
  Eigen::VectorXd radii;
  Features features;
  std::vector<int> kept;
};

FoundCandidates candidatesOf(const Silhouette& silhouette, const CandidateSet& set,
                             const Features& features) {
  FoundCandidates found{
      {Eigen::Index(set.maxima.size()), 2}, Eigen::VectorXd(set.maxima.size()), features, set.kept};
  for (Eigen::Index i = 0; i < found.radii.size(); ++i) {
    const JointCandidate& candidate = set.maxima[std::size_t(i)];
    found.points.row(i) = silhouette.grid.imageFromGrid({candidate.x, candidate.y});
    found.radii(i) = candidate.radius / silhouette.grid.scale;
  }
  return found;
}

FoundCandidates candidates(const py::object& image, const py::object& mask, std::int64_t figure,
                           const std::string& method) {
  const Image picture = pictureOf(image);
  std::optional<Plane8> given;
  if (!mask.is_none()) given = figureOf(mask, picture);
  checkRange("figure", double(figure), 1, kMostFigures);
  const CandidateOptions options{chosen<CandidateMethod>("method", method,
                                                         {{"maxima", CandidateMethod::kMaxima},
                                                          {"strict", CandidateMethod::kStrict},
                                                          {"discs", CandidateMethod::kDiscs}})};
  std::vector<std::string> sources;
  const std::string source = sourceOf(image, sources, "image");
  return unlocked(source, [&] {
    SilhouetteOptions wanted;
    wanted.figure = int(figure);
    const Silhouette silhouette =
        given ? silhouetteFromMask(*given, picture, wanted) : extractSilhouette(picture, wanted);
    if (!silhouette.found()) throw InputError(source, silhouette.reason);
    const CandidateSet set = extractCandidates(silhouette, options);
    return candidatesOf(silhouette, set, features(set));
  });
}

}  // namespace

void bindDrawings(py::module_& module) {
  py::class_<FoundCandidates>(module, "Candidates",
                              "Where joints may be: where the distance to the outline is greatest.")
      .def_readonly("points", &FoundCandidates::points, "(N, 2) float64: image px, +y down; thickest first.")
      .def_readonly("radii", &FoundCandidates::radii, "(N,) float64: distance to the outline, image px.")
      .def_property_readonly(
          "features", [](const FoundCandidates& f) { return f.features; },
          "(N, 3) float32: x, y and radius, each from 0 to 1 over this figure.")
      .def_readonly("kept", &FoundCandidates::kept, "Indices of those that lie in no disc of a thicker one.")
      .def("__len__", [](const FoundCandidates& f) { return f.radii.size(); });

  py::class_<Drawing, Character, std::shared_ptr<Drawing>>(
      module, "Drawing", "A character, and what was found out about its drawing.")
      .def_property_readonly(
          "image", [](const Drawing& d) { return arrayOf(d.found.image); },
          "(H, W, 4) uint8: sRGB and alpha.")
      .def_property_readonly(
          "mask", [](const Drawing& d) { return d.found.silhouette.mask; },
          "(H, W) uint8: 255 on the figure, else 0.")
      .def_property_readonly("candidates",
                             [](const Drawing& d) {
                               return candidatesOf(d.found.silhouette, d.found.candidates, d.found.features);
                             })
      .def_property_readonly(
          "classes", [](const Drawing& d) { return d.found.classes; },
          "(N, 4) float32: of each candidate, the probabilities of skel.CLASSES.")
      .def_property_readonly(
          "body_plan", [](const Drawing& d) { return d.found.body_plan.name; }, "biped, quadruped, ...")
      .def_property_readonly(
          "confidence", [](const Drawing& d) { return d.found.recognition.confidence; },
          "0 to 1: that this is one whole figure of the body plan, and found as it is.")
      .def_property_readonly(
          "turned_deg", [](const Drawing& d) { return d.found.recognition.turned_deg; },
          "How far the figure is turned clockwise against upright, degrees.")
      .def_property_readonly(
          "missing", [](const Drawing& d) { return d.found.recognition.missing; },
          "Names of joints that were not found.")
      .def_property_readonly(
          "warnings",
          [](const Drawing& d) {
            std::vector<std::string> all = d.found.silhouette.warnings;
            const auto& more = d.found.recognition.warnings;
            all.insert(all.end(), more.begin(), more.end());
            return all;
          },
          "A sentence each.")
      .def_property_readonly(
          "figures", [](const Drawing& d) { return d.found.silhouette.figure_count; },
          "How many the picture has.")
      .def_property_readonly(
          "times",
          [](const Drawing& d) {
            std::map<std::string, double> times;
            for (const StageTime& time : d.found.times) times[time.stage] += time.time_s;
            return times;
          },
          "How long each stage took, s.")
      .def("with_joints", &withJoints, py::arg("joints"),
           "Rigged anew with these joints, by name, at these places: (2,), image px.")
      .def("__repr__", [](const Drawing& d) {
        return "<skel.Drawing: " + d.found.body_plan.name + ", " + sizesOf(d.character) + ">";
      });

  module.def("rig", &rig, py::arg("image"), py::kw_only(), py::arg("mask") = py::none(),
             py::arg("body_plan") = "auto", py::arg("figure") = 1, py::arg("net") = py::none(),
             py::arg("joint_net") = py::none(), py::arg("recognizer") = "tree", py::arg("skin") = "geodesic",
             py::arg("max_influences") = 4, py::arg("rest_pose") = "drawn",
             py::arg("into_picture") = RetargetOptions().into_picture, py::arg("height_m") = 0.,
             py::arg("layers") = true, py::arg("upright") = false, py::arg("clips") = true,
             "From a drawing, a file or an array (H, W), (H, W, 3) or (H, W, 4) of uint8, to a rigged, "
             "animated character.\n\n"
             "mask: the figure, (H, W) of bool or uint8, not 0 on it, or a file, instead of finding it. "
             "body_plan: biped, "
             "quadruped, a file, or auto. "
             "figure: 1 is the largest. net: tells the classes of candidates. joint_net: a file. recognizer: "
             "tree or paper. skin: geodesic, "
             "heat, euclidean, idw, idw-region. rest_pose: drawn, A, T. into_picture: 0 to 1, how far limbs "
             "that point at the viewer turn "
             "into the picture. height_m: of the model, m; 0: 1.7, or 1.2 from end to end of an animal. "
             "layers: limbs over the body are "
             "bodies of their own. upright: try no other orientations. clips: with the built-in motions.\n\n"
             "Raises InputError: a file that cannot be read, or no figure in it.");
  module.def("candidates", &candidates, py::arg("image"), py::kw_only(), py::arg("mask") = py::none(),
             py::arg("figure") = 1, py::arg("method") = "maxima",
             "The candidates of a drawing, as for rig(). method: maxima, strict or discs.");
}

}  // namespace skel::python
