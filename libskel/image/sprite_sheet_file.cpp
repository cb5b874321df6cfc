#include "libskel/image/sprite_sheet_file.h"

#include <filesystem>
#include <system_error>

#include "libskel/core/error.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/json.h"
#include "libskel/core/json_names.h"

namespace skel {
namespace fs = std::filesystem;

std::string atlasBeside(const std::string& picture) {
  const fs::path atlas = fs::path(picture).replace_extension(".json");
  if (std::error_code unknown; !fs::is_regular_file(atlas, unknown)) return "";
  try {
    const LookAtOutputs look;
    const JsonDocument document = JsonDocument::readFile(atlas.string());
    const JsonValue meta = document.root().at("meta");
    const bool is_of_it =
        meta.at("app").asString() == kAtlasApp &&
        meta.at("image").asString() == jsonFromFileName(fs::path(picture).filename().string());
    return is_of_it ? atlas.string() : "";
  } catch (const InputError&) {
    return "";
  }
}

}  // namespace skel
