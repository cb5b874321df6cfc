#include "animator/clip_source.h"
#include "animator/film.h"
#include "animator/load_character.h"
#include "libskel/animation/clip_file.h"
#include "libskel/animation/clip_library.h"
#include "libskel/core/files.h"
#include "libskel/draw/color.h"
#include "libskel/export/formats.h"
#include "libskel/skin/smooth.h"
#include "python/bindings.h"

namespace skel::python {
namespace {

using Quaternions = Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor>;  // x, y, z, w

template <class List>
Quaternions rowsOf(const List& quaternions) {
  Quaternions rows(quaternions.size(), 4);
  for (std::size_t i = 0; i < quaternions.size(); ++i) rows.row(Eigen::Index(i)) = quaternions[i].coeffs();
  return rows;
}

std::vector<Eigen::Quaternionf> quaternionsOf(const Quaternions& rows, const std::string& name) {
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

using Tracks = std::map<std::string, std::pair<std::vector<float>, Quaternions>>;

Clip clipOf(const std::string& name, const Tracks& tracks, const std::string& body_plan) {
  Clip clip;
  clip.name = name;
  clip.template_name = body_plan;
  for (const auto& [joint, keys] : tracks) {
    JointTrack track;
    track.joint = joint;
    track.times_s = keys.first;
    track.rotations = quaternionsOf(keys.second, "clip \"" + name + "\", joint \"" + joint + "\"");
    clip.tracks.push_back(track);
  }
  return checked(clip);
}

Tracks tracksOf(const Clip& clip) {
  Tracks tracks;
  for (const JointTrack& track : clip.tracks) tracks[track.joint] = {track.times_s, rowsOf(track.rotations)};
  return tracks;
}

const Clip& clipOf(const CharacterFile& file, const py::object& clip) {
  return py::isinstance<Clip>(clip) ? clip.cast<const Clip&>()
                                    : clipNamed(file.clips, clip.cast<std::string>());
}

Pose poseAt(const CharacterFile& file, const py::object& clip, float time_s) {
  if (!std::isfinite(time_s)) throw UsageError("time_s: must be a finite number of seconds");
  return samplePose(clipOf(file, clip), file.character.skeleton, time_s);
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

void save(const CharacterFile& file, const Path& to) {
  const std::string path = to.string(), ending = to.extension().string();
  if (ending != ".glb" && ending != ".obj" && ending != ".bvh")
    throw UsageError(path + ": what a character is saved as ends with .glb, .obj or .bvh");
  unlocked(path, [&] {
    const std::string base = path.substr(0, path.size() - ending.size());
    const ExportInput input{file.character, file.clips, {.name = Path(base).filename().string()}};
    for (const ExportedFile& made : exportFormat(ending.substr(1)).encode(input))
      writeFile(base + made.suffix, made.bytes);
  });
}

// The frames of a film, painted when they are asked for.
struct Film {
  const CharacterFile* file;
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
      return scene.paint(posedAt(file->character, clip, double(index) / options.frame_rate), camera,
                         options.width, options.height, options.look);
    });
  }
};

std::unique_ptr<Film> filmOf(const CharacterFile& file, const py::object& clip, double fps,
                             std::pair<int, int> size, double angle_deg, double pitch_deg,
                             const std::string& background, bool skeleton) {
  if (!(fps >= 0.1 && fps <= 240)) throw UsageError("fps: must be from 0.1 to 240");
  const auto [width, height] = size;
  if (width < 16 || height < 16 || width > 8192 || height > 8192)
    throw UsageError("size: each side must have 16 to 8192 px");
  if (!(std::abs(angle_deg) <= 360 && std::abs(pitch_deg) <= 89))
    throw UsageError("angle_deg must lie within -360 and 360, pitch_deg within -89 and 89");
  const std::optional<Color> color = backgroundColor(background);
  if (!color)
    throw UsageError("background: \"" + background + "\" is no colour; white, grey, black, none or #rrggbb");
  FilmOptions options;
  options.width = width;
  options.height = height;
  options.frame_rate = fps;
  options.look.background = *color;
  options.look.skeleton = skeleton;
  const Clip chosen = clipOf(file, clip);
  return unlocked("film", [&] {
    const double radians = EIGEN_PI / 180;
    const Camera camera = filmCamera(file.character, {chosen}, angle_deg * radians, pitch_deg * radians,
                                     double(width) / height);
    return std::unique_ptr<Film>(new Film{&file, chosen, options, camera,
                                          Scene(file.character, softwarePainter(file.character.mesh))});
  });
}

}  // namespace

