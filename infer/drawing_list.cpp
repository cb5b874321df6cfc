#include "infer/drawing_list.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "libskel/core/error.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kLongestPath = 4096;  // bytes, Linux's PATH_MAX
constexpr std::size_t kMostEmpty = 100'000;

}  // namespace

Shard shardNamed(const std::string& text) {
  constexpr std::size_t kMost = 1'000'000;
  Shard shard;
  const auto isNumber = [](std::string_view digits, std::size_t& number) {
    const char* const end = digits.data() + digits.size();
    const auto [stopped, failure] = std::from_chars(digits.data(), end, number);
    return failure == std::errc() && stopped == end;
  };
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string_view index = std::string_view(text).substr(0, slash),
                         count = std::string_view(text).substr(std::min(slash + 1, text.size()));
  if (!isNumber(index, shard.index) || !isNumber(count, shard.count) || shard.index < 1 ||
      shard.index > shard.count || shard.count > kMost)
    throw UsageError("--shard is \"" + text + "\", must be I/N with I from 1 to N, such as 1/4 to 4/4");
  return shard;
}

DrawingList::DrawingList(const std::string& file, bool null_ended, Shard shard)
    : file_(file == "-" ? "standard input" : file),
      stream_(file == "-" ? stdin : std::fopen(file.c_str(), "re")),
      null_ended_(null_ended),
      shard_(shard) {
  if (!stream_) throw InputError(file_, std::string("cannot be read: ") + std::strerror(errno));
}

DrawingList::~DrawingList() {
  if (stream_ && stream_ != stdin) std::fclose(stream_);
}

bool DrawingList::readPath(std::string& path) {
  path.clear();
  std::size_t empty = 0;
  for (int c; (c = getc_unlocked(stream_)) != EOF;) {
    const auto refuse = [&](const std::string& problem) {
      throw InputError(file_, "path " + std::to_string(read_ + 1) + " " + problem);
    };
    if (c == (null_ended_ ? '\0' : '\n')) {
      if (!path.empty()) return true;
      // /dev/zero has no end of them.
      if (++empty > kMostEmpty) refuse("comes after more than " + std::to_string(kMostEmpty) + " empty ones");
      continue;
    }
    if (c == '\0') refuse("holds a zero byte: if it is zeros that the paths end with, say so by --null");
    if (path.size() == kLongestPath)
      refuse("is longer than " + std::to_string(kLongestPath) +
             " bytes: the list has one path a line, or ends each with a zero byte (--null)");
    path += char(c);
  }
  if (std::ferror(stream_)) throw InputError(file_, std::string("cannot be read: ") + std::strerror(errno));
  return !path.empty();
}

std::optional<std::string> DrawingList::next() {
  for (std::string path; readPath(path);)
    if (read_++ % shard_.count == shard_.index - 1) return path;
  return std::nullopt;
}

std::size_t DrawingList::length() const {
  struct stat status;
  if (stream_ == stdin || ::fstat(fileno(stream_), &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  DrawingList again(file_, null_ended_, shard_);
  std::size_t count = 0;
  while (again.next()) ++count;
  return count;
}

std::string stemInTree(const std::string& drawing) {
  fs::path below;
  for (const fs::path& part : fs::path(drawing).lexically_normal().relative_path())
    if (part != ".." && part != "." && !part.empty()) below /= part;
  // "...png" has no name before its ending that could be one.
  if (below.stem() != "..") below.replace_extension();
  if (below.empty()) throw InputError(drawing, "is a folder, not a file");
  return below.string();
}

}  // namespace skel
