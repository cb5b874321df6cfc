#include "trainer/made_by.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/core/sha256.h"

namespace skel {
namespace {

constexpr const char* kTrainingFormat = "skel-training";
constexpr int kTrainingVersion = 1;
constexpr int kMostSteps = 10'000'000;

std::string shortHash(const std::string& bytes) { return "sha256 " + sha256(bytes).substr(0, 16); }

[[noreturn]] void refuseOther(const std::string& file, const std::string& option, const std::string& was,
                              const std::string& now) {
  throw InputError(file, "was made by " + option + " " + was + ", this training is by " + now +
                             ": go on by the same, or remove it to start anew");
}

}  // namespace

void MadeBy::add(const std::string& option, double value) {
  char text[64];
  add(option, std::string(text, std::to_chars(text, text + sizeof text, value).ptr));
}

std::string contentOfFile(const std::string& path) {
  return path.empty() ? "none" : shortHash(readFile(path));
}

std::string contentOfFiles(const std::vector<std::string>& paths) {
  if (paths.empty()) return "none";
  std::string hashes;
  for (const std::string& path : paths) hashes += sha256(readFile(path)) + "\n";
  return std::to_string(paths.size()) + " files (" + shortHash(hashes) + ")";
}

std::string stepsOf(const MadeBy& made_by) {
  std::string text;
  for (const int steps : made_by.steps) text += (text.empty() ? "" : ", then ") + std::to_string(steps);
  return text;
}

std::string formatMadeBy(const MadeBy& made_by) {
  nlohmann::ordered_json line = {
      {"format", kTrainingFormat}, {"version", kTrainingVersion}, {"steps", made_by.steps}};
  line["made_by"] = nlohmann::ordered_json::object();
  for (const auto& [option, value] : made_by.options) line["made_by"][option] = value;
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::optional<MadeBy> parseMadeBy(const std::string& bytes, const std::string& file) {
  if (!bytes.starts_with(std::string("{\"format\":\"") + kTrainingFormat + "\"")) return std::nullopt;
  const JsonDocument document =
      JsonDocument::parse(std::string_view(bytes).substr(0, bytes.find('\n')), file);
  const JsonValue root = document.root();
  root.checkFormat(kTrainingFormat, kTrainingVersion);
  root.allowOnly({"format", "version", "steps", "made_by"});
  MadeBy made_by;
  for (const JsonValue& steps : root.at("steps").items()) made_by.steps.push_back(steps.asInt(1, kMostSteps));
  if (made_by.steps.empty()) root.at("steps").fail("is empty");
  const JsonValue options = root.at("made_by");
  for (const std::string& option : options.keys()) made_by.add(option, options.at(option).asString());
  return made_by;
}

void ensureSame(const MadeBy& was, const MadeBy& now, const std::string& file) {
  const auto valueIn = [](const MadeBy& made_by, const std::string& option) -> std::string {
    const auto known = std::find_if(made_by.options.begin(), made_by.options.end(),
                                    [&](const auto& one) { return one.first == option; });
    return known == made_by.options.end() ? "none" : known->second;
  };
  for (const MadeBy* made_by : {&now, &was})
    for (const auto& [option, value] : made_by->options)
      if (valueIn(was, option) != valueIn(now, option))
        refuseOther(file, option, valueIn(was, option), valueIn(now, option));
  if (now.steps.back() < was.steps.back())
    refuseOther(file, "--steps", std::to_string(was.steps.back()), std::to_string(now.steps.back()));
}

}  // namespace skel
