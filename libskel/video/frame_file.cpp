#include "libskel/video/frame_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/input_guard.h"
#include "libskel/image/write_image.h"

namespace skel {
namespace {
namespace fs = std::filesystem;
using namespace std::string_view_literals;

// The chunk of PNG that tells the program: length, type, key and text, CRC.
constexpr std::string_view kMark = "\0\0\0\x0DtEXtSoftware\0skel[)>\xA9"sv;
constexpr std::size_t kMarkAt = 33;  // behind signature and IHDR, which are always of the same size

bool isOurs(const fs::path& path) {
  std::error_code unknown;
  if (!fs::is_regular_file(path, unknown)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string head(kMarkAt + kMark.size(), '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return file.good() && std::string_view(head).substr(kMarkAt) == kMark;
}

constexpr std::string_view kEnding = ".png", kDigits = "0123456789";

bool isFrame(const std::string& name, const std::string& prefix) {
  if (!name.starts_with(prefix) || !name.ends_with(kEnding)) return false;
  const std::string_view number =
      std::string_view(name).substr(prefix.size(), name.size() - prefix.size() - kEnding.size());
  return !number.empty() && number.find_first_not_of(kDigits) == std::string_view::npos;
}

std::size_t numberAt(const std::string& frame) {
  return frame.find_last_not_of(kDigits, frame.size() - kEnding.size() - 1) + 1;
}

// frame-0010.png after frame-0009.png.
std::string frameAfter(std::string frame) {
  for (std::size_t i = frame.size() - kEnding.size(); i-- > numberAt(frame);) {
    if (frame[i] != '9') {
      ++frame[i];
      break;
    }
    frame[i] = '0';
  }
  return frame;
}

// The shell's command for frames that follow on each other, in brackets; of others "".
std::string removalOf(const std::string& dir, const std::vector<std::string>& frames) {
  const auto gap = std::adjacent_find(frames.begin(), frames.end(),
                                      [](const auto& a, const auto& b) { return frameAfter(a) != b; });
  if (gap != frames.end()) return "";
  const std::size_t at = numberAt(frames.front());
  const auto number = [&](const std::string& frame) {
    return frame.substr(at, frame.size() - kEnding.size() - at);
  };
  return " (rm " + shellWord((fs::path(dir) / frames.front().substr(0, at)).string()) + "{" +
         number(frames.front()) + ".." + number(frames.back()) + "}" + std::string(kEnding) + ")";
}

}  // namespace

std::string encodeFrame(const Image& frame) {
  std::string png = encodePng(frame);
  SKEL_CHECK(png.size() > kMarkAt);
  return png.insert(kMarkAt, kMark);
}

std::vector<std::string> checkFrames(const std::string& dir, const std::string& prefix) {
  std::error_code failure;
  std::vector<std::string> names;
  for (fs::directory_iterator entry(dir, failure); !failure && entry != fs::directory_iterator();
       entry.increment(failure)) {
    std::string name = entry->path().filename().string();
    if (isFrame(name, prefix)) names.push_back(std::move(name));
  }
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) {
    const fs::path frame = fs::path(dir) / name;
    noteOutput(frame.string());
    if (!isOurs(frame))
      throw OutputError(frame.string(),
                        "is not one of skel's pictures; move it away, or name another folder with -o");
  }
  return names;
}

void refuseOtherFrames(const std::string& dir, const std::vector<std::string>& there,
                       const std::set<std::string>& known) {
  std::vector<std::string> others;
  std::copy_if(there.begin(), there.end(), std::back_inserter(others),
               [&](const std::string& name) { return !known.contains(name); });
  if (others.empty()) return;
  std::string text = "belongs to another film";
  if (others.size() == 1)
    text += "; remove it";
  else
    text += ", as do " + std::to_string(others.size() - 1) + " more up to " + others.back() +
            "; remove them" + removalOf(dir, others);
  throw OutputError((fs::path(dir) / others.front()).string(), text + ", or name another folder with -o");
}

}  // namespace skel
