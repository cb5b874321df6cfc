#include "labeler/char_cfg.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "libskel/core/error.h"

namespace skel {
namespace {

struct Line {
  int number;
  std::string_view text;  // without indentation, dash and comment
  bool starts_entry;      // had a dash before it
};

std::string_view trimmed(std::string_view s) {
  const size_t first = s.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
}

std::string_view unquoted(std::string_view s) {
  s = trimmed(s);
  if (s.size() >= 2 && (s.front() == '"' || s.front() == '\'') && s.back() == s.front())
    return s.substr(1, s.size() - 2);
  return s;
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& file) : file_(file) {
    int number = 0;
    while (!text.empty()) {
      const size_t end = text.find('\n');
      split(text.substr(0, end), ++number);
      text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    }
  }

  CharCfg read() {
    while (!atEnd()) {
      const auto [key, value] = keyAndValue();
      if (key == "width") {
        cfg_.width = size(value);
      } else if (key == "height") {
        cfg_.height = size(value);
      } else if (key == "skeleton") {
        readJoints();
      } else if (key == "skel_found_mask") {
        cfg_.found_mask_sha256 = unquoted(value);
      } else {
        fail("unknown key '" + std::string(key) + "'");
      }
    }
    if (cfg_.width == 0 || cfg_.height == 0) throw InputError(file_, "width and height are missing");
    if (cfg_.joints.empty()) throw InputError(file_, "has no skeleton");
    return std::move(cfg_);
  }

 private:
  void split(std::string_view text, int number) {
    if (const size_t comment = text.find('#'); comment != std::string_view::npos)
      text = text.substr(0, comment);
    text = trimmed(text);
    if (text.empty() || text == "---") return;
    const bool dash = text == "-" || text.starts_with("- ");
    lines_.push_back({number, dash ? trimmed(text.substr(1)) : text, dash});
  }

  bool atEnd() const { return next_ == lines_.size(); }

  [[noreturn]] void fail(const std::string& problem) const {
    const int number = lines_.empty() ? 1 : lines_[next_ == 0 ? 0 : next_ - 1].number;
    throw InputError(file_, "line " + std::to_string(number) + ": " + problem);
  }

  std::pair<std::string_view, std::string_view> keyAndValue() {
    const std::string_view text = lines_[next_++].text;
    const size_t colon = text.find(':');
    if (colon == std::string_view::npos) fail("expected 'key: value'");
    return {unquoted(text.substr(0, colon)), trimmed(text.substr(colon + 1))};
  }

  double number(std::string_view text) const {
    text = trimmed(text);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
      fail("expected a number, found '" + std::string(text) + "'");
    return value;
  }

  int size(std::string_view text) const {
    const double value = number(text);
    if (value < 1 || value > 100'000 || value != std::floor(value)) fail("expected a size in px");
    return static_cast<int>(value);
  }

  // [x, y] in the same line, or two entries of a list below.
  Eigen::Vector2d location(std::string_view value) {
    if (value.empty()) {
      Eigen::Vector2d p;
      for (double& coordinate : p) {
        if (atEnd() || !lines_[next_].starts_entry) fail("loc needs two numbers");
        coordinate = number(lines_[next_++].text);
      }
      return p;
    }
    const size_t comma = value.find(',');
    if (value.front() != '[' || value.back() != ']' || comma == std::string_view::npos)
      fail("loc needs two numbers");
    return {number(value.substr(1, comma - 1)), number(value.substr(comma + 1, value.size() - comma - 2))};
  }

  void readJoints() {
    while (!atEnd() && lines_[next_].starts_entry) {
      std::optional<Eigen::Vector2d> loc, found;
      std::string name;
      bool first = true;
      while (!atEnd() && (first || !lines_[next_].starts_entry) && isJointKey()) {
        first = false;
        const auto [key, value] = keyAndValue();
        if (key == "loc") loc = location(value);
        if (key == "skel_found") found = location(value);
        if (key == "name") name = unquoted(value);
      }
      if (first) {
        ++next_;
        fail("expected loc, name and parent of a joint");
      }
      if (!loc || name.empty()) fail("a joint needs loc and name");
      if (!names_.insert(name).second) fail("the joint '" + name + "' is there twice");
      cfg_.joints.emplace_back(name, *loc);
      if (found == loc) cfg_.found.push_back(name);
    }
  }

  bool isJointKey() const {
    const std::string_view key = unquoted(lines_[next_].text.substr(0, lines_[next_].text.find(':')));
    return key == "loc" || key == "name" || key == "parent" || key == "skel_found";
  }

  const std::string& file_;
  std::vector<Line> lines_;
  size_t next_ = 0;
  std::set<std::string> names_;  // of the joints
  CharCfg cfg_;
};

}  // namespace

CharCfg parseCharCfg(std::string_view text, const std::string& file) { return Reader(text, file).read(); }

const std::vector<std::pair<std::string, std::string>>& charCfgJointNames() {
  static const std::vector<std::pair<std::string, std::string>> names = [] {
    std::vector<std::pair<std::string, std::string>> n = {
        {"neck", "head"}, {"torso", "neck"}, {"root", "pelvis"}};
    for (const char* side : {"left_", "right_"})
      for (const char* joint : {"shoulder", "elbow", "hand", "hip", "knee", "foot"}) {
        const std::string name = std::string(side) + joint;
        n.emplace_back(name, name);
      }
    return n;
  }();
  return names;
}

}  // namespace skel
