#include "libskel/skin/regions.h"

#include <algorithm>
#include <unordered_map>

#include "embedded/skin_regions.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"

namespace skel {

namespace {

constexpr std::size_t kMostRegions = 256;

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
  std::unordered_map<std::string, int> first_with;  // by word
  int others = 0;
  for (int r = static_cast<int>(regions.size()) - 1; r >= 0; --r) {
    for (const std::string& word : regions[r].words) first_with[word] = r;
    if (regions[r].words.empty()) others = r;
  }
  std::vector<int> result;
  for (const Joint& joint : skeleton.joints) {
    int region = static_cast<int>(regions.size());
    for (const std::string& word : wordsOf(joint.name))
      if (const auto found = first_with.find(word); found != first_with.end())
        region = std::min(region, found->second);
    result.push_back(region < static_cast<int>(regions.size()) ? region : others);
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
  if (items.size() > kMostRegions) list.fail("more than " + std::to_string(kMostRegions) + " regions");
  int others = 0;
  std::unordered_map<std::string, int> numbers;  // by name
  for (const JsonValue& item : items) {
    item.allowOnly({"name", "words", "mixes", "own_chain", "rigid", "power"});
    SkinRegion region;
    region.name = item.at("name").asString();
    if (!numbers.emplace(region.name, static_cast<int>(result.regions.size())).second)
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
      const auto other = numbers.find(item.asString());
      if (other == numbers.end()) item.fail("there is no region \"" + item.asString() + "\"");
      region.mixes.push_back(other->second);
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
