// COCO keypoint annotations (cocodataset.org/#format-data). Its polygons count from the corner of the top
// left pixel, ours from its centre; keypoints are pixels in both.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <utility>

#include "labeler/annotated_drawing.h"
#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/json.h"
#include "libskel/core/json_names.h"
#include "libskel/labels/coco_of_others.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kPersonKeypoints = {
    "nose",           "left_eye",   "right_eye",   "left_ear",   "right_ear",   "left_shoulder",
    "right_shoulder", "left_elbow", "right_elbow", "left_wrist", "right_wrist", "left_hip",
    "right_hip",      "left_knee",  "right_knee",  "left_ankle", "right_ankle"};

// Of places in pictures, each way; and of how far the lines go up and down that outline one figure, in sum.
constexpr double kFarthest_px = 1e6, kLongestOutline_px = 2e7;

double placeAt(const JsonValue& list, double number) {
  if (!(std::abs(number) <= kFarthest_px)) list.fail("holds a place that lies in no picture");
  return number;
}

using Points = std::map<std::string, Eigen::Vector2d>;

std::string ownName(std::string name) {
  if (const size_t at = name.find("_wrist"); at != std::string::npos) name.replace(at, 6, "_hand");
  if (const size_t at = name.find("_ankle"); at != std::string::npos) name.replace(at, 6, "_foot");
  return name;
}

std::vector<std::string> unknownNames(const Points& points, const SkeletonTemplate& body_plan) {
  std::vector<std::string> unknown;
  for (const auto& [name, point] : points)
    if (body_plan.find(ownName(name)) < 0 &&
        std::find(kPersonKeypoints.begin(), kPersonKeypoints.end(), name) == kPersonKeypoints.end())
      unknown.push_back(name);
  return unknown;
}

// The keypoints of people under our names: hands for wrists, feet for ankles, the head at the nose, or
// between eyes or ears where it is turned away, the body between shoulders and hips.
NamedJoints underOurNames(const Points& theirs, const SkeletonTemplate& body_plan) {
  Points points;
  for (const auto& [name, point] : theirs) points[ownName(name)] = point;
  const auto middle = [&](const std::string& ours, const std::vector<std::string>& of) {
    if (points.contains(ours)) return;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const std::string& name : of) {
      if (!points.contains(name)) return;
      sum += points.at(name);
    }
    points[ours] = sum / static_cast<double>(of.size());
  };
  middle("head", {"nose"});
  middle("head", {"left_eye", "right_eye"});
  middle("head", {"left_ear", "right_ear"});
  middle("body", {"left_shoulder", "right_shoulder", "left_hip", "right_hip"});
  NamedJoints ours;
  for (const TemplateJoint& joint : body_plan.joints)
    if (const auto point = points.find(joint.name); point != points.end())
      ours.emplace_back(joint.name, point->second);
  return ours;
}

Points keypoints(const JsonValue& annotation, const std::vector<std::string>& names) {
  const JsonValue list = annotation.at("keypoints");
  const std::vector<double> numbers = list.asNumbers();
  if (numbers.size() != 3 * names.size())
    list.fail("expected " + std::to_string(names.size()) + " times x, y, visibility");
  Points points;
  for (size_t i = 0; i < names.size(); ++i)
    if (numbers[3 * i + 2] > 0)
      points[names[i]] = {placeAt(list, numbers[3 * i]), placeAt(list, numbers[3 * i + 1])};
  return points;
}

// Joints of our names that no person has placed, for a drawing that has its keypoints: none of `points`,
// maybe one that was put between some of them.
void takeFound(const JsonValue& annotation, const Points& points, const SkeletonTemplate& body_plan,
               AnnotatedDrawing& drawing) {
  const std::optional<JsonValue> list = annotation.find("skel_found");
  if (!list) return;
  for (const std::string& name : list->keys()) {
    const JsonValue place = list->at(name);
    if (body_plan.find(name) < 0) place.fail("is no joint of the template " + body_plan.name);
    if (points.contains(name)) place.fail("is among the keypoints, too");
    std::erase_if(drawing.joints, [&](const auto& joint) { return joint.first == name; });
    const std::vector<double> xy = place.asNumbers(2);
    drawing.joints.emplace_back(name, Eigen::Vector2d(placeAt(place, xy[0]), placeAt(place, xy[1])));
    drawing.recognized.push_back(name);
  }
}

