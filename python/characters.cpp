#include <algorithm>
#include <limits>

#include "animator/clip_source.h"
#include "animator/film.h"
#include "animator/load_character.h"
#include "libskel/animation/clip_file.h"
#include "libskel/animation/clip_library.h"
#include "libskel/animation/clip_limits.h"
#include "libskel/animation/pose_hash.h"
#include "libskel/core/files.h"
#include "libskel/draw/color.h"
#include "libskel/export/formats.h"
#include "libskel/skin/smooth.h"
#include "python/bindings.h"

namespace skel::python {

std::string sizesOf(const RiggedCharacter& character) {
  return std::to_string(character.skeleton.joints.size()) + " joints, " +
         std::to_string(character.mesh.vertices.rows()) + " vertices";
}

namespace {
namespace fs = std::filesystem;

using Quaternions = Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor>;  // x, y, z, w

template <class List>
Quaternions rowsOf(const List& quaternions) {
  Quaternions rows(quaternions.size(), 4);
  for (std::size_t i = 0; i < quaternions.size(); ++i) rows.row(Eigen::Index(i)) = quaternions[i].coeffs();
  return rows;
}

std::vector<Eigen::Quaternionf> quaternionsOf(const py::object& numbers, const std::string& name) {
  const Quaternions rows = rowsIn(numbers, 4, name);
  std::vector<Eigen::Quaternionf> list;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const float length = rows.row(i).norm();
    if (!(length > 0.5f && length < 2))  // also nan
      throw UsageError(name + ": row " + std::to_string(i) +
                       " is no rotation; it must be a unit quaternion (x, y, z, w)");
    list.emplace_back(Eigen::Vector4f(rows.row(i) / length));
  }
  return list;
}

Eigen::MatrixX3f rowsOf(const std::vector<Eigen::Vector3f>& points) {
  Eigen::MatrixX3f rows(points.size(), 3);
  for (std::size_t i = 0; i < points.size(); ++i) rows.row(Eigen::Index(i)) = points[i];
  return rows;
}

py::array_t<float> cornersOf(const TriangleMesh& mesh) {
  py::array_t<float> uv({mesh.uv.rows() > 0 ? mesh.triangles.rows() : 0, Eigen::Index(3), Eigen::Index(2)});
  auto to = uv.mutable_unchecked<3>();
  for (py::ssize_t f = 0; f < uv.shape(0); ++f)
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::RowVector2f at = mesh.uvOf(f, corner);
      to(f, corner, 0) = at.x();
      to(f, corner, 1) = at.y();
    }
  return uv;
}

// As a file would be: whatever is wrong is told by the reader of clip files.
Clip checked(const Clip& clip) {
  const std::string file = "clip \"" + clip.name + "\"";
  try {
    return parseClip(formatClip(clip), file);
  } catch (const InputError&) {
    throw;
  } catch (const Error& error) {
    throw InputError(file, error.what());
  }
}

// Times and what is then, as Python gives them.
struct Keys {
  std::vector<float> times_s;
  py::object values;
};

Keys keysOf(const py::object& pair, const std::string& where) {
  if (!py::isinstance<py::sequence>(pair) || py::isinstance<py::str>(pair) || py::len(pair) != 2)
    throw UsageError(where + ": must be a pair of times and what is then");
  const auto parts = py::reinterpret_borrow<py::sequence>(pair);
  Keys keys{{}, parts[1]};
  for (const double time_s : numbersIn(parts[0], -1, where + ", times")) {
    if (!(time_s >= 0 && time_s <= kMaxClip_s))
      throw UsageError(where + ", times: must be finite, from 0 to " + std::to_string(int(kMaxClip_s)) +
                       " s");
    if (!keys.times_s.empty() && !(float(time_s) > keys.times_s.back()))
      throw UsageError(where + ", times: must ascend, each later than the one before");
    keys.times_s.push_back(float(time_s));
  }
  if (keys.times_s.empty()) throw UsageError(where + ": has no keys");
  return keys;
}

