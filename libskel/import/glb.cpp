// glTF 2.0 binary (Khronos Group; ISO/IEC 12113:2022), the way back from libskel/export/glb.cpp.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include "libskel/animation/clip_limits.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/image/read_image.h"
#include "libskel/image/srgb.h"
#include "libskel/import/glb_container.h"
#include "libskel/import/read_character.h"
#include "libskel/mesh/plain_texture.h"
#include "libskel/mesh/split_seams.h"
#include "libskel/skeleton/hanging.h"
#include "libskel/skeleton/rig_file.h"
#include "libskel/skeleton/template.h"

namespace skel {
namespace {

using Eigen::Affine3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kMaxWidth = 1e4f;  // of a model, in its heights
constexpr double kRigid = 1e-4;  // how far a rest transform may be from a rotation, a scale from an even one

std::optional<std::vector<double>> numbersAt(const JsonValue& object, std::string_view key,
                                             std::size_t count) {
  const std::optional<JsonValue> value = object.find(key);
  if (!value) return std::nullopt;
  return value->asNumbers(count);
}

Affine3d localTransform(const JsonValue& node) {
  Affine3d transform = Affine3d::Identity();
  if (const auto m = numbersAt(node, "matrix", 16)) {
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(m->data());
    return transform;
  }
  if (const auto t = numbersAt(node, "translation", 3))
    transform.translate(Vector3d((*t)[0], (*t)[1], (*t)[2]));
  if (const auto r = numbersAt(node, "rotation", 4)) {
    const Eigen::Quaterniond rotation((*r)[3], (*r)[0], (*r)[1], (*r)[2]);
    if (std::abs(rotation.norm() - 1) > 1e-3) node.at("rotation").fail("is not a unit quaternion");
    transform.rotate(rotation.normalized());
  }
  if (const auto s = numbersAt(node, "scale", 3)) transform.scale(Vector3d((*s)[0], (*s)[1], (*s)[2]));
  return transform;
}

// The nodes as a forest, each with its transform in the rest pose.
struct Nodes {
  std::vector<JsonValue> values;
  std::vector<int> parents;
  std::vector<int> order;  // parents before children, else as in the file
  std::vector<Affine3d, Eigen::aligned_allocator<Affine3d>> model_from_node;

  explicit Nodes(const GlbContainer& glb) : values(glb.root().at("nodes").items()) {
    const int count = static_cast<int>(values.size());
    parents.assign(values.size(), -1);
    std::vector<std::vector<int>> children(values.size());
    for (int i = 0; i < count; ++i) {
      const std::optional<JsonValue> list = values[i].find("children");
      if (!list) continue;
      for (const JsonValue& item : list->items()) {
        const int child = item.asInt(0, count - 1);
        if (parents[child] >= 0) item.fail("node " + std::to_string(child) + " has two parents");
        parents[child] = i;
        children[i].push_back(child);
      }
    }
    std::vector<int> open;
    for (int i = count - 1; i >= 0; --i)
      if (parents[i] < 0) open.push_back(i);
    model_from_node.assign(values.size(), Affine3d::Identity());
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      order.push_back(node);
      const Affine3d local = localTransform(values[node]);
      model_from_node[node] = parents[node] < 0 ? local : model_from_node[parents[node]] * local;
      open.insert(open.end(), children[node].rbegin(), children[node].rend());
    }
    if (static_cast<int>(order.size()) < count) glb.root().at("nodes").fail("are in a circle");
  }
};

// The one node that wears a skin.
int skinnedNode(const GlbContainer& glb, const Nodes& nodes) {
  int found = -1;
  for (std::size_t i = 0; i < nodes.values.size(); ++i) {
    const std::optional<JsonValue> mesh = nodes.values[i].find("mesh");
    if (!mesh) continue;
    if (found >= 0) mesh->fail("is a second mesh; one is read: join them in the program that made the file");
    if (!nodes.values[i].find("skin")) mesh->fail("has no skin; bind the model to a skeleton first");
    found = static_cast<int>(i);
  }
  if (found < 0) glb.root().at("nodes").fail("hold no mesh");
  return found;
}

constexpr int kBoneEnd = -2;

struct Joints {
  Skeleton skeleton;
  // Of each joint from its own axes and from those of its node's parent to the model's, in the rest pose.
  // Skel's skeletons have the model's everywhere.
  std::vector<Quaterniond> axes;
  std::vector<Affine3d, Eigen::aligned_allocator<Affine3d>> model_from_parent;
  std::vector<int> of_node;        // index into skeleton.joints, -1: none, kBoneEnd
  std::vector<int> of_skin_joint;  // the same by the skin's own order
  bool have_ends = false;

