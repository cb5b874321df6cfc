#include "libskel/labels/label_file.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <functional>
#include <locale>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/core/json_names.h"
#include "libskel/core/sha256.h"

namespace skel {
namespace {

constexpr const char* kFormat = "skel-labels";
constexpr int kVersion = 2;  // 1: without `recognized`
constexpr int kMaxImageSide = 100'000;
constexpr int kMaxGridSide = 4096;
constexpr std::size_t kMostCandidates = 10'000;  // the densest comb of 128 px has fewer
constexpr std::size_t kMostComplaints = 100;     // kinds of them, of one file; more help nobody

// A complaint without its numbers: the same of every candidate.
std::string kindOf(const InputError& complaint) {
  std::string kind = complaint.problem();
  std::erase_if(kind, [](char c) { return std::string_view("0123456789.-+e").find(c) != std::string::npos; });
  return kind;
}

// Runs each step; the complaints of those that fail are kept, the first of a kind, so that a check can name
// all of them.
class Problems {
 public:
  void attempt(const std::function<void()>& step) {
    if (kinds_.size() >= kMostComplaints) return;
    try {
      step();
    } catch (const InputError& error) {
      const auto [kind, is_new] = kinds_.try_emplace(kindOf(error), kinds_.size());
      if (is_new) complaints_.push_back({error, 0});
      ++complaints_[kind->second].count;
    }
  }
  bool none() const { return complaints_.empty(); }
  const InputError& first() const { return complaints_.front().first; }
  std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    for (const auto& [first, count] : complaints_)
      lines.push_back(first.what() +
                      (count == 1 ? "" : " (and " + std::to_string(count - 1) + " more such)"));
    return lines;
  }

 private:
  struct Complaint {
    InputError first;
    int count;
  };
  std::vector<Complaint> complaints_;
  std::map<std::string, std::size_t> kinds_;  // which of them it is
};

LabelFile::Source readSource(const JsonValue& value) {
  LabelFile::Source source{value.at("file").asFileName(), value.at("sha256").asString()};
  if (source.file.empty() || source.file.find('/') != std::string::npos)
    value.at("file").fail("must be the name of a file in the same folder");
  if (source.sha256.size() != 64 || source.sha256.find_first_not_of("0123456789abcdef") != std::string::npos)
    value.at("sha256").fail("must be 64 hexadecimal digits");
  return source;
}

std::optional<JointClass> readLabel(const JsonValue& value) {
  if (value.isNull()) return std::nullopt;
  const std::string name = value.asString();
  if (const std::optional<JointClass> joint_class = jointClassNamed(name)) return joint_class;
  value.fail("is \"" + name + "\", must be head, body, hand, leg or null");
}

JointCandidate readCandidate(const JsonValue& value, const LabelFile& file) {
  value.allowOnly({"x", "y", "radius", "label"});
  JointCandidate candidate;
  candidate.x = static_cast<float>(value.at("x").asNumber(0, file.grid_width - 1));
  candidate.y = static_cast<float>(value.at("y").asNumber(0, file.grid_height - 1));
  candidate.radius = static_cast<float>(value.at("radius").asNumber(0, file.gridSize()));
  if (candidate.radius <= 0) value.at("radius").fail("must be more than 0");
  return candidate;
}

void readCandidates(const JsonValue& list, LabelFile& file, Problems& problems) {
  if (list.size() > kMostCandidates)
    list.fail("holds " + std::to_string(list.size()) + " candidates; " + std::to_string(kMostCandidates) +
              " are the most");
  std::set<std::pair<float, float>> places;
  for (const JsonValue& item : list.items()) {
    problems.attempt([&] {
      const JointCandidate candidate = readCandidate(item, file);
      if (!places.emplace(candidate.x, candidate.y).second) item.fail("lies where an earlier candidate lies");
      file.candidates.push_back(candidate);
      file.labels.emplace_back();
    });
    problems.attempt([&] {
      const auto label = readLabel(item.at("label"));
      if (!file.labels.empty()) file.labels.back() = label;
    });
  }
}

NamedJoints readJoints(const JsonValue& value, const LabelFile& file) {
  NamedJoints joints;
  for (const std::string& name : value.keys()) {
    const JsonValue place = value.at(name);
    if (place.isNull()) {
      joints.emplace_back(name, std::nullopt);
      continue;
    }
    const auto xy = place.asNumbers(2);
    if (xy[0] < -0.5 || xy[1] < -0.5 || xy[0] > file.image_width - 0.5 || xy[1] > file.image_height - 0.5)
      place.fail("lies outside the image");
    joints.emplace_back(name, Eigen::Vector2d(xy[0], xy[1]));
  }
  return joints;
}

std::vector<std::string> readRecognized(const JsonValue& list, const NamedJoints& joints) {
  std::set<std::string> placed;
  for (const auto& [name, place] : joints)
    if (place) placed.insert(name);
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const JsonValue& item : list.items()) {
    const std::string name = item.asString();
    if (!placed.contains(name)) item.fail("\"" + name + "\" has no place in joints");
    if (seen.insert(name).second) names.push_back(name);
  }
  return names;
}

