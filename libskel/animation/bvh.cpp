#include "libskel/animation/bvh.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "libskel/animation/clip_limits.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/number_chars.h"
#include "libskel/core/text.h"

namespace skel {
namespace {

constexpr std::size_t kMaxJoints = 1000;
constexpr std::size_t kMaxNumbers = 100'000'000;     // of the motion
constexpr std::size_t kMaxJointFrames = 10'000'000;  // frames times joints, with channels or without: 1 GB
constexpr double kMaxNumber = 1e9;  // ours are in centimetres, and models reach a million metres
constexpr double kMaxFrameTime_s = 100;
constexpr std::array<std::string_view, 6> kChannels = {"Xposition", "Yposition", "Zposition",
                                                       "Xrotation", "Yrotation", "Zrotation"};

// The words of a text, with the lines that they stand on.
class Words {
 public:
  Words(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  // Empty at the end.
  std::string_view next() {
    skipBlanks();
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n", at_), text_.size());
    const std::string_view word = text_.substr(at_, end - at_);
    at_ = end;
    return word;
  }

  // What is left of the line: names may hold blanks.
  std::string_view restOfLine() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view rest = text_.substr(at_, end - at_);
    at_ = end;
    while (!rest.empty() && std::string_view(" \t\r").find(rest.front()) != std::string_view::npos)
      rest.remove_prefix(1);
    while (!rest.empty() && std::string_view(" \t\r").find(rest.back()) != std::string_view::npos)
      rest.remove_suffix(1);
    return rest;
  }

  void expect(std::string_view wanted) {
    const std::string_view word = next();
    if (word != wanted) fail("has " + shown(word) + " where \"" + std::string(wanted) + "\" should be");
  }

  double number(double most = kMaxNumber) {
    const std::string_view word = next();
    double value = 0;
    const auto [end, error] = from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size() ||
        !(std::abs(value) <= most))
      fail("has " + shown(word) + " where a number should be");
    return value;
  }

  std::size_t count(std::size_t most) {
    const double value = number(1e15);
    if (!(value >= 0 && value <= double(most) && value == std::floor(value)))
      fail("has a count outside 0 to " + std::to_string(most));
    return std::size_t(value);
  }

  bool atEnd() {
    skipBlanks();
    return at_ == text_.size();
  }

  static std::string shown(std::string_view word) {
    return word.empty() ? "its end" : "\"" + std::string(word.substr(0, 40)) + "\"";
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(file_, "line " + std::to_string(line_) + ": " + problem);
  }

 private:
  void skipBlanks() {
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n')
        ++line_;
      else if (text_[at_] != ' ' && text_[at_] != '\t' && text_[at_] != '\r')
        break;
    }
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0, line_ = 1;
};

struct Reader {
  Words words;
  BvhMotion motion;
  std::vector<std::vector<int>> channels;  // one a joint: indices into kChannels

  Eigen::Vector3d offset() {
    words.expect("OFFSET");
    Eigen::Vector3d value;
    for (double& number : value) number = words.number();
    return value;
  }

  // After ROOT or JOINT. Not by recursion: the depth is the file's.
  void hierarchy() {
    std::vector<int> open;
    joint(-1);
    open.push_back(0);
    while (!open.empty()) {
      const std::string_view word = words.next();
      if (word == "JOINT") {
        open.push_back(joint(open.back()));
      } else if (word == "End") {
        words.restOfLine();  // "Site", and in some files a name
        words.expect("{");
        motion.tips[std::size_t(open.back())] = offset();
        words.expect("}");
      } else if (word == "}") {
        open.pop_back();
      } else {
        words.fail("has " + Words::shown(word) + " where \"JOINT\", \"End Site\" or \"}\" should be");
      }
    }
  }