  BoneStyle style() const {
    if (have_ends) return BoneStyle::kEnds;
    const bool plain = std::all_of(axes.begin(), axes.end(), [](const Quaterniond& turn) {
      return turn.vec().cwiseAbs().maxCoeff() <= kRigid;
    });
    return plain ? BoneStyle::kPlain : BoneStyle::kAlong;
  }
};

// What encodeGlb() puts at the end of a last bone.
bool isBoneEnd(const JsonValue& node) {
  const std::optional<JsonValue> extras = node.find("extras");
  return extras && extras->isObject() && extras->find("end");
}

std::string templateOf(const Skeleton& skeleton) {
  const auto hanging = std::count_if(skeleton.joints.begin(), skeleton.joints.end(), hangs);
  for (const std::string& name : builtinTemplates()) {
    const SkeletonTemplate body_plan = loadTemplate(name);
    if (body_plan.joints.size() + std::size_t(hanging) != skeleton.joints.size()) continue;
    const bool same = std::all_of(skeleton.joints.begin(), skeleton.joints.end(), [&](const Joint& joint) {
      if (hangs(joint)) return true;
      const int index = body_plan.find(joint.name);
      if (index < 0) return false;
      const int parent = body_plan.joints[index].parent;
      return (parent < 0) == (joint.parent < 0) &&
             (parent < 0 || body_plan.joints[parent].name == skeleton.joints[joint.parent].name);
    });
    if (same) return name;
  }
  return "";
}

bool isRigid(const Affine3d& transform) {
  const Eigen::Matrix3d turn = transform.linear();
  return (turn * turn.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kRigid &&
         turn.determinant() > 0;
}

Joints readJoints(const Nodes& nodes, const JsonValue& skin) {
  const JsonValue list = skin.at("joints");
  const std::vector<JsonValue> items = list.items();
  if (items.empty()) list.fail("is empty");
  if (items.size() > kMostJoints) list.fail("has more than " + std::to_string(kMostJoints) + " joints");
  Joints joints;
  std::vector<int> place(nodes.values.size(), -1);  // in the skin's list
  for (std::size_t k = 0; k < items.size(); ++k) {
    const int node = items[k].asInt(0, static_cast<int>(nodes.values.size()) - 1);
    if (place[node] >= 0) items[k].fail("node " + std::to_string(node) + " stands here for the second time");
    place[node] = static_cast<int>(k);
  }
  // In the skin's order, as far as that has parents first: then the file is written as it was.
  std::vector<int> sorted;
  for (const JsonValue& item : items) sorted.push_back(item.asInt(0, 1 << 30));
  const bool parents_first = std::all_of(sorted.begin(), sorted.end(), [&](int node) {
    const int parent = nodes.parents[node];
    return parent < 0 || place[parent] < place[node];
  });
  if (!parents_first) {
    sorted.clear();
    for (const int node : nodes.order)
      if (place[node] >= 0) sorted.push_back(node);
  }

  joints.of_node.assign(nodes.values.size(), -1);
  joints.of_skin_joint.assign(items.size(), -1);
  std::set<std::string> names;
  for (const int node : sorted) {
    const JsonValue& value = nodes.values[node];
    if (isBoneEnd(value)) {
      joints.have_ends = true;
      joints.of_node[node] = kBoneEnd;
      continue;
    }
    const int index = static_cast<int>(joints.skeleton.joints.size()), above = nodes.parents[node];
    Joint joint;
    joint.name = value.at("name").asString();
    if (!names.insert(joint.name).second)
      value.at("name").fail("\"" + joint.name + "\" is the name of two joints");
    joint.parent = above < 0 ? -1 : joints.of_node[above];
    if (joint.parent < 0 && index > 0) {
      if (above >= 0) value.fail("the joint \"" + joint.name + "\" hangs on a node that is no joint");
      value.fail("the joint \"" + joint.name + "\" is a second root");
    }
    const Affine3d& rest = nodes.model_from_node[node];
    const Affine3d parent = above < 0 ? Affine3d::Identity() : nodes.model_from_node[above];
    if (!isRigid(rest) || !isRigid(parent))
      value.fail("the joint \"" + joint.name +
                 "\" is scaled in the rest pose; apply the scale before export");
    joints.axes.push_back(Quaterniond(rest.linear()).normalized());
    joints.model_from_parent.push_back(parent);
    joint.position = rest.translation();
    // A joint's place is a sum of floats.
    constexpr double kRounding = 1e-5;
    if (!(joint.position.cwiseAbs().maxCoeff() <= kFarthest * (1 + kRounding)))
      value.fail("the joint \"" + joint.name + "\" is farther than 1e6 from the origin");
    joint.position = joint.position.cwiseMax(-kFarthest).cwiseMin(kFarthest);
    if (const auto extras = value.find("extras"); extras && extras->isObject())
      if (const auto tail = numbersAt(*extras, "tail", 3))
        joint.tail = Vector3d((*tail)[0], (*tail)[1], (*tail)[2]);
    if (joint.tail && !(joint.tail->cwiseAbs().maxCoeff() <= kFarthest))
      value.fail("the tail of the joint \"" + joint.name + "\" is farther than 1e6 from the origin");
    joint.confidence = 1;
    joint.origin = JointOrigin::kEdited;
    joints.of_node[node] = index;
    joints.of_skin_joint[place[node]] = index;
    joints.skeleton.joints.push_back(std::move(joint));
  }
  if (joints.skeleton.joints.empty()) list.fail("holds nothing but ends of bones");
  joints.skeleton.template_name = templateOf(joints.skeleton);
  return joints;
}

// The skin must have been bound where the nodes stand.
void checkInverseBind(const GlbContainer& glb, const JsonValue& skin, const Joints& joints) {
  const std::optional<JsonValue> index = skin.find("inverseBindMatrices");
  if (!index) skin.fail("has no inverse bind matrices");
  const GlbContainer::Numbers matrices = glb.numbers(*index, 16);
  if (matrices.count != joints.of_skin_joint.size())
    index->fail("are " + std::to_string(matrices.count) + ", there are " +
                std::to_string(joints.of_skin_joint.size()) + " joints");
  for (std::size_t k = 0; k < matrices.count; ++k) {
    if (joints.of_skin_joint[k] < 0) continue;
    const Joint& joint = joints.skeleton.joints[joints.of_skin_joint[k]];
    const Eigen::Matrix3d turn = joints.axes[joints.of_skin_joint[k]].conjugate().toRotationMatrix();
    Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
    expected.topLeftCorner<3, 3>() = turn;
    expected.col(3).head<3>() = -turn * joint.position;
    const Eigen::Matrix4d matrix =
        Eigen::Map<const Eigen::Matrix4f>(matrices.values.data() + 16 * k).cast<double>();
    if (!((matrix - expected).cwiseAbs().maxCoeff() <= kRigid * (1 + joint.position.norm())))
      index->fail("that of \"" + joint.name + "\" is not where its node stands; export in the rest pose");
  }
}

void readTriangles(const GlbContainer& glb, const JsonValue& primitive, TriangleMesh& mesh) {
  const JsonValue index = primitive.at("indices");
  const std::vector<std::uint32_t> corners = glb.wholes(index, 1);
  if (corners.size() % 3 != 0)
    index.fail("has " + std::to_string(corners.size()) + " corners, no multiple of 3");
  mesh.triangles.resize(static_cast<Eigen::Index>(corners.size() / 3), 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] >= static_cast<std::uint32_t>(mesh.vertices.rows()))
      index.fail("triangle " + std::to_string(i / 3) + " has vertex " + std::to_string(corners[i]) + " of " +
                 std::to_string(mesh.vertices.rows()));
    mesh.triangles(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) =
        static_cast<int>(corners[i]);
  }
}