void checkCounts(const Keys& keys, std::size_t values, const char* what, const std::string& where) {
  if (keys.times_s.size() != values)
    throw UsageError(where + ": has " + std::to_string(keys.times_s.size()) + " times, but " +
                     std::to_string(values) + " " + what + "; give one for each");
}

Clip clipOf(const std::string& name, const py::object& tracks, const std::string& body_plan,
            const py::object& root) {
  Clip clip;
  clip.name = name;
  clip.template_name = body_plan;
  const std::string here = "clip \"" + name + "\"";
  for (const auto& [joint, pair] : namedIn(tracks, here + ", tracks")) {
    const std::string where = here + ", joint \"" + joint + "\"";
    const Keys keys = keysOf(pair, where);
    JointTrack track;
    track.joint = joint;
    track.rotations = quaternionsOf(keys.values, where);
    checkCounts(keys, track.rotations.size(), "rotations", where);
    track.times_s = keys.times_s;
    clip.tracks.push_back(std::move(track));
  }
  if (!root.is_none()) {
    const std::string where = here + ", root";
    const Keys keys = keysOf(root, where);
    const Rows places = rowsIn(keys.values, 3, where);
    checkCounts(keys, std::size_t(places.rows()), "places", where);
    if (!places.allFinite()) throw UsageError(where + ": must be finite");
    clip.root_times_s = keys.times_s;
    for (Eigen::Index i = 0; i < places.rows(); ++i)
      clip.root_translations.push_back(places.row(i).transpose());
  }
  return checked(clip);
}

using Tracks = std::map<std::string, std::pair<std::vector<float>, Quaternions>>;

Tracks tracksOf(const Clip& clip) {
  Tracks tracks;
  for (const JointTrack& track : clip.tracks) tracks[track.joint] = {track.times_s, rowsOf(track.rotations)};
  return tracks;
}

std::optional<std::pair<std::vector<float>, Eigen::MatrixX3f>> rootOf(const Clip& clip) {
  if (clip.root_times_s.empty()) return std::nullopt;
  return std::pair(clip.root_times_s, rowsOf(clip.root_translations));
}

// Whether it waits to be retargeted: what it says is relative to no rest pose.
bool isForCanonicalPose(const Clip& clip) {
  return clip.frame == ClipFrame::kBody || !clip.contacts.empty() ||
         std::any_of(clip.tracks.begin(), clip.tracks.end(),
                     [](const JointTrack& track) { return !track.bone.isZero(); });
}

// As far as it can be told: that the clip is one of this character.
void checkOwn(const Clip& clip, const Character& own) {
  const Skeleton& skeleton = own.character.skeleton;
  const std::string name = "the clip \"" + clip.name + "\" ";
  if (const std::string& plan = skeleton.template_name;
      !plan.empty() && !clip.template_name.empty() && clip.template_name != plan && !fits(clip, skeleton))
    throw UsageError(name + "is made for the body plan \"" + clip.template_name +
                     "\", this character is a \"" + plan + "\"; use one for it");
  const ClipSampler joints_are_there(clip, skeleton);  // or it throws
  if (isForCanonicalPose(clip) || (!clip.rest_pose.empty() && clip.rest_pose != restPoseHash(skeleton)))
    throw UsageError(name + "is not relative to this character's rest pose; retarget() makes it so");
}

Clip clipOf(const Character& own, const py::object& clip) {
  if (py::isinstance<py::str>(clip)) return clipNamed(*own.clips, clip.cast<std::string>());
  if (!py::isinstance<Clip>(clip)) throw UsageError("clip: must be a Clip, or the name of one");
  const Clip& given = clip.cast<const Clip&>();
  checkOwn(given, own);
  return given;
}

void setClips(Character& own, const py::object& clips) {
  const std::string wanted = "clips: must be a list of Clips";
  if (!py::isinstance<py::sequence>(clips)) throw UsageError(wanted);
  auto taken = std::make_shared<std::vector<Clip>>();
  for (const py::handle& clip : clips) {
    if (!py::isinstance<Clip>(clip)) throw UsageError(wanted);
    checkOwn(clip.cast<const Clip&>(), own);
    taken->push_back(clip.cast<const Clip&>());
  }
  own.clips = std::move(taken);
}