LabelFile parse(const JsonValue& root, Problems& problems) {
  LabelFile file;
  root.checkFormat(kFormat, kVersion);
  problems.attempt([&] {
    root.allowOnly({"format", "version", "image", "mask", "grid", "candidates", "joints", "recognized"});
  });
  problems.attempt([&] {
    const JsonValue image = root.at("image");
    image.allowOnly({"file", "sha256", "width", "height"});
    file.image_width = image.at("width").asInt(1, kMaxImageSide);
    file.image_height = image.at("height").asInt(1, kMaxImageSide);
    file.image = readSource(image);
  });
  problems.attempt([&] {
    const JsonValue mask = root.at("mask");
    if (mask.isNull()) return;
    mask.allowOnly({"file", "sha256"});
    file.mask = readSource(mask);
  });
  const JsonValue grid = root.at("grid");
  grid.allowOnly({"width", "height"});
  file.grid_width = grid.at("width").asInt(1, kMaxGridSide);
  file.grid_height = grid.at("height").asInt(1, kMaxGridSide);
  problems.attempt([&] { readCandidates(root.at("candidates"), file, problems); });
  problems.attempt([&] {
    const JsonValue joints = root.at("joints");
    if (!joints.isNull()) file.joints = readJoints(joints, file);
    if (const auto recognized = root.find("recognized"))
      file.recognized = readRecognized(*recognized, file.joints);
  });
  return file;
}

LabelFile parseFile(const std::string& path, Problems& problems) {
  LabelFile file;
  problems.attempt([&] {
    const JsonDocument document = JsonDocument::readFile(path);
    file = parse(document.root(), problems);
  });
  return file;
}

void checkSource(const std::string& path, const char* key, const LabelFile::Source& source) {
  const std::string place = std::string(key) + ".file: \"" + source.file + "\"";
  const std::string name = besideLabelFile(path, source.file);
  if (!std::filesystem::is_regular_file(name)) throw InputError(path, place + " is missing");
  if (sha256(readFile(name)) != source.sha256)
    throw InputError(path, place + " has changed since it was labelled; label it anew");
}

void checkNoMaskBeside(const std::string& path, const LabelFile::Source& image) {
  if (const auto mask = maskBeside(besideLabelFile(path, image.file)))
    throw InputError(path,
                     "mask: is null, but " + std::filesystem::path(*mask).filename().string() +
                         " lies beside it; label it anew (skel-label import --force), or remove the mask");
}

template <class Number>
std::string show(Number number) {
  char text[64];
  return std::string(text, std::to_chars(text, text + sizeof text, number).ptr);
}

}  // namespace

bool LabelFile::isPlaced(const std::string& joint) const {
  return std::any_of(joints.begin(), joints.end(),
                     [&](const auto& known) { return known.first == joint && known.second.has_value(); }) &&
         std::find(recognized.begin(), recognized.end(), joint) == recognized.end();
}

bool LabelFile::hasPlacedJoint() const {
  return std::any_of(joints.begin(), joints.end(), [&](const auto& joint) { return isPlaced(joint.first); });
}

bool LabelFile::isBlank() const {
  return !hasPlacedJoint() && !mask &&
         std::none_of(labels.begin(), labels.end(), [](const auto& label) { return label.has_value(); });
}

std::string labelFileFor(const std::string& image) {
  return std::filesystem::path(image).replace_extension().string() + kLabelFileEnding;
}

std::string besideLabelFile(const std::string& label_file, const std::string& name) {
  return (std::filesystem::path(label_file).parent_path() / name).string();
}

