#include "libskel/export/formats.h"

#include "libskel/core/error.h"

namespace skel {

const std::vector<ExportFormat>& exportFormats() {
  static const std::vector<ExportFormat> formats = {
      {"glb", exportGlb}, {"obj", exportObj},          {"weights", exportWeights},
      {"bvh", exportBvh}, {"char_cfg", exportCharCfg},
  };
  return formats;
}

const ExportFormat& exportFormat(std::string_view name) {
  std::string names;
  for (const ExportFormat& format : exportFormats()) {
    if (format.name == name) return format;
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  }
  throw UsageError("there is no format \"" + std::string(name) + "\"; there are: " + names);
}

std::vector<ExportedFile> exportGlb(const ExportInput& input) {
  return {{".glb", encodeGlb(input.character, input.clips, input.options)}};
}

}  // namespace skel