JsonValue imageOf(const GlbContainer& glb, const JsonValue& texture) {
  return glb.element("images", glb.element("textures", texture.at("index")).at("source"));
}

// What glb.cpp of the export room writes: a share of the texture shines, light gives the rest. Blender makes
// two textures with one image of it.
bool shinesInPart(const GlbContainer& glb, const JsonValue& material, const JsonValue& pbr,
                  const std::vector<double>& factor) {
  const std::optional<JsonValue> shine = material.find("emissiveTexture"),
                                 base = pbr.find("baseColorTexture");
  const auto share = numbersAt(material, "emissiveFactor", 3);
  if (!shine || !base || !share || imageOf(glb, *shine).path() != imageOf(glb, *base).path()) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(factor[k] + (*share)[k] - 1) > 1e-6) return false;
  return factor[3] == 1;
}

// What shines by itself adds to what the light shows. White needs no texture.
void wearPlainColor(const JsonValue& material, const std::vector<double>& factor, TriangleMesh& mesh) {
  const std::vector<double> shine = numbersAt(material, "emissiveFactor", 3).value_or(std::vector<double>(3));
  std::array<std::uint8_t, 3> rgb{};
  for (std::size_t k = 0; k < 3; ++k) rgb[k] = srgbFromLinear(static_cast<float>(factor[k] + shine[k]));
  if (rgb == std::array<std::uint8_t, 3>{255, 255, 255}) return;
  mesh.texture = plainTexture(rgb);
  mesh.uv.setConstant(mesh.vertices.rows(), 2, 0.5f);
}

