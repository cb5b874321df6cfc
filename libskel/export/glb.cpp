// glTF 2.0 binary (Khronos Group; ISO/IEC 12113:2022).
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "libskel/animation/sample_pose.h"
#include "libskel/core/check.h"
#include "libskel/export/bone_axes.h"
#include "libskel/export/bone_ends.h"
#include "libskel/export/check_character.h"
#include "libskel/export/joint_names.h"
#include "libskel/export/write_character.h"
#include "libskel/image/srgb.h"
#include "libskel/image/write_image.h"
#include "libskel/mesh/ink_hull.h"
#include "libskel/mesh/split_seams.h"
#include "libskel/mesh/vertex_normals.h"
#include "libskel/skeleton/joint_lookup.h"

namespace skel {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

template <class T>
struct ComponentType;
template <>
struct ComponentType<float> {
  static constexpr int value = TINYGLTF_COMPONENT_TYPE_FLOAT;
};
template <>
struct ComponentType<std::uint8_t> {
  static constexpr int value = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
};
template <>
struct ComponentType<std::uint16_t> {
  static constexpr int value = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
};
template <>
struct ComponentType<std::uint32_t> {
  static constexpr int value = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
};

constexpr int kNoTarget = 0;

// A model with one buffer, grown view by view.
class GlbBuilder {
 public:
  tinygltf::Model model;

  GlbBuilder() {
    model.asset.version = "2.0";
    model.buffers.emplace_back();
  }

  int addView(const void* bytes, std::size_t size, int target) {
    std::vector<unsigned char>& data = model.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = size;
    view.target = target;
    const auto* begin = static_cast<const unsigned char*>(bytes);
    data.insert(data.end(), begin, begin + size);
    model.bufferViews.push_back(view);
    return int(model.bufferViews.size()) - 1;
  }

  // `values`: `width` numbers an element, tightly packed. `type`: TINYGLTF_TYPE_…
  template <class T>
  int addAccessor(const std::vector<T>& values, int width, int type, int target, bool normalized = false) {
    tinygltf::Accessor accessor;
    accessor.bufferView = addView(values.data(), values.size() * sizeof(T), target);
    accessor.componentType = ComponentType<T>::value;
    accessor.count = values.size() / width;
    accessor.type = type;
    accessor.normalized = normalized;
    model.accessors.push_back(accessor);
    return int(model.accessors.size()) - 1;
  }

