#include "libskel/skin/regions.h"

#include <algorithm>

#include "embedded/skin_regions.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"

namespace skel {

namespace {

// "mixamorig:LeftForeArm" has the words mixamorig, left, fore, arm.
std::vector<std::string> wordsOf(const std::string& name) {
  std::vector<std::string> words(1);
  char before = 0;
  for (const char c : name) {
    const bool capital = c >= 'A' && c <= 'Z', small = c >= 'a' && c <= 'z';
    if ((!capital && !small) || (capital && before >= 'a' && before <= 'z')) words.emplace_back();
    if (capital || small) words.back() += static_cast<char>(c | 0x20);
    before = c;
  }
  return words;
}

}  // namespace

std::vector<int> SkinRegions::ofJoints(const Skeleton& skeleton) const {
  std::vector<int> result;
  for (const Joint& joint : skeleton.joints) {
    const std::vector<std::string> words = wordsOf(joint.name);
    auto found = std::find_if(regions.begin(), regions.end(), [&](const SkinRegion& region) {
      return std::find_first_of(words.begin(), words.end(), region.words.begin(), region.words.end()) !=
             words.end();
    });
    if (found == regions.end())
      found =
          std::find_if(regions.begin(), regions.end(), [](const SkinRegion& r) { return r.words.empty(); });
    result.push_back(static_cast<int>(found - regions.begin()));
  }
  return result;
}

SkinRegions parseRegions(std::string_view text, const std::string& file) {
  const JsonDocument document = JsonDocument::parse(text, file);
  const JsonValue root = document.root();
  root.checkFormat("skel-regions", 1);
  root.allowOnly({"format", "version", "regions"});
  SkinRegions result;
  const JsonValue list = root.at("regions");
  const std::vector<JsonValue> items = list.items();
  int others = 0;
  for (const JsonValue& item : items) {
    item.allowOnly({"name", "words", "mixes", "own_chain", "rigid", "power"});
    SkinRegion region;
    region.name = item.at("name").asString();
    for (const SkinRegion& other : result.regions)
      if (other.name == region.name)
        item.at("name").fail("\"" + region.name + "\" is the name of two regions");
    for (const JsonValue& word : item.at("words").items()) {
      region.words.push_back(word.asString());
      if (region.words.back().empty() || wordsOf(region.words.back()) != std::vector{region.words.back()})
        word.fail("must be one word of small letters");
    }
    others += region.words.empty();
    if (const auto own_chain = item.find("own_chain")) region.own_chain = own_chain->asBool();
    if (const auto rigid = item.find("rigid")) region.rigid = rigid->asBool();
    if (const auto power = item.find("power")) region.power = power->asNumber(0.1, 16);
    result.regions.push_back(std::move(region));
  }
  if (others != 1)
    list.fail("one region must have no words of its own (\"words\": []), for all that the others lack; " +
              std::to_string(others) + " have none");
  for (std::size_t i = 0; i < items.size(); ++i) {
    SkinRegion& region = result.regions[i];
    region.mixes.push_back(static_cast<int>(i));
    for (const JsonValue& item : items[i].at("mixes").items()) {
      const auto other = std::find_if(result.regions.begin(), result.regions.end(),
                                      [&](const SkinRegion& r) { return r.name == item.asString(); });
      if (other == result.regions.end()) item.fail("there is no region \"" + item.asString() + "\"");
      region.mixes.push_back(static_cast<int>(other - result.regions.begin()));
    }
  }
  return result;
}

SkinRegions readRegions(const std::string& path) { return parseRegions(readFile(path), path); }

const SkinRegions& defaultRegions() {
  static const SkinRegions regions = parseRegions(embedded::skin_regions, "regions.json");
  return regions;
}

}  // namespace skel
