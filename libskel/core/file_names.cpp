#include "libskel/core/file_names.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "libskel/core/error.h"

namespace skel {
namespace fs = std::filesystem;

std::string safeFileName(std::string_view text) {
  constexpr std::size_t kMostBytes = 120;  // of the 255 that a name may have: endings and numbers follow
  std::string name(text.substr(0, kMostBytes));
  // Not in the middle of a character of UTF-8.
  if (text.size() > name.size())
    while (!name.empty() && (static_cast<unsigned char>(text[name.size()]) & 0xC0) == 0x80) name.pop_back();
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F || c == '/' || c == '\\' || c == ':') c = '_';
  }
  if (name.empty()) name = '_';
  for (const char c : {'.', '-', ' '})
    if (name.front() == c) name.front() = '_';
  if (name.back() == ' ') name.back() = '_';
  return name;
}

bool liesBelow(const std::string& dir, const std::string& path) {
  std::error_code failure;
  const auto canonical = [&](const fs::path& folder) {
    return failure ? fs::path() : fs::weakly_canonical(fs::absolute(folder.empty() ? "." : folder), failure);
  };
  const fs::path below = canonical(fs::path(path).parent_path()).lexically_relative(canonical(dir));
  return !failure && !below.empty() && *below.begin() != "..";
}

std::string pathInside(const std::string& dir, const std::string& named, const std::string& file) {
  const fs::path folder = dir.empty() ? "." : dir, path = folder / named;
  const auto refuse = [&] {
    throw InputError(file,
                     "names \"" + named + "\", which lies outside of its folder; move the files together");
  };
  // What the system would take for the end of the name hides where it leads.
  if (named.find('\0') != named.npos) refuse();
  if (fs::path(named).is_absolute() || !liesBelow(dir, path.string())) refuse();
  const fs::path last = path.filename();
  if (last.empty() || last == "." || last == "..") refuse();
  return path.string();
}

std::string inSmallLetters(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string endingOf(const std::string& path) { return inSmallLetters(fs::path(path).extension().string()); }

std::string numberedName(const std::string& start, const std::string& end, int number) {
  return start + (number > 1 ? "-" + std::to_string(number) : "") + end;
}

std::string freeNumberedName(const std::string& start, const std::string& end) {
  std::error_code unknown;
  for (int number = 1;; ++number) {
    std::string path = numberedName(start, end, number);
    if (!fs::exists(fs::symlink_status(path, unknown))) return path;
  }
}

std::string shellWord(const std::string& path) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || c >= 0x80 || std::string_view("/._-+,:@%=").find(char(c)) != std::string::npos;
  };
  const auto unseen = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
  if (!path.empty() && std::all_of(path.begin(), path.end(), plain)) return path;
  const bool escapes = std::any_of(path.begin(), path.end(), unseen);
  std::string word = escapes ? "$'" : "'";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    if (unseen(byte)) {
      word += {'\\', 'x', "0123456789abcdef"[byte >> 4], "0123456789abcdef"[byte & 15]};
    } else if (escapes && (c == '\'' || c == '\\')) {
      word += {'\\', c};
    } else {
      word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
  }
  return word + "'";
}

}  // namespace skel
