#include "infer/result_file.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/core/json_names.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "skel-result";
constexpr int kVersion = 3;  // 2: without `facing_deg`; 1: also without `nothing_found`

const std::map<Verdict, std::string> kVerdictNames = {
    {Verdict::kFine, "fine"}, {Verdict::kLookAt, "look at"}, {Verdict::kRetake, "retake"}};

const char* statusOf(const DrawingResult& drawing) {
  return drawing.left_out ? "left out" : drawing.error.empty() ? "done" : "failed";
}

std::string pathFrom(const std::string& beside, const std::string& path) {
  return jsonFromFileName(beside.empty() ? path : pathSeenFrom(beside, path));
}

// What an error says that begins with the name of its drawing.
constexpr const char* kAfterName = ": ";
std::string errorFrom(const std::string& beside, const DrawingResult& drawing) {
  const std::string start = drawing.source + kAfterName;
  if (!drawing.error.starts_with(start)) return drawing.error;
  return pathFrom(beside, drawing.source) + kAfterName + drawing.error.substr(start.size());
}

Json figureJson(const FigureResult& figure, const std::string& beside) {
  Json notes = Json::array(), outputs = Json::array(), times = Json::object();
  for (const Note& note : figure.notes) {
    Json one = {{"text", note.text}};
    if (!note.shared.empty()) one["shared"] = note.shared, one["what"] = note.what;
    notes.push_back(std::move(one));
  }
  for (const WrittenFile& file : figure.outputs)
    outputs.push_back(
        {{"file", pathFrom(beside, file.path)}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  for (const StageTime& time : figure.times) times[time.stage] = time.time_s * 1e3;
  Json facing = nullptr;
  if (figure.facing_deg) facing = *figure.facing_deg;
  return {{"number", figure.number},    {"template", figure.body_plan},
          {"facing_deg", facing},       {"confidence", figure.confidence.value_or(0)},
          {"missing", figure.missing},  {"verdict", kVerdictNames.at(figure.verdict)},
          {"warnings", figure.reasons}, {"notes", notes},
          {"outputs", outputs},         {"times_ms", times}};
}

std::vector<std::string> textsOf(const JsonValue& array) {
  std::vector<std::string> texts;
  for (const JsonValue& text : array.items()) texts.push_back(text.asString());
  return texts;
}

FigureResult figureOf(const JsonValue& json, const fs::path& folder) {
  json.allowOnly({"number", "template", "facing_deg", "confidence", "missing", "verdict", "warnings", "notes",
                  "outputs", "times_ms"});
  FigureResult figure;
  figure.number = json.at("number").asInt(1, 9999);
  figure.body_plan = json.at("template").asString();
  if (const auto facing = json.find("facing_deg"); facing && !facing->isNull())
    figure.facing_deg = facing->asNumber(-180, 180);
  figure.confidence = json.at("confidence").asNumber(0, 1);
  figure.missing = textsOf(json.at("missing"));
  figure.reasons = textsOf(json.at("warnings"));
  const std::string verdict = json.at("verdict").asString();
  const auto known = std::find_if(kVerdictNames.begin(), kVerdictNames.end(),
                                  [&](const auto& one) { return one.second == verdict; });
  if (known == kVerdictNames.end()) json.at("verdict").fail("\"" + verdict + "\" is no verdict");
  figure.verdict = known->first;
  for (const JsonValue& json_note : json.at("notes").items()) {
    json_note.allowOnly({"text", "shared", "what"});
    Note note{json_note.at("text").asString()};
    if (const auto shared = json_note.find("shared")) note.shared = shared->asString();
    if (const auto what = json_note.find("what")) note.what = what->asString();
    figure.notes.push_back(std::move(note));
  }
  for (const JsonValue& output : json.at("outputs").items()) {
    output.allowOnly({"file", "bytes", "sha256"});
    figure.outputs.push_back({(folder / output.at("file").asFileName()).string(),
                              std::size_t(output.at("bytes").asNumber(0, 1e15)),
                              output.at("sha256").asString()});
  }
  const JsonValue times = json.at("times_ms");
  for (const std::string& stage : times.keys())
    figure.times.push_back({stage, times.at(stage).asNumber() / 1e3});
  return figure;
}

}  // namespace

std::string formatResult(const DrawingResult& drawing, const std::string& beside) {
  Json figures = Json::array();
  for (const FigureResult& figure : drawing.figures) figures.push_back(figureJson(figure, beside));
  Json json = {{"format", kFormat}, {"version", kVersion}};
  json["source"] = pathFrom(beside, drawing.source);
  json["status"] = statusOf(drawing);
  json["kept"] = drawing.kept;
  json["code"] = int(drawing.code);
  json["error"] = errorFrom(beside, drawing);
  json["nothing_found"] = drawing.nothing_found;
  json["figures"] = std::move(figures);
  json["sha256"] = {{"image", drawing.origin.image},
                    {"mended", drawing.origin.mended},
                    {"options", drawing.origin.options},
                    {"nets", drawing.origin.nets}};
  json["skel"] = drawing.origin.version;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

DrawingResult parseResult(const std::string& text, const std::string& path) {
  const JsonDocument document = JsonDocument::parse(text, path);
  const JsonValue root = document.root();
  root.checkFormat(kFormat, kVersion);
  root.allowOnly({"format", "version", "source", "status", "kept", "code", "error", "nothing_found",
                  "figures", "sha256", "skel"});
  const fs::path folder = fs::path(path).parent_path();
  DrawingResult drawing;
  drawing.source = (folder / root.at("source").asFileName()).lexically_normal().string();
  drawing.kept = root.at("kept").asBool();
  drawing.code = ExitCode(root.at("code").asInt(0, 4));
  drawing.error = root.at("error").asString();
  if (const std::string start = root.at("source").asString() + kAfterName; drawing.error.starts_with(start)) {
    drawing.problem = drawing.error.substr(start.size());
    drawing.error = drawing.source + kAfterName + drawing.problem;
  }
  if (const auto nothing = root.find("nothing_found")) drawing.nothing_found = nothing->asBool();
  for (const JsonValue& figure : root.at("figures").items())
    drawing.figures.push_back(figureOf(figure, folder));
  const JsonValue hashes = root.at("sha256");
  hashes.allowOnly({"image", "mended", "options", "nets"});
  drawing.origin = {hashes.at("image").asString(), hashes.at("mended").asString(),
                    hashes.at("options").asString(), hashes.at("nets").asString(),
                    root.at("skel").asString()};
  drawing.left_out = root.at("status").asString() == "left out";
  return drawing;
}

}  // namespace skel