void readTexture(const GlbContainer& glb, const JsonValue& primitive, const std::string& file,
                 TriangleMesh& mesh) {
  const std::optional<JsonValue> material_index = primitive.find("material");
  if (!material_index) return;
  const JsonValue material = glb.element("materials", *material_index);
  const std::optional<JsonValue> pbr = material.find("pbrMetallicRoughness");
  if (!pbr) return;
  const std::optional<JsonValue> found = pbr->find("baseColorTexture");
  if (const auto factor = numbersAt(*pbr, "baseColorFactor", 4)) {
    if (!found && !material.find("emissiveTexture")) return wearPlainColor(material, *factor, mesh);
    if (*factor != std::vector<double>(4, 1) && !shinesInPart(glb, material, *pbr, *factor))
      pbr->at("baseColorFactor").fail("is not read beside a picture; put the colour into the picture");
  }
  if (!found) return;
  const JsonValue image = imageOf(glb, *found);
  if (image.find("uri")) image.at("uri").fail("lies outside of the file; export as one .glb");
  if (const auto set = found->find("texCoord"); set && set->asInt(0, 1 << 20) != 0)
    set->fail("is not read; use the first set of texture coordinates");
  const std::optional<JsonValue> uv = primitive.at("attributes").find("TEXCOORD_0");
  if (!uv) primitive.at("attributes").fail("lacks \"TEXCOORD_0\", which the texture needs");
  const GlbContainer::Numbers coordinates = glb.numbers(*uv, 2);
  if (coordinates.count != static_cast<std::size_t>(mesh.vertices.rows()))
    uv->fail("has " + std::to_string(coordinates.count) + " elements, there are " +
             std::to_string(mesh.vertices.rows()) + " vertices");
  mesh.uv = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>>(
      coordinates.values.data(), mesh.vertices.rows(), 2);
  mesh.texture = decodeImage(glb.view(image.at("bufferView")), file + ": " + image.path());
}