std::vector<Polygon> polygons(const JsonValue& annotation) {
  const std::optional<JsonValue> segmentation = annotation.find("segmentation");
  if (!segmentation) return {};
  if (!segmentation->isArray()) segmentation->fail("run lengths are not read: give polygons");
  std::vector<Polygon> result;
  double length_px = 0;
  for (const JsonValue& item : segmentation->items()) {
    const std::vector<double> numbers = item.asNumbers();
    if (numbers.size() < 6 || numbers.size() % 2 != 0) item.fail("expected x, y of at least three corners");
    Polygon polygon;
    for (size_t i = 0; i < numbers.size(); i += 2)
      polygon.emplace_back(placeAt(item, numbers[i]) - 0.5, placeAt(item, numbers[i + 1]) - 0.5);
    for (size_t i = 0; i < polygon.size(); ++i)
      length_px += std::abs(polygon[i].y() - polygon[(i + 1) % polygon.size()].y());
    if (length_px > kLongestOutline_px) segmentation->fail("outlines no figure: its lines are too long");
    result.push_back(std::move(polygon));
  }
  return result;
}

// px; 0: it is not told.
int sideOf(const JsonValue& image, const char* side) {
  constexpr int kLongest_px = 1'000'000;
  const std::optional<JsonValue> length = image.find(side);
  return length ? length->asInt(0, kLongest_px) : 0;
}

double boxArea(const JsonValue& annotation) {
  const std::optional<JsonValue> box = annotation.find("bbox");
  if (!box) return 0;
  const std::vector<double> b = box->asNumbers(4);
  return b[2] * b[3];
}

}  // namespace

std::vector<AnnotatedDrawing> readCoco(const std::string& path, const BodyPlans& plans,
                                       const OnInputError& on_error) {
  const JsonDocument document = JsonDocument::readFile(path);
  const JsonValue root = document.root();
  const bool is_export = isExportedCoco(root);

  std::map<double, std::vector<std::string>> names_of;  // by category
  if (const auto categories = root.find("categories"))
    for (const JsonValue& category : categories->items())
      if (const auto names = category.find("keypoints")) {
        std::vector<std::string>& list = names_of[category.at("id").asNumber()];
        for (const JsonValue& name : names->items()) list.push_back(name.asString());
      }

  struct Picture {
    std::string file;  // "": it is missing
    int width, height;
  };
  std::map<double, Picture> picture_of;                     // by image
  std::unordered_map<std::string, std::string> file_named;  // looked for once, however often it is named
  for (const JsonValue& image : root.at("images").items()) {
    const JsonValue name = image.at("file_name");
    const auto [named, is_new] = file_named.try_emplace(name.asFileName());
    if (is_new) {
      // Masks are written beside the pictures.
      named->second = pathInside(fs::path(path).parent_path().string(), named->first, path);
      if (!fs::is_regular_file(named->second)) {
        const std::string missing = std::exchange(named->second, "");
        if (!on_error) name.fail("there is no " + missing);
        on_error(InputError(path, name.path() + ": there is no " + missing));
      }
    }
    picture_of[image.at("id").asNumber()] = {named->second, sideOf(image, "width"), sideOf(image, "height")};
  }

  std::map<std::string, std::pair<double, AnnotatedDrawing>> largest;  // by picture
  for (const JsonValue& annotation : root.at("annotations").items()) {
    if (!annotation.find("keypoints")) continue;
    const JsonValue image_id = annotation.at("image_id");
    const auto found = picture_of.find(image_id.asNumber());
    if (found == picture_of.end()) image_id.fail("is no image of this file");
    const Picture& picture = found->second;
    if (picture.file.empty()) continue;
    const auto category = annotation.find("category_id");
    const auto names = category ? names_of.find(category->asNumber()) : names_of.end();
    AnnotatedDrawing drawing;
    drawing.source = path;
    drawing.image = picture.file;
    drawing.image_width = picture.width;
    drawing.image_height = picture.height;
    const std::vector<std::string>& joint_names = names == names_of.end() ? kPersonKeypoints : names->second;
    const SkeletonTemplate* named_plan = planWith(joint_names, plans);
    const SkeletonTemplate& body_plan = named_plan ? *named_plan : plans.front();
    const Points points = keypoints(annotation, joint_names);
    drawing.joints = underOurNames(points, body_plan);
    drawing.unknown = unknownNames(points, body_plan);
    takeFound(annotation, points, body_plan, drawing);
    drawing.mask_polygons = polygons(annotation);
    if (annotation.find("skel_outline_found")) drawing.mask_polygons.clear();
    drawing.is_export = is_export;
    const double area = boxArea(annotation);
    const auto [other, is_new] = largest.try_emplace(picture.file, area, drawing);
    if (!is_new && area > other->second.first) other->second = {area, std::move(drawing)};
  }
  std::vector<AnnotatedDrawing> drawings;
  for (auto& [file, entry] : largest) drawings.push_back(std::move(entry.second));
  return drawings;
}

