#include "libskel/labels/coco_of_others.h"

#include "libskel/core/error.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/standard_output.h"

namespace skel {
namespace {

// What cannot be read holds nothing that would be lost.
bool holdsCocoOfOthers(const std::string& path) {
  if (!isFileToReplace(path)) return false;
  const LookAtOutputs look;
  try {
    const JsonDocument document = JsonDocument::readFile(path);
    return isCoco(document.root()) && !isExportedCoco(document.root());
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

bool isCoco(const JsonValue& root) {
  return root.isObject() && root.find("annotations") && root.find("images");
}

bool isExportedCoco(const JsonValue& root) {
  const std::optional<JsonValue> info = root.find("info");
  if (!info || !info->isObject()) return false;
  const std::optional<JsonValue> contributor = info->find("contributor");
  return contributor && contributor->isString() && contributor->asString() == kCocoContributor;
}

void keepCocoOfOthers(const std::string& path, const std::string& instead) {
  if (holdsCocoOfOthers(path))
    throw OutputError(path, "holds COCO annotations that skel-label has not exported; " + instead);
}

}  // namespace skel