TriangleMesh readMesh(const GlbContainer& glb, const JsonValue& primitive, const std::string& file) {
  if (const auto mode = primitive.find("mode"); mode && mode->asInt(0, 6) != 4)
    mode->fail("must be triangles (4)");
  if (primitive.find("targets")) primitive.at("targets").fail("is not read; export without morph targets");
  TriangleMesh mesh;
  const GlbContainer::Numbers positions = glb.numbers(primitive.at("attributes").at("POSITION"), 3);
  mesh.vertices = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(
      positions.values.data(), static_cast<Eigen::Index>(positions.count), 3);
  if (!(mesh.vertices.cwiseAbs().maxCoeff() <= float(kFarthest)))
    primitive.at("attributes").at("POSITION").fail("has a vertex farther than 1e6 from the origin");
  if ((mesh.vertices.rowwise() - mesh.vertices.row(0)).isZero(0))
    primitive.at("attributes").at("POSITION").fail("has all vertices at one place");
  const Eigen::RowVector3f size = mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff();
  if (!(size.y() * kMaxWidth > size.maxCoeff()))
    primitive.at("attributes")
        .at("POSITION")
        .fail("is flat: it has no height along y; turn it so that y points up");
  readTriangles(glb, primitive, mesh);
  readTexture(glb, primitive, file, mesh);
  return mesh;
}

SkinWeights readWeights(const GlbContainer& glb, const JsonValue& primitive, const Joints& joints,
                        std::size_t vertices) {
  const JsonValue attributes = primitive.at("attributes");
  if (const auto more = attributes.find("JOINTS_1"))
    more->fail("is not read; export with at most 4 influences");
  const JsonValue joints_index = attributes.at("JOINTS_0"), weights_index = attributes.at("WEIGHTS_0");
  const std::vector<std::uint32_t> indices = glb.wholes(joints_index, 4);
  const GlbContainer::Numbers weights = glb.numbers(weights_index, 4);
  if (indices.size() != 4 * vertices || weights.count != vertices)
    (indices.size() != 4 * vertices ? joints_index : weights_index)
        .fail("must have an element for each of the " + std::to_string(vertices) + " vertices");
  SkinWeights result;
  result.joints.setZero(static_cast<Eigen::Index>(vertices), 4);
  result.weights.setZero(static_cast<Eigen::Index>(vertices), 4);
  for (std::size_t v = 0; v < vertices; ++v) {
    struct Share {
      float weight;
      std::uint16_t joint;
    };
    std::array<Share, 4> shares{};
    float sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const float weight = weights.values[4 * v + k];
      const std::uint32_t joint = indices[4 * v + k];
      if (weight < 0) weights_index.fail("vertex " + std::to_string(v) + " has a negative weight");
      if (weight == 0) continue;
      if (joint >= joints.of_skin_joint.size())
        joints_index.fail("vertex " + std::to_string(v) + " has joint " + std::to_string(joint) + " of " +
                          std::to_string(joints.of_skin_joint.size()));
      if (joints.of_skin_joint[joint] < 0)
        joints_index.fail("vertex " + std::to_string(v) + " is moved by the end of a bone");
      shares[k] = {weight, static_cast<std::uint16_t>(joints.of_skin_joint[joint])};
      sum += weight;
    }
    if (!(sum > 1e-6f)) weights_index.fail("vertex " + std::to_string(v) + " has no weights");
    if (!(std::abs(sum - 1) < 1e-5f))
      for (Share& share : shares) share.weight /= sum;
    std::stable_sort(shares.begin(), shares.end(),
                     [](const Share& a, const Share& b) { return a.weight > b.weight; });
    for (std::size_t k = 0; k < 4; ++k) {
      result.joints(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(k)) = shares[k].joint;
      result.weights(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(k)) = shares[k].weight;
    }
  }
  return result;
}