Clip retargeted(const Character& own, const py::object& motion) {
  if (py::isinstance<Clip>(motion)) {
    const Clip clip = motion.cast<Clip>();
    return unlocked(clip.name, [&] { return fitted(clip, own.character); });
  }
  const std::string path = pathOf(motion, "motion", "a Clip, the name of one, or the path of a file");
  const auto clips = own.clips;
  return unlocked(path, [&] { return clipFor(path, own.character, *clips); });
}

// Those of a model are not known to lie in a drawing.
std::vector<Joint> jointsOf(const Character& own) {
  std::vector<Joint> joints = own.character.skeleton.joints;
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (!own.drawn)
    for (Joint& joint : joints) joint.image.setConstant(kUnknown), joint.confidence = kUnknown;
  return joints;
}

std::optional<std::string> originOf(const Joint& joint) {
  if (std::isnan(joint.confidence)) return std::nullopt;
  return std::string(jointOriginName(joint.origin));
}

Pose poseAt(const Character& own, const py::object& clip, float time_s) {
  if (!std::isfinite(time_s)) throw UsageError("time_s: must be a finite number of seconds");
  return samplePose(clipOf(own, clip), own.character.skeleton, time_s);
}

JointTransforms transformsOf(const RiggedCharacter& character, const Pose& pose) {
  if (pose.rotations.size() != character.skeleton.joints.size())
    throw UsageError("pose: has " + std::to_string(pose.rotations.size()) + " rotations, the character has " +
                     std::to_string(character.skeleton.joints.size()) + " joints");
  return posedFromRest(character.skeleton, pose, heightOf(character));
}

Pose restPose(const RiggedCharacter& character) {
  return {std::vector<Eigen::Quaternionf>(character.skeleton.joints.size(), Eigen::Quaternionf::Identity())};
}

// What a person has drawn is lost for good. Throws UsageError.
void checkNotSource(const std::string& output, const Character& own) {
  for (const std::string& source : own.sources)
    if (std::error_code none; fs::equivalent(output, source, none))
      throw UsageError(output + " would be written over, but the character is made from it (" + source +
                       "); name another output");
}

// The texture has the model's name, which is not the one that the user gives: a picture of that name that no
// .mtl stands beside may be anything, such as the drawing that came as an array.
void checkTexture(const std::string& base) {
  std::error_code none;
  const std::string texture = base + ".png";
  if (fs::exists(texture, none) && !fs::exists(base + ".mtl", none))
    throw UsageError(texture + " would be written over by the texture of " + base +
                     ".obj, and is none so far; name another output, or take the picture away");
}

void save(const Character& own, const py::object& to) {
  const std::string path = pathOf(to, "path"), ending = fs::path(path).extension().string();
  if (ending != ".glb" && ending != ".obj" && ending != ".bvh")
    throw UsageError(path + ": what a character is saved as ends with .glb, .obj or .bvh");
  const auto clips = own.clips;
  unlocked(path, [&] {
    const std::string base = path.substr(0, path.size() - ending.size());
    const std::string name = fs::path(base).filename().string();
    const ExportFormat& format = exportFormat(ending.substr(1));
    for (const std::string& suffix : format.suffixes(name, *clips)) checkNotSource(base + suffix, own);
    if (ending == ".obj") checkTexture(base);
    ExportOptions options = own.exported();
    options.name = name;
    const ExportInput input{own.character, *clips, options};
    for (const ExportedFile& made : format.encode(input)) writeFile(base + made.suffix, made.bytes);
  });
}

// The frames of a film, painted when they are asked for.
struct Film {
  const Character* own;
  Clip clip;
  FilmOptions options;
  Camera camera;
  Scene scene;

