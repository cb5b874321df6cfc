#include "libskel/core/files_left.h"

#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/sha256.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

std::string hashOf(const std::string& path) {
  if (std::error_code unknown; !fs::is_regular_file(path, unknown)) return "";
  try {
    const LookAtOutputs look;
    return sha256(readFile(path));
  } catch (const InputError&) {
    return "";
  }
}

// However it is spelled.
std::string placeOf(const std::string& path) {
  std::error_code unknown;
  return fs::weakly_canonical(fs::absolute(path), unknown).string();
}

}  // namespace

FilesLeft::Stamp FilesLeft::stampOf(const std::string& path) {
  std::error_code unknown;
  return {fs::file_size(path, unknown), fs::last_write_time(path, unknown)};
}

void FilesLeft::note(const std::string& path) { sha256_[placeOf(path)] = hashOf(path); }

void FilesLeft::noteUnread(const std::string& path) { unread_[placeOf(path)] = stampOf(path); }

bool FilesLeft::hasChanged(const std::string& path) const {
  const std::string place = placeOf(path);
  if (const auto left = sha256_.find(place); left != sha256_.end()) return left->second != hashOf(path);
  const auto left = unread_.find(place);
  return left != unread_.end() && left->second != stampOf(path);
}

}  // namespace skel