void bindCharacters(py::module_& module) {
  py::class_<Joint>(module, "Joint", "A joint of a skeleton.")
      .def_readonly("name", &Joint::name, "Left and right are the character's own.")
      .def_property_readonly(
          "image", [](const Joint& j) { return j.image; }, "(2,): where it lies in the drawing, px; +y down.")
      .def_property_readonly(
          "position", [](const Joint& j) { return j.position; },
          "(3,): where it lies in the model at rest, m; +y up, +z to the viewer.")
      .def_readonly("parent", &Joint::parent, "Index of the joint that carries it; -1 for the root.")
      .def_readonly("confidence", &Joint::confidence, "0 to 1.")
      .def_property_readonly(
          "origin", [](const Joint& j) { return jointOriginName(j.origin); },
          "How it came to be there: recognized, completed, derived, edited.")
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
          "(H, W, 4) uint8: sRGB and alpha.");

  py::class_<Clip>(module, "Clip", "A motion: joints that turn over time.")
      .def(py::init(py::overload_cast<const std::string&, const Tracks&, const std::string&>(&clipOf)),
           py::arg("name"), py::arg("tracks"), py::arg("body_plan") = "",
           "tracks: by joint, times (K,) in s, ascending, and rotations (K, 4) as quaternions (x, y, z, w), "
           "local to the parent; "
           "the identity is the rest pose.")
      .def_static(
          "load",
          [](const Path& path) {
            return unlocked(path.string(), [&] { return readClipFile(path.string()); });
          },
          py::arg("path"),
          "Reads a .clip.json, for the canonical pose: Character.retarget() makes it one of a character.")
      .def(
          "save",
          [](const Clip& clip, const Path& path) {
            unlocked(path.string(), [&] { writeFile(path.string(), formatClip(clip)); });
          },
          py::arg("path"), "Writes a .clip.json.")
      .def_readonly("name", &Clip::name)
      .def_readonly("body_plan", &Clip::template_name,
                    "Of the characters that it is made for; empty: of any.")
      .def_property_readonly("duration_s", &Clip::duration_s, "In s.")
      .def_property_readonly(
          "tracks", &tracksOf,
          "By joint: times (K,) in s and rotations (K, 4) as quaternions (x, y, z, w), local to the parent.")
      .def("__repr__", [](const Clip& c) {
        return "<skel.Clip " + c.name + ", " + std::to_string(c.duration_s()) + " s>";
      });

  py::class_<Pose>(module, "Pose", "How all joints are turned at one moment.")
      .def(py::init([](const Quaternions& rotations, const Eigen::Vector3f& root) {
             if (!root.allFinite()) throw UsageError("root_translation: must be finite");
             return Pose{quaternionsOf(rotations, "rotations"), root};
           }),
           py::arg("rotations"), py::arg("root_translation") = Eigen::Vector3f(Eigen::Vector3f::Zero()),
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

  py::class_<CharacterFile, std::shared_ptr<CharacterFile>>(
      module, "Character", "A mesh, the skeleton in it, how it moves the mesh, and clips.")
      .def_property_readonly(
          "joints", [](const CharacterFile& f) { return f.character.skeleton.joints; },
          "All joints, parents before children; joint 0 is the root.")
      .def_property_readonly(
          "mesh", [](const CharacterFile& f) -> const TriangleMesh& { return f.character.mesh; },
          py::return_value_policy::reference_internal)
      .def_property_readonly(
          "weights",
          [](const CharacterFile& f) {
            return unpackWeights(f.character.weights, int(f.character.skeleton.joints.size()));
          },
          "(V, J) float32: how much each joint carries each vertex; rows sum to 1, at most 4 of them are not "
          "0.")
      .def_readwrite("clips", &CharacterFile::clips,
                     "Relative to the rest pose; save() writes them into a .glb.")
      .def(
          "clip", [](const CharacterFile& f, const std::string& name) { return clipNamed(f.clips, name); },
          py::arg("name"), "The clip of this name. Raises UsageError, which lists the names there are.")
      .def(
          "retarget",
          [](const CharacterFile& f, const py::object& motion) {
            if (py::isinstance<Clip>(motion)) {
              const Clip clip = motion.cast<Clip>();
              return unlocked(clip.name, [&] { return fitted(clip, f.character); });
            }
            const std::string path = motion.cast<Path>().string();
            return unlocked(path, [&] { return clipFor(path, f); });
          },
          py::arg("motion"),
          "A motion for this character, in whatever pose it was drawn: a Clip for the canonical pose (of "
          "Clip.load() or builtin_clips()), "
          "the name of a built-in one, or a file: .clip.json, or .bvh with a skeleton of its own.")
      .def("pose", &poseAt, py::arg("clip"), py::arg("time_s"),
           "The pose of a clip (a Clip or the name of one) at a moment, in s; before the first key and after "
           "the last that key holds.")
      .def("rest_pose", [](const CharacterFile& f) { return restPose(f.character); })
      .def(
          "vertices",
          [](const CharacterFile& f, const Pose& pose) {
            const JointTransforms transforms = transformsOf(f.character, pose);
            return unlocked("vertices", [&] {
              return skinVertices(f.character.mesh.vertices, f.character.weights, transforms);
            });
          },
          py::arg("pose"), "(V, 3) float32: where the mesh's vertices are in a pose, m.")
      .def(
          "joint_positions",
          [](const CharacterFile& f, const Pose& pose) {
            return rowsOf(posedJoints(f.character.skeleton, transformsOf(f.character, pose)));
          },
          py::arg("pose"), "(J, 3) float32: where the joints are in a pose, m.")
      .def("film", &filmOf, py::arg("clip"), py::arg("fps") = 30., py::arg("size") = std::pair(512, 512),
           py::arg("angle_deg") = 0., py::arg("pitch_deg") = 5., py::arg("background") = "white",
           py::arg("skeleton") = false, py::keep_alive<0, 1>(),
           "The frames of a clip. size: (width, height), px. angle_deg: 0 from the front, 90 from its left. "
           "pitch_deg: how far from above. "
           "background: white, grey, black, none (transparent) or #rrggbb.")
      .def("save", &save, py::arg("path"),
           "Writes .glb (model, skeleton, texture, clips), .obj (the model with .mtl and .png) or .bvh (one "
           "file a clip).")
      .def(
          "to_glb",
          [](const CharacterFile& f) {
            const std::string bytes = unlocked("character", [&] {
              return encodeGlb(f.character, f.clips, {.name = f.name, .bones = f.bones});
            });
            return py::bytes(bytes);
          },
          "The bytes of the .glb.");

  module.def(
      "load",
      [](const Path& path) {
        return unlocked(path.string(),
                        [&] { return std::make_shared<CharacterFile>(readGlb(path.string())); });
      },
      py::arg("path"), "Reads a .glb back.");
  module.def(
      "builtin_clips", [] { return builtinClips(); },
      "The motions that come with skel, for the canonical pose.");
}

}  // namespace skel::python
