#include "labeler/save_drawing.h"

#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/sha256.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNext = ".next";

// Whoever dies in between leaves `next`, whose bytes take the same place again.
void putInPlace(const std::string& bytes, const std::string& mask, const std::string& next) {
  replaceFile(mask, bytes);
  removeFile(next);
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
  putInPlace(png, mask, mask + kNext);
}

void finishSave(const std::string& label_file) {
  const std::string stem = label_file.substr(0, label_file.size() - std::string(kLabelFileEnding).size());
  const std::string mask = stem + ".mask.png", next = mask + kNext;
  if (!fs::is_regular_file(next)) return;
  const bool labelled = fs::is_regular_file(label_file);
  const auto source = labelled ? readLabelFile(label_file).mask : std::nullopt;
  const LookAtOutputs look;
  const std::string bytes = readFile(next);
  if (source && besideLabelFile(label_file, source->file) == mask && sha256(bytes) == source->sha256)
    putInPlace(bytes, mask, next);
  else
    removeFile(next);
}

}  // namespace skel
