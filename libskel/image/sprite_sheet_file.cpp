#include "libskel/image/sprite_sheet_file.h"

#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "libskel/core/error.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/json.h"
#include "libskel/core/json_names.h"

namespace skel {
namespace fs = std::filesystem;

namespace {

// What `read` finds in the part that tells of the sheet; nothing if the file is no atlas.
template <class Read>
auto inAtlas(const std::string& path, const Read& read)
    -> std::optional<decltype(read(std::declval<JsonValue>()))> {
  try {
    const LookAtOutputs look;
    const JsonDocument document = JsonDocument::readFile(path);
    const JsonValue meta = document.root().at("meta");
    if (meta.at("app").asString() == kAtlasApp) return read(meta);
  } catch (const InputError&) {
  }
  return std::nullopt;
}

}  // namespace

bool isAtlas(const std::string& path) {
  return inAtlas(path, [](const JsonValue&) { return true; }).has_value();
}

std::string atlasBeside(const std::string& picture) {
  const fs::path atlas = fs::path(picture).replace_extension(".json");
  if (std::error_code unknown; !fs::is_regular_file(atlas, unknown)) return "";
  const auto name =
      inAtlas(atlas.string(), [](const JsonValue& meta) { return meta.at("image").asString(); });
  return name == jsonFromFileName(fs::path(picture).filename().string()) ? atlas.string() : "";
}

}  // namespace skel