std::string formatCoco(const std::vector<CocoPicture>& pictures, const BodyPlans& plans) {
  using Json = nlohmann::ordered_json;
  std::vector<const SkeletonTemplate*> used;  // of categories
  const auto categoryOf = [&](const SkeletonTemplate& plan) {
    const auto index = std::size_t(std::find(used.begin(), used.end(), &plan) - used.begin());
    if (index == used.size()) used.push_back(&plan);
    return index + 1;
  };
  Json images = Json::array(), annotations = Json::array();
  for (size_t i = 0; i < pictures.size(); ++i) {
    const CocoPicture& picture = pictures[i];
    const SkeletonTemplate& body_plan = planOf(picture.joints, plans);
    images.push_back({{"id", i + 1},
                      {"file_name", jsonFromFileName(picture.file_name)},
                      {"width", picture.width},
                      {"height", picture.height}});
    Json points = Json::array(), segmentation = Json::array(), recognized = Json::object();
    int known = 0;
    for (const TemplateJoint& joint : body_plan.joints) {
      const auto named = std::find_if(picture.joints.begin(), picture.joints.end(),
                                      [&](const auto& j) { return j.first == joint.name && j.second; });
      const bool there = named != picture.joints.end();
      const bool placed = there && std::find(picture.recognized.begin(), picture.recognized.end(),
                                             joint.name) == picture.recognized.end();
      points.push_back(placed ? named->second->x() : 0.0);
      points.push_back(placed ? named->second->y() : 0.0);
      points.push_back(placed ? 2 : 0);
      if (there && !placed) recognized[joint.name] = {named->second->x(), named->second->y()};
      known += placed;
    }
    Eigen::AlignedBox2d box;
    for (const Polygon& polygon : picture.mask_polygons) {
      Json corners = Json::array();
      for (const Eigen::Vector2d& corner : polygon) {
        const Eigen::Vector2d p = corner.array() + 0.5;
        box.extend(p);
        corners.push_back(p.x());
        corners.push_back(p.y());
      }
      segmentation.push_back(std::move(corners));
    }
    const Eigen::Vector2d low = box.isEmpty() ? Eigen::Vector2d(0, 0) : box.min();
    const Eigen::Vector2d size = box.isEmpty() ? Eigen::Vector2d(0, 0) : Eigen::Vector2d(box.sizes());
    const auto area = (maskFromPolygons(picture.mask_polygons, picture.width, picture.height) != 0).count();
    annotations.push_back({{"id", i + 1},
                           {"image_id", i + 1},
                           {"category_id", categoryOf(body_plan)},
                           {"iscrowd", 0},
                           {"num_keypoints", known},
                           {"keypoints", std::move(points)},
                           {"bbox", {low.x(), low.y(), size.x(), size.y()}},
                           {"area", area},
                           {"segmentation", std::move(segmentation)}});
    if (!recognized.empty()) annotations.back()["skel_found"] = std::move(recognized);
    if (picture.outline_found) annotations.back()["skel_outline_found"] = true;
  }
  Json categories = Json::array();
  for (const SkeletonTemplate* plan : used) {
    Json names = Json::array(), bones = Json::array();
    for (size_t j = 0; j < plan->joints.size(); ++j) {
      names.push_back(plan->joints[j].name);
      if (plan->joints[j].parent >= 0) bones.push_back({plan->joints[j].parent + 1, j + 1});
    }
    categories.push_back(
        {{"id", categoryOf(*plan)}, {"name", plan->name}, {"keypoints", names}, {"skeleton", bones}});
  }
  return Json{{"info", {{"contributor", kCocoContributor}}},
              {"images", images},
              {"annotations", annotations},
              {"categories", categories}}
             .dump(1) +
         "\n";
}

}  // namespace skel