  int joint(int parent) {
    Joint result;
    result.name = words.restOfLine();
    if (result.name.ends_with('{')) words.fail("has \"{\" behind a name; it belongs on a line of its own");
    if (result.name.empty()) words.fail("has a joint without a name");
    if (motion.skeleton.find(result.name) >= 0)
      words.fail("is the second joint named \"" + result.name + "\"");
    if (motion.skeleton.joints.size() == kMaxJoints)
      words.fail("has more than " + std::to_string(kMaxJoints) + " joints");
    words.expect("{");
    result.parent = parent;
    result.position = offset();
    if (parent >= 0) result.position += motion.skeleton.joints[std::size_t(parent)].position;
    words.expect("CHANNELS");
    std::vector<int> list(words.count(6));
    for (std::size_t c = 0; c < list.size(); ++c) {
      const std::string_view name = words.next();
      list[c] = int(std::find(kChannels.begin(), kChannels.end(), name) - kChannels.begin());
      if (list[c] == int(kChannels.size()))
        words.fail("has the channel " + Words::shown(name) + "; there are: Xposition … Zrotation");
      if (std::find(list.begin(), list.begin() + std::ptrdiff_t(c), list[c]) !=
          list.begin() + std::ptrdiff_t(c))
        words.fail("has the channel " + Words::shown(name) + " twice");
    }
    motion.skeleton.joints.push_back(std::move(result));
    motion.tips.push_back(Eigen::Vector3d::Zero());
    channels.push_back(std::move(list));
    return int(motion.skeleton.joints.size()) - 1;
  }

  // The numbers of one joint and frame.
  void key(std::size_t j, float time_s) {
    const Joint& self = motion.skeleton.joints[j];
    const Eigen::Vector3d rest =
        self.parent < 0
            ? self.position
            : Eigen::Vector3d(self.position - motion.skeleton.joints[std::size_t(self.parent)].position);
    Eigen::Vector3d place = rest;
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    bool moves = false, turns = false;
    for (const int channel : channels[j]) {
      const double value = words.number();
      if (channel < 3) {
        place[channel] = value;
        moves = true;
      } else {
        // In the file's order, the first channel outermost.
        rotation =
            rotation * Eigen::AngleAxisd(value * std::numbers::pi / 180, Eigen::Vector3d::Unit(channel - 3));
        turns = true;
      }
    }
    JointTrack& track = motion.clip.tracks[j];
    if (turns) {
      track.times_s.push_back(time_s);
      track.rotations.push_back(rotation.normalized().cast<float>());
    }
    if (moves) {
      track.translation_times_s.push_back(time_s);
      track.translations_m.push_back((place - rest).cast<float>());
    }
  }

  void frames() {
    words.expect("MOTION");
    words.expect("Frames:");
    const std::size_t count = words.count(kMaxNumbers);
    if (count == 0) words.fail("has no frames");
    words.expect("Frame");
    words.expect("Time:");
    const double frame_s = words.number();
    if (!(frame_s > 0 && frame_s <= kMaxFrameTime_s)) words.fail("has a frame time outside 0 to 100 s");
    if (double(count - 1) * frame_s > kMaxClip_s) words.fail("lasts more than an hour; cut it into parts");
    std::size_t numbers = 0;
    for (std::size_t j = 0; j < channels.size(); ++j) {
      motion.clip.tracks.emplace_back().joint = motion.skeleton.joints[j].name;
      numbers += channels[j].size();
    }
    if (numbers == 0 || count > kMaxNumbers / numbers) words.fail("has too many frames, or no channels");
    if (count > kMaxJointFrames / channels.size())
      words.fail("has " + std::to_string(count) + " frames of " + std::to_string(channels.size()) +
                 " joints; at most " + std::to_string(kMaxJointFrames / channels.size()) +
                 " can be read of so many");
    float before_s = -1;
    for (std::size_t f = 0; f < count; ++f) {
      if (words.atEnd())
        words.fail("ends after " + std::to_string(f) + " of " + std::to_string(count) + " frames");
      const float time_s = float(double(f) * frame_s);
      if (!(time_s > before_s)) words.fail("has frames too close to each other");
      before_s = time_s;
      for (std::size_t j = 0; j < channels.size(); ++j) key(j, time_s);
    }
    if (!words.atEnd()) words.fail("goes on after its last frame");
    std::erase_if(motion.clip.tracks, [](const JointTrack& track) {
      return track.times_s.empty() && track.translation_times_s.empty();
    });
  }
};

}  // namespace

BvhMotion parseBvh(std::string_view text, const std::string& file) {
  Reader reader{Words(text, file), {}, {}};
  reader.words.expect("HIERARCHY");
  reader.words.expect("ROOT");
  reader.hierarchy();
  reader.frames();
  return std::move(reader.motion);
}

BvhMotion readBvh(const std::string& path) {
  BvhMotion motion = parseBvh(readFile(path), path);
  motion.clip.name = printable(std::filesystem::path(path).stem().string());
  return motion;
}

}  // namespace skel
