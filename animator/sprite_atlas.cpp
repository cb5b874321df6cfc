#include "animator/sprite_atlas.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "libskel/core/error.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/json.h"
#include "libskel/core/json_names.h"
#include "libskel/image/sprite_sheet_file.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

Json sizeOf(int width, int height) { return {{"w", width}, {"h", height}}; }

Json boxOf(const Box& box) { return {{"x", box.x}, {"y", box.y}, {"w", box.width}, {"h", box.height}}; }

}  // namespace

std::string formatAtlas(const std::vector<Sprite>& sprites, const std::vector<SpriteTag>& tags,
                        const SpriteCell& cell, const SpriteSheet& sheet, AtlasForm form,
                        const std::string& picture) {
  const Json pivot = {{"x", double(cell.pivot_x) / cell.width}, {"y", double(cell.pivot_y) / cell.height}};
  Json frames = form == AtlasForm::kArray ? Json::array() : Json::object();
  for (std::size_t i = 0; i < sprites.size(); ++i) {
    const auto& [in_sheet, in_cell] = sheet.placed[i];
    const std::string name = form == AtlasForm::kAseprite ? std::to_string(i) : sprites[i].name;
    Json frame = form == AtlasForm::kArray ? Json{{"filename", name}} : Json::object();
    frame["frame"] = boxOf(in_sheet);
    frame["rotated"] = false;
    frame["trimmed"] = in_cell.width < cell.width || in_cell.height < cell.height;
    frame["spriteSourceSize"] = boxOf(in_cell);
    frame["sourceSize"] = sizeOf(cell.width, cell.height);
    frame["pivot"] = pivot;
    frame["duration"] = sprites[i].duration_ms;
    if (form == AtlasForm::kArray)
      frames.push_back(std::move(frame));
    else
      frames[name] = std::move(frame);
  }
  Json frame_tags = Json::array();
  for (const SpriteTag& tag : tags) {
    frame_tags.push_back(
        {{"name", tag.name}, {"from", tag.first}, {"to", tag.last}, {"direction", "forward"}});
    if (!tag.loops) frame_tags.back()["repeat"] = "1";  // as Aseprite writes it; without: for ever
  }
  const Json key = {{"frame", 0},
                    {"bounds", boxOf({0, 0, cell.width, cell.height})},
                    {"pivot", {{"x", cell.pivot_x}, {"y", cell.pivot_y}}}};
  const Json slice = {{"name", "ground"}, {"color", "#0000ffff"}, {"keys", Json::array({key})}};
  Json view = {{"pxPerM", cell.px_per_m}, {"pitchDeg", cell.pitch_deg}};
  if (cell.angle_deg != 0) view["angleDeg"] = cell.angle_deg;
  const Json atlas = {{"frames", std::move(frames)},
                      {"meta",
                       {{"app", kAtlasApp},
                        {"version", "1.0"},
                        {"image", jsonFromFileName(picture)},
                        {"format", "RGBA8888"},
                        {"size", sizeOf(sheet.picture.width, sheet.picture.height)},
                        {"scale", "1"},
                        {"frameTags", std::move(frame_tags)},
                        {"slices", Json::array({slice})},
                        {"skel", std::move(view)}}}};
  return atlas.dump(1) + "\n";
}

SpriteCell readSpriteCell(const std::string& path) {
  const JsonDocument document = JsonDocument::readFile(path);
  const JsonValue root = document.root();
  const std::optional<JsonValue> meta = root.isObject() ? root.find("meta") : std::nullopt;
  const std::optional<JsonValue> view = meta && meta->isObject() ? meta->find("skel") : std::nullopt;
  if (!view)
    throw InputError(path,
                     "does not say how large a metre is in it: no sheet's .json of skel, or one of "
                     "before; make the sheet again, without --like");
  const auto only = [](const JsonValue& list) {
    if (list.size() != 1) list.fail("must be one, as skel writes it");
    return list.item(0);
  };
  const JsonValue key = only(only(meta->at("slices")).at("keys")), bounds = key.at("bounds"),
                  pivot = key.at("pivot");
  SpriteCell cell;
  cell.width = bounds.at("w").asInt(1, kLongestCell_px);
  cell.height = bounds.at("h").asInt(1, kLongestCell_px);
  cell.pivot_x = pivot.at("x").asInt(-kLongestCell_px, kLongestCell_px);
  cell.pivot_y = pivot.at("y").asInt(-kLongestCell_px, kLongestCell_px);
  cell.px_per_m = view->at("pxPerM").asNumber(1e-6, 1e6);
  cell.pitch_deg = view->at("pitchDeg").asNumber(-89, 89);
  if (const auto angle = view->find("angleDeg")) cell.angle_deg = angle->asNumber(-1e6, 1e6);
  return cell;
}

}  // namespace skel