// What encodeGlb() writes of the line around a figure.
bool isInkHull(const GlbContainer& glb, const JsonValue& primitive) {
  const std::optional<JsonValue> index = primitive.find("material");
  if (!index) return false;
  const std::optional<JsonValue> extras = glb.element("materials", *index).find("extras");
  return extras && extras->isObject() && extras->find("ink_hull");
}

// `height`: of the model, m.
InkLine readInk(const JsonValue& node, double height) {
  const std::optional<JsonValue> extras = node.find("extras");
  if (!extras || !extras->isObject()) return {};
  const std::optional<JsonValue> ink = extras->find("ink");
  if (!ink || !ink->isObject() || !ink->find("width_m") || !ink->find("rgb")) return {};
  InkLine line;
  line.width_m = static_cast<float>(ink->at("width_m").asNumber(0, height));
  const std::vector<double> rgb = ink->at("rgb").asNumbers(3);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(rgb[k] >= 0 && rgb[k] <= 255)) ink->at("rgb").fail("must be from 0 to 255");
    line.rgb[static_cast<Eigen::Index>(k)] = static_cast<float>(rgb[k]);
  }
  return line;
}

// A drawing's model is parted in the file where front and back wear different parts of the texture.
void makeWhole(RiggedCharacter& character) {
  std::optional<TriangleMesh> whole = joinSeams(character.mesh);
  if (!whole) return;
  SkinWeights& weights = character.weights;
  const std::vector<int> source = splitSeams(*whole).source;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (weights.joints.row(row) != weights.joints.row(source[i]) ||
        weights.weights.row(row) != weights.weights.row(source[i]))
      return;
  }
  const Eigen::Index count = whole->vertices.rows();
  weights.joints.conservativeResize(count, Eigen::NoChange);
  weights.weights.conservativeResize(count, Eigen::NoChange);
  whole->texture = std::move(character.mesh.texture);
  character.mesh = std::move(*whole);
}

std::vector<float> readTimes(const GlbContainer& glb, const JsonValue& index) {
  const std::vector<float> times = glb.numbers(index, 1).values;
  for (std::size_t i = 0; i < times.size(); ++i)
    if (times[i] < 0 || (i > 0 && times[i] <= times[i - 1]))
      index.fail("time " + std::to_string(i) +
                 (times[i] < 0 ? " is negative" : " is not later than the one before"));
  if (!times.empty() && times.back() > static_cast<float>(kMaxClip_s))
    index.fail("ends after more than an hour; cut the animation into parts");
  return times;
}

std::vector<Vector3f> vectors(const GlbContainer::Numbers& numbers) {
  std::vector<Vector3f> result;
  for (std::size_t i = 0; i < numbers.count; ++i)
    result.push_back(Eigen::Map<const Vector3f>(numbers.values.data() + 3 * i));
  return result;
}

// From the joint's own axes to the model's: even ones as they are, others only where the axes are the model's
// but for their order.
std::vector<Vector3f> scalesInModel(std::vector<Vector3f> scales, const Quaterniond& axes,
                                    const JsonValue& output) {
  const Eigen::Matrix3d turn = axes.toRotationMatrix().cwiseAbs(), order = turn.array().round();
  const bool along_axes = (turn - order).cwiseAbs().maxCoeff() <= kRigid;
  for (std::size_t i = 0; i < scales.size(); ++i) {
    Vector3f& scale = scales[i];
    if (scale.maxCoeff() - scale.minCoeff() <= kRigid * scale.cwiseAbs().maxCoeff()) continue;
    if (!along_axes)
      output.fail("element " + std::to_string(i) +
                  " scales a turned joint unevenly, which is not read; apply rotation before export");
    scale = order.cast<float>() * scale;
  }
  return scales;
}