  int count() const { return frameCount(clip, options); }
  Image frame(py::ssize_t index) const {
    if (index < 0) index += count();
    if (index < 0 || index >= count())
      throw py::index_error("a film of " + std::to_string(count()) + " frames");
    return unlocked("film", [&] {
      return scene.paint(posedAt(own->character, clip, double(index) / options.frame_rate), camera,
                         options.width, options.height, options.look);
    });
  }
};

std::unique_ptr<Film> filmOf(const Character& own, const py::object& clip, double fps,
                             std::pair<int, int> size, double angle_deg, double pitch_deg,
                             const std::string& background, bool skeleton) {
  if (!(fps >= 0.1 && fps <= 240)) throw UsageError("fps: must be from 0.1 to 240");
  const auto [width, height] = size;
  if (width < 16 || height < 16 || width > 8192 || height > 8192)
    throw UsageError("size: each side must have 16 to 8192 px");
  if (!(std::abs(angle_deg) <= 360 && std::abs(pitch_deg) <= 89))
    throw UsageError("angle_deg must lie within -360 and 360, pitch_deg within -89 and 89");
  const std::string no_color =
      "background: \"" + background + "\" is no colour; white, grey, black, none or #rrggbb";
  std::optional<Color> color;
  try {
    color = backgroundColor(background);
  } catch (const UsageError&) {  // calls it by the option of a tool
    throw UsageError(no_color);
  }
  if (!color) throw UsageError(no_color);
  FilmOptions options;
  options.width = width;
  options.height = height;
  options.frame_rate = fps;
  options.look.background = *color;
  options.look.skeleton = skeleton;
  const Clip chosen = clipOf(own, clip);
  return unlocked("film", [&] {
    const double radians = EIGEN_PI / 180;
    const Camera camera =
        filmCamera(own.character, {chosen}, angle_deg * radians, pitch_deg * radians, double(width) / height);
    return std::unique_ptr<Film>(
        new Film{&own, chosen, options, camera, Scene(own.character, softwarePainter(own.character.mesh))});
  });
}

}  // namespace

