#include "labeler/save_drawing.h"

#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/sha256.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNext = ".next";

// Through a link to what it names, with the mode of what was there, as writeFile() does.
void putInPlace(const std::string& next, const std::string& path) {
  std::error_code error;
  const fs::path target = fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : fs::path(path);
  if (const fs::file_status before = fs::status(target, error); fs::is_regular_file(before))
    fs::permissions(next, before.permissions(), error);
  fs::rename(next, target, error);
  if (error == std::errc::cross_device_link) {
    replaceFile(path, readFile(next));
    removeFile(next);
  } else if (error) {
    throw OutputError(path, "cannot be replaced: " + error.message());
  }
}

}  // namespace

void removeFile(const std::string& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw OutputError(path, "cannot be removed: " + error.message());
}

void keepAside(const std::string& path) {
  if (!fs::is_regular_file(path)) return;
  const std::string name = fs::path(path).filename().string();
  const std::size_t ending = path.size() - (name.size() - name.rfind('.', name.rfind('.') - 1));
  const std::string bytes = readFile(path);
  std::string kept;
  int number = 1;
  do {
    kept = numberedName(path.substr(0, ending) + ".old", path.substr(ending), number++);
  } while (fs::exists(fs::symlink_status(kept)) && (!fs::is_regular_file(kept) || readFile(kept) != bytes));
  std::error_code error;
  fs::rename(path, kept, error);
  if (error) throw OutputError(kept, "cannot be replaced: " + error.message());
}

void saveWithMask(const std::string& label_file, const LabelFile& labels, const std::string& png) {
  const std::string mask = besideLabelFile(label_file, labels.mask->file);
  writeFile(mask + kNext, png);
  writeLabelFile(label_file, labels);
  putInPlace(mask + kNext, mask);
}

void finishSave(const std::string& label_file) {
  const std::string stem = label_file.substr(0, label_file.size() - std::string(kLabelFileEnding).size());
  const std::string mask = stem + ".mask.png", next = mask + kNext;
  if (!fs::is_regular_file(next)) return;
  const bool labelled = fs::is_regular_file(label_file);
  const auto source = labelled ? readLabelFile(label_file).mask : std::nullopt;
  if (source && besideLabelFile(label_file, source->file) == mask && sha256(readFile(next)) == source->sha256)
    putInPlace(next, mask);
  else
    removeFile(next);
}

}  // namespace skel