std::vector<Eigen::Quaternionf> quaternions(const GlbContainer::Numbers& numbers, const JsonValue& output) {
  std::vector<Eigen::Quaternionf> result;
  for (std::size_t i = 0; i < numbers.count; ++i) {
    const float* q = numbers.values.data() + 4 * i;
    result.emplace_back(q[3], q[0], q[1], q[2]);
    if (!(std::abs(result.back().norm() - 1) < 1e-2f))
      output.fail("element " + std::to_string(i) + " is not a unit quaternion");
  }
  return result;
}

// `keys` counts those of all clips so far: channels may share their numbers.
Clip readClip(const GlbContainer& glb, const JsonValue& animation, const RiggedCharacter& character,
              const Joints& joints, float height, const std::string& otherwise, std::size_t& keys) {
  Clip clip;
  const std::optional<JsonValue> name = animation.find("name");
  clip.name = name ? name->asString() : otherwise;
  if (const auto extras = animation.find("extras"); extras && extras->isObject())
    if (const auto loop = extras->find("loop")) clip.loops = loop->isBool() && loop->asBool();
  const std::vector<JsonValue> samplers = animation.at("samplers").items();
  if (samplers.empty()) animation.at("samplers").fail("is empty");
  const std::vector<Joint>& all = character.skeleton.joints;
  std::set<std::pair<int, std::string>> moved;
  std::vector<int> tracks(all.size(), -1);
  for (const JsonValue& channel : animation.at("channels").items()) {
    const JsonValue target = channel.at("target"), path = target.at("path");
    const int joint = joints.of_node[static_cast<std::size_t>(
        target.at("node").asInt(0, static_cast<int>(joints.of_node.size()) - 1))];
    if (joint == kBoneEnd) continue;  // other programs write a track for every joint
    if (joint < 0) target.at("node").fail("is no joint of the skin");
    const std::string kind = path.asString();
    if (kind != "rotation" && kind != "translation" && kind != "scale")
      path.fail("\"" + kind + "\" is not read");
    if (!moved.emplace(joint, kind).second) target.fail("is moved by two channels");
    const JsonValue& sampler = samplers[static_cast<std::size_t>(
        channel.at("sampler").asInt(0, static_cast<int>(samplers.size()) - 1))];
    if (const auto way = sampler.find("interpolation"); way && way->asString() != "LINEAR")
      way->fail(way->asString() + " is not read; export with LINEAR interpolation (baked)");
    const std::vector<float> times = readTimes(glb, sampler.at("input"));
    keys += times.size();
    if (keys > kMaxKeys)
      sampler.at("input").fail("brings all clips to more than " + std::to_string(kMaxKeys / 1'000'000) +
                               " million keys; export fewer animations, or fewer keys");
    const JsonValue output = sampler.at("output");
    const GlbContainer::Numbers values = glb.numbers(output, kind == "rotation" ? 4 : 3);
    if (values.count != times.size())
      output.fail("has " + std::to_string(values.count) + " elements for " + std::to_string(times.size()) +
                  " times");
    if (kind == "translation" && joint == 0) {
      if (!(height > 0)) path.fail("cannot be measured by the height of a model that has none");
      clip.root_times_s = times;
      clip.root_translations = vectors(values);
      const Eigen::Affine3f model_from_parent = joints.model_from_parent[0].cast<float>();
      const Vector3f rest = all[0].position.cast<float>();
      for (Vector3f& at : clip.root_translations) at = (model_from_parent * at - rest) / height;
      continue;
    }
    if (tracks[joint] < 0) {
      tracks[joint] = static_cast<int>(clip.tracks.size());
      clip.tracks.emplace_back().joint = all[joint].name;
    }
    JointTrack& track = clip.tracks[static_cast<std::size_t>(tracks[joint])];
    const Quaterniond model_axes =
        Quaterniond(joints.model_from_parent[joint].linear()).normalized();  // from those of the parent
    if (kind == "rotation") {
      track.times_s = times;
      track.rotations = quaternions(values, output);
      for (Eigen::Quaternionf& rotation : track.rotations)
        rotation = (model_axes * rotation.cast<double>() * joints.axes[joint].conjugate())
                       .normalized()
                       .cast<float>();
    } else if (kind == "translation") {
      track.translation_times_s = times;
      track.translations_m = vectors(values);
      const Vector3f rest = (all[joint].position - all[all[joint].parent].position).cast<float>();
      for (Vector3f& at : track.translations_m) at = model_axes.cast<float>() * at - rest;
    } else {
      track.scale_times_s = times;
      track.scales = scalesInModel(vectors(values), joints.axes[joint], output);
    }
  }
  return clip;
}

}  // namespace