  // With the least and greatest value of each component, as positions and times must have.
  int addBoundedAccessor(const std::vector<float>& values, int width, int type, int target) {
    const int index = addAccessor(values, width, type, target);
    tinygltf::Accessor& accessor = model.accessors[index];
    accessor.minValues.assign(values.begin(), values.begin() + width);
    accessor.maxValues = accessor.minValues;
    for (std::size_t i = 0; i < values.size(); ++i) {
      double &low = accessor.minValues[i % width], &high = accessor.maxValues[i % width];
      low = std::min(low, double(values[i]));
      high = std::max(high, double(values[i]));
    }
    return index;
  }
};

template <class Matrix>
std::vector<float> rowByRow(const Matrix& matrix) {
  std::vector<float> values;
  values.reserve(std::size_t(matrix.size()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) values.push_back(float(matrix(i, k)));
  return values;
}

int addTriangles(GlbBuilder& glb, const TriangleMesh& mesh) {
  // 65535 is glTF's restart index.
  if (mesh.vertices.rows() <= 65535) {
    std::vector<std::uint16_t> indices;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
      for (int k = 0; k < 3; ++k) indices.push_back(std::uint16_t(mesh.triangles(t, k)));
    return glb.addAccessor(indices, 1, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  }
  std::vector<std::uint32_t> indices;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) indices.push_back(std::uint32_t(mesh.triangles(t, k)));
  return glb.addAccessor(indices, 1, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
}

bool repeats(const TriangleMesh& mesh) {
  return mesh.uv.rows() > 0 && (mesh.uv.minCoeff() < 0 || mesh.uv.maxCoeff() > 1);
}

// 16 bits where the texture does not repeat: half the size, and finer than any texture's pixels.
int addTextureCoordinates(GlbBuilder& glb, const TriangleMesh& mesh) {
  if (repeats(mesh))
    return glb.addAccessor(rowByRow(mesh.uv), 2, TINYGLTF_TYPE_VEC2, TINYGLTF_TARGET_ARRAY_BUFFER);
  std::vector<std::uint16_t> values;
  for (const float value : rowByRow(mesh.uv)) values.push_back(std::uint16_t(std::lround(value * 65535)));
  return glb.addAccessor(values, 2, TINYGLTF_TYPE_VEC2, TINYGLTF_TARGET_ARRAY_BUFFER, true);
}

// In units of 1/65535, with the sum that glTF asks for; the rounding falls on the heaviest, which stays the
// first.
std::vector<std::uint16_t> quantizedWeights(const SkinWeights& weights) {
  std::vector<std::uint16_t> values;
  for (Eigen::Index i = 0; i < weights.weights.rows(); ++i) {
    int left = 65535;
    int parts[4] = {};
    for (int k = 1; k < 4; ++k) {
      parts[k] = std::min(left, int(std::lround(weights.weights(i, k) * 65535)));
      left -= parts[k];
    }
    parts[0] = left;
    std::sort(parts, parts + 4, std::greater<>());
    for (const int part : parts) values.push_back(std::uint16_t(part));
  }
  return values;
}

template <class T>
int addJointIndices(GlbBuilder& glb, const SkinWeights& weights,
                    const std::vector<std::uint16_t>& quantized) {
  std::vector<T> values;
  for (Eigen::Index i = 0; i < weights.joints.rows(); ++i)
    for (int k = 0; k < 4; ++k) values.push_back(quantized[i * 4 + k] > 0 ? T(weights.joints(i, k)) : T(0));
  return glb.addAccessor(values, 4, TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
}

// The share of the drawing's colours that is there without light.
constexpr double kGlow = 0.25;

int addMaterial(GlbBuilder& glb, const TriangleMesh& mesh, const Image& texture, const std::string& name) {
  tinygltf::Material material;
  material.name = name;
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = 1;
  if (!texture.empty() && mesh.uv.rows() > 0) {
    const std::string png = encodePng(texture);
    tinygltf::Image image;
    image.name = name;
    image.mimeType = "image/png";
    image.bufferView = glb.addView(png.data(), png.size(), kNoTarget);
    glb.model.images.push_back(image);
    tinygltf::Sampler sampler;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.wrapS = sampler.wrapT =
        repeats(mesh) ? TINYGLTF_TEXTURE_WRAP_REPEAT : TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    glb.model.samplers.push_back(sampler);
    tinygltf::Texture sampled;
    sampled.sampler = 0;
    sampled.source = 0;
    glb.model.textures.push_back(sampled);
    material.pbrMetallicRoughness.baseColorTexture.index = 0;
    // So that the light of others does not turn white paper grey.
    material.pbrMetallicRoughness.baseColorFactor = {1 - kGlow, 1 - kGlow, 1 - kGlow, 1};
    material.emissiveTexture.index = 0;
    material.emissiveFactor = {kGlow, kGlow, kGlow};
  }
  glb.model.materials.push_back(material);
  return 0;
}

template <class Matrix>
Matrix rowsOf(const Matrix& matrix, const std::vector<int>& rows) {
  Matrix result(Eigen::Index(rows.size()), matrix.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) result.row(Eigen::Index(i)) = matrix.row(rows[i]);
  return result;
}

// The line around the figure as a second primitive, which shares the joints and weights of the first.
void addInkHull(GlbBuilder& glb, const TriangleMesh& whole, const Eigen::MatrixX3f& normals,
                const SplitMesh& split, const std::string& name, tinygltf::Mesh& result) {
  const Eigen::VectorXf reach_m = inkReach(whole);
  TriangleMesh hull;
  hull.vertices = rowsOf(Eigen::MatrixX3f(whole.vertices + reach_m.asDiagonal() * normals), split.source);
  hull.triangles = split.mesh.triangles;
  hull.triangles.col(1).swap(hull.triangles.col(2));
  tinygltf::Material material;
  material.name = name + "_ink";
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = 1;
  for (std::size_t k = 0; k < 3; ++k)
    material.pbrMetallicRoughness.baseColorFactor[k] = double(linearFromSrgb(whole.ink.rgb[Eigen::Index(k)]));
  material.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object());
  material.extras = tinygltf::Value(tinygltf::Value::Object{{"ink_hull", tinygltf::Value(true)}});
  glb.model.extensionsUsed.push_back("KHR_materials_unlit");
  glb.model.materials.push_back(material);
  tinygltf::Primitive primitive = result.primitives[0];
  primitive.attributes.erase("NORMAL");
  primitive.attributes.erase("TEXCOORD_0");
  primitive.material = int(glb.model.materials.size()) - 1;
  primitive.indices = addTriangles(glb, hull);
  primitive.attributes["POSITION"] =
      glb.addBoundedAccessor(rowByRow(hull.vertices), 3, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  result.primitives.push_back(primitive);
}

int addMesh(GlbBuilder& glb, const RiggedCharacter& character, const std::string& name, bool ink_hull) {
  const SplitMesh split = splitSeams(character.mesh);
  const TriangleMesh& mesh = split.mesh;
  // Of the whole mesh, so that no edge shows where it is parted.
  const Eigen::MatrixX3f normals = vertexNormals(character.mesh.vertices, character.mesh.triangles);
  SkinWeights skin;
  skin.joints = rowsOf(character.weights.joints, split.source);
  skin.weights = rowsOf(character.weights.weights, split.source);
  constexpr int kVertices = TINYGLTF_TARGET_ARRAY_BUFFER;
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = addMaterial(glb, mesh, character.mesh.texture, name);
  primitive.indices = addTriangles(glb, mesh);
  primitive.attributes["POSITION"] =
      glb.addBoundedAccessor(rowByRow(mesh.vertices), 3, TINYGLTF_TYPE_VEC3, kVertices);
  primitive.attributes["NORMAL"] =
      glb.addAccessor(rowByRow(rowsOf(normals, split.source)), 3, TINYGLTF_TYPE_VEC3, kVertices);
  if (!glb.model.textures.empty()) primitive.attributes["TEXCOORD_0"] = addTextureCoordinates(glb, mesh);
  const std::vector<std::uint16_t> weights = quantizedWeights(skin);
  primitive.attributes["JOINTS_0"] = character.skeleton.joints.size() <= 256
                                         ? addJointIndices<std::uint8_t>(glb, skin, weights)
                                         : addJointIndices<std::uint16_t>(glb, skin, weights);
  primitive.attributes["WEIGHTS_0"] = glb.addAccessor(weights, 4, TINYGLTF_TYPE_VEC4, kVertices, true);
  tinygltf::Mesh result;
  result.name = name;
  result.primitives.push_back(primitive);
  if (ink_hull && character.mesh.ink.width_m > 0)
    addInkHull(glb, character.mesh, normals, split, name, result);
  glb.model.meshes.push_back(result);
  return 0;
}

// To the micrometre: a reader who sums up the joints' places finds the same ones. No −0.
Vector3d rounded(const Vector3d& position) { return (position * 1e6).array().round() / 1e6 + 0.0; }

Skeleton rounded(Skeleton skeleton) {
  for (Joint& joint : skeleton.joints) {
    joint.position = rounded(joint.position);
    if (joint.tail) joint.tail = rounded(*joint.tail);
  }
  return skeleton;
}

// The joints' axes, see bone_axes.h: everything local to a joint is told in them.
struct Rig {
  Skeleton skeleton;
  std::vector<Quaterniond> axes;
  int first_end;  // from here on the skeleton's joints are ends of bones

  Quaterniond parentAxes(int joint) const {
    const int parent = skeleton.joints[joint].parent;
    return parent < 0 ? Quaterniond::Identity() : axes[parent];
  }
  // From the parent, in the parent's axes.
  Vector3d offset(int joint) const {
    const Joint& self = skeleton.joints[joint];
    if (self.parent < 0) return self.position;
    return parentAxes(joint).conjugate() * rounded(self.position - skeleton.joints[self.parent].position);
  }
  // `rotation`: local to the parent, in the model's axes.
  Quaterniond local(int joint, const Quaterniond& rotation) const {
    return parentAxes(joint).conjugate() * rotation * axes[joint];
  }
};

Rig rigOf(const RiggedCharacter& character, const std::vector<Clip>& clips, BoneStyle style) {
  const auto& [mesh, skeleton, skin, facing] = character;
  const Skeleton whole = rounded(style == BoneStyle::kEnds ? withBoneEnds(skeleton, mesh, skin) : skeleton);
  return {whole,
          style == BoneStyle::kPlain ? std::vector<Quaterniond>(whole.joints.size(), Quaterniond::Identity())
                                     : boneAxes(whole, mesh, skin, clips),
          int(skeleton.joints.size())};
}

// One node a joint, from `first` on.
void addJoints(GlbBuilder& glb, const Rig& rig, JointNaming naming, int first) {
  const std::vector<std::string> names = exportedJointNames(rig.skeleton, naming);
  for (std::size_t j = 0; j < rig.skeleton.joints.size(); ++j) {
    const Joint& joint = rig.skeleton.joints[j];
    tinygltf::Node node;
    node.name = names[j];
    const Vector3d offset = rig.offset(int(j));
    node.translation = {offset.x(), offset.y(), offset.z()};
    const Quaterniond turn = rig.local(int(j), Quaterniond::Identity()).normalized();
    if (turn.vec().norm() > 1e-9) node.rotation = {turn.x(), turn.y(), turn.z(), turn.w()};
    if (int(j) >= rig.first_end)
      node.extras = tinygltf::Value(tinygltf::Value::Object{{"end", tinygltf::Value(true)}});
    if (joint.tail) {
      tinygltf::Value::Array tail;
      for (const double value : *joint.tail) tail.emplace_back(value);
      node.extras = tinygltf::Value(tinygltf::Value::Object{{"tail", tinygltf::Value(tail)}});
    }
    glb.model.nodes.push_back(node);
    if (joint.parent >= 0)
      glb.model.nodes[first + joint.parent].children.push_back(int(glb.model.nodes.size()) - 1);
  }
}

void addSkin(GlbBuilder& glb, const Rig& rig, const std::string& name, int first_joint) {
  tinygltf::Skin skin;
  skin.name = name;
  skin.skeleton = first_joint;
  std::vector<float> inverse_bind;
  for (std::size_t j = 0; j < rig.skeleton.joints.size(); ++j) {
    skin.joints.push_back(first_joint + int(j));
    const Eigen::Matrix3d turn = rig.axes[j].conjugate().toRotationMatrix();
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = turn;
    matrix.col(3).head<3>() = -turn * rig.skeleton.joints[j].position;
    const Eigen::Matrix4f single = matrix.cast<float>();
    inverse_bind.insert(inverse_bind.end(), single.data(), single.data() + 16);
  }
  skin.inverseBindMatrices = glb.addAccessor(inverse_bind, 16, TINYGLTF_TYPE_MAT4, kNoTarget);
  glb.model.skins.push_back(skin);
}

void addChannel(tinygltf::Animation& animation, int node, const char* path, int times, int values) {
  tinygltf::AnimationSampler sampler;
  sampler.input = times;
  sampler.output = values;
  sampler.interpolation = "LINEAR";
  animation.samplers.push_back(sampler);
  tinygltf::AnimationChannel channel;
  channel.sampler = int(animation.samplers.size()) - 1;
  channel.target_node = node;
  channel.target_path = path;
  animation.channels.push_back(channel);
}

// Where the root is over time, model frame, m: what the clip says in heights and what it says in metres.
struct RootPath {
  std::vector<float> times_s;
  std::vector<Eigen::Vector3f> positions;
};

RootPath rootPath(const Clip& clip, const JointTrack* track, const Skeleton& skeleton, float height_m) {
  RootPath path;
  path.times_s = clip.root_times_s;
  if (track) {
    path.times_s.insert(path.times_s.end(), track->translation_times_s.begin(),
                        track->translation_times_s.end());
    std::sort(path.times_s.begin(), path.times_s.end());
    path.times_s.erase(std::unique(path.times_s.begin(), path.times_s.end()), path.times_s.end());
  }
  const Eigen::Vector3f rest = skeleton.joints[0].position.cast<float>();
  Clip root;
  root.root_times_s = clip.root_times_s;
  root.root_translations = clip.root_translations;
  if (track) {
    root.tracks = {*track};
    root.tracks[0].times_s.clear();
    root.tracks[0].rotations.clear();
  }
  const ClipSampler sampler(root, skeleton);
  for (const float time_s : path.times_s) {
    const Pose pose = sampler.at(time_s);
    Eigen::Vector3f at = rest + height_m * pose.root_translation;
    if (!pose.translations_m.empty()) at += pose.translations_m[0];
    path.positions.push_back(at);
  }
  return path;
}

std::vector<float> numbersOf(const std::vector<Eigen::Vector3f>& vectors) {
  std::vector<float> values;
  for (const Eigen::Vector3f& v : vectors) values.insert(values.end(), v.data(), v.data() + 3);
  return values;
}

void addClip(GlbBuilder& glb, const Clip& any_clip, const RiggedCharacter& character, const Rig& rig,
             int first_joint) {
  const Clip clip = withSlerp(any_clip);
  const Skeleton& skeleton = rig.skeleton;
  tinygltf::Animation animation;
  animation.name = clip.name;
  if (clip.loops)
    animation.extras = tinygltf::Value(tinygltf::Value::Object{{"loop", tinygltf::Value(true)}});
  // Tracks that share their times share an accessor.
  std::map<std::vector<float>, int> time_accessors;
  const auto timesAccessor = [&](const std::vector<float>& times) {
    const auto [known, is_new] = time_accessors.try_emplace(times, 0);
    if (is_new) known->second = glb.addBoundedAccessor(times, 1, TINYGLTF_TYPE_SCALAR, kNoTarget);
    return known->second;
  };
  // An animation of glTF ends with its last key: the first channel holds its value until the clip's end.
  bool first = true;
  const auto channel = [&](int joint, const char* path, std::vector<float> times, std::vector<float> values,
                           int width) {
    if (first && times.back() < clip.duration_s() && clip.duration_s() == clip.least_duration_s) {
      times.push_back(clip.duration_s());
      const std::vector<float> last(values.end() - width, values.end());
      values.insert(values.end(), last.begin(), last.end());
    }
    first = false;
    const int input = timesAccessor(times);
    const int type = width == 4 ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3;
    addChannel(animation, first_joint + joint, path, input, glb.addAccessor(values, width, type, kNoTarget));
  };
  const JointTrack* root_track = nullptr;
  const JointLookup joints(skeleton);
  for (const JointTrack& track : clip.tracks) {
    const int joint = joints.find(track.joint);
    SKEL_CHECK(joint >= 0);
    if (!track.times_s.empty()) {
      SKEL_CHECK_EQ(track.times_s.size(), track.rotations.size());
      std::vector<float> values;
      for (const Eigen::Quaternionf& rotation : track.rotations) {
        const Eigen::Quaternionf q = rig.local(joint, rotation.cast<double>()).normalized().cast<float>();
        values.insert(values.end(), {q.x(), q.y(), q.z(), q.w()});
      }
      channel(joint, "rotation", track.times_s, values, 4);
    }
    if (!track.translation_times_s.empty()) {
      if (joint == 0) {
        root_track = &track;
      } else {
        const Eigen::Vector3f rest = rig.offset(joint).cast<float>();
        const Eigen::Quaternionf turn = rig.parentAxes(joint).conjugate().cast<float>();
        std::vector<Eigen::Vector3f> places = track.translations_m;
        for (Eigen::Vector3f& place : places) place = turn * place + rest;
        channel(joint, "translation", track.translation_times_s, numbersOf(places), 3);
      }
    }
    if (!track.scale_times_s.empty())
      channel(joint, "scale", track.scale_times_s, numbersOf(track.scales), 3);
  }
  if (root_track || !clip.root_times_s.empty()) {
    SKEL_CHECK_EQ(clip.root_times_s.size(), clip.root_translations.size());
    const float height =
        character.mesh.vertices.col(1).maxCoeff() - character.mesh.vertices.col(1).minCoeff();
    const RootPath path = rootPath(clip, root_track, skeleton, height);
    channel(0, "translation", path.times_s, numbersOf(path.positions), 3);
  }
  if (!animation.channels.empty()) glb.model.animations.push_back(animation);
}

// What glTF has no place for; nothing where there is nothing.
tinygltf::Value extrasOf(const RiggedCharacter& character) {
  tinygltf::Value::Object extras;
  if (character.facing)
    extras["facing_deg"] = tinygltf::Value(character.facing->yaw_rad * 180 / std::numbers::pi);
  if (const InkLine& ink = character.mesh.ink; ink.width_m > 0) {
    tinygltf::Value::Array rgb;
    for (const float value : ink.rgb) rgb.emplace_back(double(value));
    extras["ink"] = tinygltf::Value(tinygltf::Value::Object{{"width_m", tinygltf::Value(double(ink.width_m))},
                                                            {"rgb", tinygltf::Value(rgb)}});
  }
  return extras.empty() ? tinygltf::Value() : tinygltf::Value(extras);
}

// Names of files may hold any bytes, those of glTF may not.
std::string asUtf8(const std::string& name) {
  using nlohmann::json;
  return json::parse(json(name).dump(-1, ' ', false, json::error_handler_t::replace));
}

// `name`, with as many underscores as make it differ from all joints' names.
std::string meshNodeName(std::string name, const Skeleton& skeleton, JointNaming naming) {
  const std::vector<std::string> names = exportedJointNames(skeleton, naming);
  const std::set<std::string> taken(names.begin(), names.end());
  while (taken.count(name)) name += "_";
  return name;
}

}  // namespace

std::string encodeGlb(const RiggedCharacter& character, const std::vector<Clip>& clips,
                      const ExportOptions& options) {
  checkCharacter(character, clips);
  GlbBuilder glb;
  glb.model.asset.generator = options.generator;
  const int kMeshNode = 0, kFirstJoint = 1;
  const std::string name = asUtf8(options.name);
  tinygltf::Node node;
  const Rig rig = rigOf(character, clips, options.bones);
  node.name = meshNodeName(name, rig.skeleton, options.naming);
  node.mesh = addMesh(glb, character, name, options.ink_hull);
  node.skin = 0;
  node.extras = extrasOf(character);
  glb.model.nodes.push_back(node);
  addJoints(glb, rig, options.naming, kFirstJoint);
  addSkin(glb, rig, name, kFirstJoint);
  for (const Clip& clip : clips) addClip(glb, clip, character, rig, kFirstJoint);

  tinygltf::Scene scene;
  scene.name = name;
  scene.nodes = {kMeshNode, kFirstJoint};
  glb.model.scenes.push_back(scene);
  glb.model.defaultScene = 0;

  std::ostringstream stream;
  stream.exceptions(std::ios::badbit);  // else it swallows the end where memory ends
  tinygltf::TinyGLTF writer;
  const bool written =
      writer.WriteGltfSceneToStream(&glb.model, stream, /*prettyPrint=*/false, /*writeBinary=*/true);
  SKEL_CHECK(written);
  return std::move(stream).str();
}

}  // namespace skel
