#include "libskel/export/formats.h"

#include "libskel/core/error.h"

namespace skel {

const std::vector<ExportFormat>& exportFormats() {
  using Suffixes = std::vector<std::string>;
  using Clips = std::vector<Clip>;
  static const std::vector<ExportFormat> formats = {
      {"glb", [](const std::string&, const Clips&) { return Suffixes{".glb"}; }, exportGlb},
      {"obj", objSuffixes, exportObj},
      {"weights", [](const std::string&, const Clips&) { return Suffixes{".weights.json"}; }, exportWeights},
      {"bvh", bvhSuffixes, exportBvh},
      {"char_cfg",
       [](const std::string&, const Clips&) {
         return Suffixes{"/mask.png", "/texture.png", "/char_cfg.yaml"};
       },
       exportCharCfg},
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