std::optional<std::string> maskBeside(const std::string& image) {
  const std::filesystem::path picture = image;
  const std::string named = std::filesystem::path(picture).replace_extension().string() + ".mask.png",
                    own = (picture.parent_path() / "mask.png").string();
  if (std::filesystem::is_regular_file(named)) return named;
  if (picture.stem() == "image" && std::filesystem::is_regular_file(own)) return own;
  return std::nullopt;
}

std::optional<std::string> maskOf(const std::string& label_file, const LabelFile& labels) {
  return labels.mask ? besideLabelFile(label_file, labels.mask->file)
                     : maskBeside(besideLabelFile(label_file, labels.image.file));
}

LabelFile readLabelFile(const std::string& path) {
  Problems problems;
  LabelFile file = parseFile(path, problems);
  if (!problems.none()) throw InputError(problems.first());
  return file;
}

std::vector<std::string> findProblems(const std::string& path) {
  Problems problems;
  const LabelFile file = parseFile(path, problems);
  if (!file.image.file.empty()) problems.attempt([&] { checkSource(path, "image", file.image); });
  if (file.mask)
    problems.attempt([&] { checkSource(path, "mask", *file.mask); });
  else if (problems.none())
    problems.attempt([&] { checkNoMaskBeside(path, file.image); });
  return problems.lines();
}

void ensureUnchanged(const std::string& path, const LabelFile& labels) {
  checkSource(path, "image", labels.image);
  if (labels.mask) checkSource(path, "mask", *labels.mask);
}

bool isBlankLabelFile(const std::string& path) {
  try {
    return readLabelFile(path).isBlank();
  } catch (const InputError&) {
    return false;
  }
}

std::string formatLabelFile(const LabelFile& labels) {
  SKEL_CHECK_EQ(labels.candidates.size(), labels.labels.size());
  const auto quote = [](const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  };
  std::ostringstream out;
  out.exceptions(std::ios::badbit);  // else it swallows the end where memory ends
  out.imbue(std::locale::classic());
  out << "{\n  \"format\": \"" << kFormat
      << "\",\n  \"version\": " << (labels.recognized.empty() ? 1 : kVersion)
      << ",\n  \"image\": {\"file\": " << quote(jsonFromFileName(labels.image.file))
      << ", \"width\": " << labels.image_width << ", \"height\": " << labels.image_height
      << ", \"sha256\": " << quote(labels.image.sha256) << "},\n  \"mask\": ";
  if (labels.mask)
    out << "{\"file\": " << quote(jsonFromFileName(labels.mask->file))
        << ", \"sha256\": " << quote(labels.mask->sha256) << "}";
  else
    out << "null";
  out << ",\n  \"grid\": {\"width\": " << labels.grid_width << ", \"height\": " << labels.grid_height
      << "},\n  \"candidates\": [";
  for (std::size_t i = 0; i < labels.candidates.size(); ++i) {
    const JointCandidate& candidate = labels.candidates[i];
    out << (i ? "," : "") << "\n    {\"x\": " << show(candidate.x) << ", \"y\": " << show(candidate.y)
        << ", \"radius\": " << show(candidate.radius) << ", \"label\": "
        << (labels.labels[i] ? quote(kJointClassNames[static_cast<std::size_t>(*labels.labels[i])]) : "null")
        << "}";
  }
  out << "\n  ],\n  \"joints\": ";
  if (labels.joints.empty()) out << "null";
  for (std::size_t i = 0; i < labels.joints.size(); ++i) {
    const auto& [name, place] = labels.joints[i];
    out << (i ? ",\n    " : "{\n    ") << quote(name) << ": ";
    if (place)
      out << "[" << show(place->x()) << ", " << show(place->y()) << "]";
    else
      out << "null";
  }
  if (!labels.joints.empty()) out << "\n  }";
  for (std::size_t i = 0; i < labels.recognized.size(); ++i)
    out << (i ? ", " : ",\n  \"recognized\": [") << quote(labels.recognized[i]);
  out << (labels.recognized.empty() ? "\n}\n" : "]\n}\n");
  return out.str();
}

void writeLabelFile(const std::string& path, const LabelFile& labels) {
  replaceFile(path, formatLabelFile(labels));
}

}  // namespace skel