void bindCharacters(py::module_& module) {
  py::class_<Joint>(module, "Joint", "A joint of a skeleton.")
      .def_readonly("name", &Joint::name, "Left and right are the character's own.")
      .def_property_readonly(
          "image", [](const Joint& j) { return j.image; },
          "(2,): where it lies in the drawing, px; +y down. NaN where there is none (skel.load()).")
      .def_property_readonly(
          "position", [](const Joint& j) { return j.position; },
          "(3,): where it lies in the model at rest, m; +y up, +z to the viewer.")
      .def_readonly("parent", &Joint::parent, "Index of the joint that carries it; -1 for the root.")
      .def_readonly("confidence", &Joint::confidence, "0 to 1; NaN where there is no drawing.")
      .def_property_readonly(
          "origin", &originOf,
          "How it came to be there: recognized, completed, derived, edited; None where there is no drawing.")
      .def("__repr__", [](const Joint& j) { return "<skel.Joint " + j.name + ">"; });

  py::class_<TriangleMesh>(module, "Mesh", "A textured triangle mesh.")
      .def_property_readonly(
          "vertices", [](const TriangleMesh& m) { return m.vertices; },
          "(V, 3) float32: m; +y up, +z to the viewer; at rest.")
      .def_property_readonly(
          "triangles", [](const TriangleMesh& m) { return m.triangles; },
          "(F, 3) int32: indices of vertices, counter-clockwise from outside.")
      .def_property_readonly("uv", &cornersOf,
                             "(F, 3, 2) float32: of each corner of each triangle in the texture, 0 to 1; "
                             "origin at the top left.")
      .def_property_readonly(
          "texture", [](const TriangleMesh& m) { return arrayOf(m.texture); },
          "(H, W, 4) uint8: sRGB and alpha.")
      .def("__repr__", [](const TriangleMesh& m) {
        return "<skel.Mesh: " + std::to_string(m.vertices.rows()) + " vertices, " +
               std::to_string(m.triangles.rows()) + " triangles>";
      });

  py::class_<Clip>(module, "Clip", "A motion: joints that turn over time.")
      .def(
          py::init(
              py::overload_cast<const std::string&, const py::object&, const std::string&, const py::object&>(
                  &clipOf)),
          py::arg("name"), py::arg("tracks"), py::arg("body_plan") = "", py::arg("root") = py::none(),
          "tracks: by joint, times (K,) in s, ascending, and rotations (K, 4) as quaternions (x, y, z, w), "
          "local to the parent; "
          "the identity is the rest pose. root: times (K,) and (K, 3), what is added to the root's place, "
          "in heights of the model. What else "
          "clip files hold (places and sizes of joints, contacts, ...) goes by save() and load() alone.")
      .def_static(
          "load",
          [](const py::object& path) {
            const std::string file = pathOf(path, "path");
            return unlocked(file, [&] { return readClipFile(file); });
          },
          py::arg("path"),
          "Reads a .clip.json, for the canonical pose: Character.retarget() makes it one of a character.")
      .def(
          "save",
          [](const Clip& clip, const py::object& path) {
            const std::string file = pathOf(path, "path");
            unlocked(file, [&] { writeFile(file, formatClip(clip)); });
          },
          py::arg("path"), "Writes a .clip.json.")
      .def_readonly("name", &Clip::name)
      .def_readonly("body_plan", &Clip::template_name,
                    "Of the characters that it is made for; empty: of any.")
      .def_property_readonly("duration_s", &Clip::duration_s, "In s.")
      .def_property_readonly(
          "tracks", &tracksOf,
          "By joint: times (K,) in s and rotations (K, 4) as quaternions (x, y, z, w), local to the parent.")
      .def_property_readonly(
          "root", &rootOf,
          "Times (K,) in s and (K, 3): what is added to the root's place, in heights of the model. None: it "
          "stays.")
      .def("__repr__", [](const Clip& c) {
        return "<skel.Clip " + c.name + ", " + std::to_string(c.duration_s()) + " s>";
      });

  py::class_<Pose>(module, "Pose", "How all joints are turned at one moment.")
      .def(py::init([](const py::object& rotations, const py::object& root_translation) {
             const std::vector<double> numbers = numbersIn(root_translation, 3, "root_translation");
             const Eigen::Vector3f root = Eigen::Vector3d(numbers.data()).cast<float>();
             if (!root.allFinite()) throw UsageError("root_translation: must be finite");
             return Pose{quaternionsOf(rotations, "rotations"), root};
           }),
           py::arg("rotations"), py::arg("root_translation") = py::make_tuple(0, 0, 0),
           "rotations: (J, 4), a quaternion (x, y, z, w) for each joint, local to its parent; the identity "
           "is the rest pose. "
           "root_translation: (3,), in heights of the model.")
      .def_property_readonly(
          "rotations", [](const Pose& p) { return rowsOf(p.rotations); },
          "(J, 4) float32: quaternions (x, y, z, w).")
      .def_property_readonly(
          "root_translation", [](const Pose& p) { return p.root_translation; },
          "(3,): in heights of the model.");

  py::class_<Film>(module, "Film",
                   "Frames of a clip, a sequence of (H, W, 4) uint8; each is painted when it is asked for.")
      .def("__len__", &Film::count)
      .def(
          "__getitem__", [](const Film& film, py::ssize_t index) { return arrayOf(film.frame(index)); },
          py::arg("index"))
      .def_property_readonly(
          "fps", [](const Film& film) { return film.options.frame_rate; }, "Frames a second.");

  py::class_<Character, std::shared_ptr<Character>>(
      module, "Character", "A mesh, the skeleton in it, how it moves the mesh, and clips.")
      .def_property_readonly(
          "joints", &jointsOf,
          "All joints, parents before children; joint 0 is the root. How many there are depends on the "
          "drawing: hanging_* are of what hangs on the figure.")
      .def_property_readonly(
          "mesh", [](const Character& own) -> const TriangleMesh& { return own.character.mesh; },
          py::return_value_policy::reference_internal)
      .def_property_readonly(
          "weights",
          [](const Character& own) {
            return unpackWeights(own.character.weights, int(own.character.skeleton.joints.size()));
          },
          "(V, J) float32: how much each joint carries each vertex; rows sum to 1, at most 4 of them are not "
          "0.")
      .def_property(
          "clips", [](const Character& own) { return std::vector<Clip>(*own.clips); }, &setClips,
          "Relative to the rest pose; save() writes them into a .glb. A list of its own each time: assign it "
          "to change them. Raises UsageError of clips that are not for this character, as pose() does.")
      .def(
          "clip",
          [](const Character& own, const std::string& name) { return Clip(clipNamed(*own.clips, name)); },
          py::arg("name"), "The clip of this name. Raises UsageError, which lists the names there are.")
      .def("retarget", &retargeted, py::arg("motion"),
           "A motion for this character, in whatever pose it was drawn: a Clip for the canonical pose (of "
           "Clip.load() or builtin_clips()), "
           "the name of a built-in one, or a file: .clip.json, or .bvh with a skeleton of its own.")
      .def("pose", &poseAt, py::arg("clip"), py::arg("time_s"),
           "The pose of a clip (a Clip or the name of one) at a moment, in s; before the first key and after "
           "the last that key holds. Raises UsageError of a clip for the canonical pose, for another body "
           "plan or with joints that are not there: retarget() it first. That a clip has been made for "
           "another character of the same plan cannot be told: it moves this one as if it was drawn alike.")
      .def("rest_pose", [](const Character& own) { return restPose(own.character); })
      .def(
          "vertices",
          [](const Character& own, const Pose& pose) {
            const JointTransforms transforms = transformsOf(own.character, pose);
            return unlocked("vertices", [&] {
              return skinVertices(own.character.mesh.vertices, own.character.weights, transforms);
            });
          },
          py::arg("pose"), "(V, 3) float32: where the mesh's vertices are in a pose, m.")
      .def(
          "joint_positions",
          [](const Character& own, const Pose& pose) {
            return rowsOf(posedJoints(own.character.skeleton, transformsOf(own.character, pose)));
          },
          py::arg("pose"), "(J, 3) float32: where the joints are in a pose, m.")
      .def("film", &filmOf, py::arg("clip"), py::arg("fps") = 30., py::arg("size") = std::pair(512, 512),
           py::arg("angle_deg") = 0., py::arg("pitch_deg") = 5., py::arg("background") = "white",
           py::arg("skeleton") = false, py::keep_alive<0, 1>(),
           "The frames of a clip. size: (width, height), px. angle_deg: 0 from the front, 90 from its left. "
           "pitch_deg: how far from above. "
           "background: white, grey, black, none (transparent) or #rrggbb.")
      .def(
          "save", &save, py::arg("path"),
          "Writes .glb (model, skeleton, texture, clips), .obj (the model with .mtl and .png) or .bvh (one "
          "file a clip). Raises UsageError, and writes nothing, where a file that the character is made from "
          "would be written over, or a .png without .mtl by the texture of an .obj.")
      .def(
          "to_glb",
          [](const Character& own) {
            const auto clips = own.clips;
            const std::string bytes =
                unlocked("character", [&] { return encodeGlb(own.character, *clips, own.exported()); });
            return py::bytes(bytes);
          },
          "The bytes of the .glb.")
      .def("__repr__",
           [](const Character& own) { return "<skel.Character: " + sizesOf(own.character) + ">"; });

  module.def(
      "load",
      [](const py::object& path) {
        const std::string name = pathOf(path, "path");
        return unlocked(name, [&] {
          CharacterFile file = readGlb(name);
          return std::make_shared<Character>(
              Character{std::move(file.character),
                        std::make_shared<const std::vector<Clip>>(std::move(file.clips)),
                        std::move(file.name),
                        file.bones,
                        file.ink_hull,
                        false,
                        {}});
        });
      },
      py::arg("path"), "path: of a .glb, which is read back. save() may write over it.");
  module.def(
      "builtin_clips", [] { return builtinClips(); },
      "The motions that come with skel, for the canonical pose.");
}

}  // namespace skel::python