CharacterFile decodeGlb(std::string_view bytes, const std::string& file) {
  const GlbContainer glb(bytes, file);
  if (const auto needed = glb.root().find("extensionsRequired"); needed && !needed->items().empty())
    needed->fail("names \"" + needed->items()[0].asString() + "\", which is not read");
  const Nodes nodes(glb);
  const JsonValue& node = nodes.values[static_cast<std::size_t>(skinnedNode(glb, nodes))];
  const JsonValue mesh = glb.element("meshes", node.at("mesh"));
  std::vector<JsonValue> primitives = mesh.at("primitives").items();
  const std::size_t all = primitives.size();
  std::erase_if(primitives, [&](const JsonValue& primitive) { return isInkHull(glb, primitive); });
  if (primitives.size() != 1)
    mesh.at("primitives")
        .fail("has " + std::to_string(primitives.size()) + " elements, one is read: use one material");
  const JsonValue skin = glb.element("skins", node.at("skin"));

  CharacterFile result;
  RiggedCharacter& character = result.character;
  character.mesh = readMesh(glb, primitives[0], file);
  const Joints joints = readJoints(nodes, skin);
  checkInverseBind(glb, skin, joints);
  character.skeleton = joints.skeleton;
  character.weights =
      readWeights(glb, primitives[0], joints, static_cast<std::size_t>(character.mesh.vertices.rows()));
  makeWhole(character);
  const auto heights = character.mesh.vertices.col(1);
  const float height = heights.maxCoeff() - heights.minCoeff();
  character.mesh.ink = readInk(node, double(height));
  if (const auto extras = node.find("extras"); extras && extras->isObject())
    if (const auto facing = extras->find("facing_deg"))
      character.facing = Facing::at(facing->asNumber(-180, 180) * std::numbers::pi / 180);
  if (const auto animations = glb.root().find("animations")) {
    const std::vector<JsonValue> items = animations->items();
    if (items.size() > kMostClips)
      animations->fail("are " + std::to_string(items.size()) + ", at most " + std::to_string(kMostClips) +
                       " are read; export fewer");
    std::size_t keys = 0;
    for (std::size_t i = 0; i < items.size(); ++i)
      result.clips.push_back(
          readClip(glb, items[i], character, joints, height, "clip " + std::to_string(i + 1), keys));
  }
  result.bones = joints.style();
  result.ink_hull = primitives.size() < all;
  if (const auto name = mesh.find("name")) result.name = name->asString();
  return result;
}

std::string generatorOfGlb(const std::string& path) {
  const LookAtOutputs look;
  try {
    const std::string bytes = readFile(path);
    const GlbContainer glb(bytes, path);
    const auto generator = glb.root().at("asset").find("generator");
    return generator ? generator->asString() : "";
  } catch (const Error&) {
    return "";
  }
}

CharacterFile readGlb(const std::string& path) { return decodeGlb(readFile(path), path); }

}  // namespace skel
