#include "stylizer/database.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/core/json_names.h"
#include "libskel/core/sha256.h"
#include "libskel/core/tool_command.h"
#include "libskel/video/video_reader.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

constexpr const char* kFormat = "skel-motions";
constexpr int kMaxFrames = 10'000'000;

std::string indexOf(const std::string& dir) { return (fs::path(dir) / kDatabaseIndex).string(); }

std::string formatIndex(const std::vector<DatabaseEntry>& entries) {
  nlohmann::ordered_json root = {
      {"format", kFormat}, {"version", 1}, {"motions", nlohmann::ordered_json::array()}};
  for (const DatabaseEntry& e : entries)
    root["motions"].push_back({{"file", jsonFromFileName(e.file)},
                               {"action", e.action},
                               {"source", jsonFromFileName(e.source)},
                               {"frames", e.frames},
                               {"keys", e.keys},
                               {"sha256", e.sha256}});
  return root.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

bool isDatabase(const std::string& dir) {
  std::error_code unknown;
  return fs::status(indexOf(dir), unknown).type() != fs::file_type::not_found;
}

bool isFilm(const std::string& path) {
  try {
    readVideo(path);
    return true;
  } catch (const Error&) {
    return false;
  }
}

[[noreturn]] void failOfFilm(const std::string& path) {
  fs::path motion = fs::path(path).lexically_normal();
  if (!motion.has_filename()) motion = motion.parent_path();  // a folder's, by its name with a slash
  motion.replace_extension(kMotionFileEnding);
  throw InputError(path, "is a film, no motion; `" + toolCommand("skel-style") + " keypoints " +
                             shellWord(path) + " -o " + shellWord(motion.string()) + "` makes one of it");
}

int keysOf(const MotionFile& motion) {
  return int(
      std::count_if(motion.frames.begin(), motion.frames.end(), [](const MotionFrame& f) { return f.key; }));
}

}  // namespace

std::vector<DatabaseEntry> readDatabase(const std::string& dir) {
  if (!isDatabase(dir))
    throw InputError(dir, std::string("is no database: it has no ") + kDatabaseIndex +
                              "; skel-style database add makes one");
  std::vector<DatabaseEntry> entries;
  const JsonDocument document = JsonDocument::readFile(indexOf(dir));
  const JsonValue root = document.root();
  root.checkFormat(kFormat, 1);
  root.allowOnly({"format", "version", "motions"});
  std::set<std::string> files;
  for (const JsonValue& item : root.at("motions").items()) {
    item.allowOnly({"file", "action", "source", "frames", "keys", "sha256"});
    entries.push_back({item.at("file").asFileName(), item.at("action").asString(),
                       item.at("source").asFileName(), item.at("frames").asInt(1, kMaxFrames),
                       item.at("keys").asInt(0, kMaxFrames), item.at("sha256").asString()});
    if (fs::path(entries.back().file).has_parent_path())
      item.at("file").fail("must lie in the folder itself");
    if (!files.insert(entries.back().file).second) item.at("file").fail("stands there twice");
    pathInside(dir, entries.back().file, indexOf(dir));
  }
  return entries;
}

DatabaseEntry addToDatabase(const std::string& dir, const std::string& path, const std::string& action,
                            bool force) {
  const SkeletonTemplate plan = loadTemplate("biped");
  MotionFile motion = readMotion(path);
  if (!action.empty()) motion.action = action;
  if (motion.action.empty())
    throw InputError(path, "has no action class; name it by --action walk, run, jump ...");
  // Others may add at the same time.
  ensureWritableFolder(dir);
  const FolderLock lock(dir);
  std::vector<DatabaseEntry> entries;
  if (isDatabase(dir)) entries = readDatabase(dir);
  DatabaseEntry entry{fs::path(path).filename().string(), motion.action,  motion.source,
                      int(motion.frames.size()),          keysOf(motion), ""};
  const std::string to = (fs::path(dir) / entry.file).string();
  if (to == indexOf(dir)) throw InputError(path, "is named as the database's own index; rename it");
  if (!force && fs::exists(to)) throw InputError(to, "is there already; give --force to replace it");
  for (MotionFrame& frame : motion.frames)
    if (!frame.image_file.empty())
      frame.image_file = pathSeenFrom(to, (fs::path(path).parent_path() / frame.image_file).string());
  const std::string text = formatMotionFile(motion, plan);
  entry.sha256 = sha256(text);
  std::erase_if(entries, [&](const DatabaseEntry& e) { return e.file == entry.file; });
  entries.push_back(entry);
  std::sort(entries.begin(), entries.end(),
            [](const DatabaseEntry& a, const DatabaseEntry& b) { return a.file < b.file; });
  // A motion of the database itself may be added anew.
  std::error_code not_there;
  fs::equivalent(path, to, not_there) ? replaceFile(to, text) : writeFile(to, text);
  replaceFile(indexOf(dir), formatIndex(entries));
  return entry;
}

std::vector<std::string> checkDatabase(const std::string& dir) {
  const SkeletonTemplate plan = loadTemplate("biped");
  std::vector<std::string> problems;
  const std::vector<DatabaseEntry> entries = readDatabase(dir);
  for (const DatabaseEntry& e : entries) {
    const std::string path = (fs::path(dir) / e.file).string();
    try {
      const MotionFile motion = readMotionFile(path, plan);
      if (motion.action != e.action)
        problems.push_back(path + ": its class is \"" + motion.action + "\", the index says \"" + e.action +
                           "\"");
      else if (sha256(readFile(path)) != e.sha256)
        problems.push_back(path + ": has changed since it was added; add it again with --force");
    } catch (const InputError& error) {
      problems.push_back(error.what());
    }
  }
  for (const std::string& path : filesBelow(dir)) {
    if (!path.ends_with(kMotionFileEnding)) continue;
    const std::string name = fs::relative(path, dir).string();
    if (std::none_of(entries.begin(), entries.end(), [&](const DatabaseEntry& e) { return e.file == name; }))
      problems.push_back(path + ": stands in no index; add it");
  }
  return problems;
}

MotionFile readMotion(const std::string& path) {
  try {
    return readMotionFile(path, loadTemplate("biped"));
  } catch (const InputError&) {
    if (isFilm(path)) failOfFilm(path);
    throw;
  }
}

std::vector<NamedMotion> readMotions(const std::string& path) {
  if (!fs::is_directory(path)) return {{path, readMotion(path)}};
  if (!isDatabase(path) && isFilm(path)) failOfFilm(path);
  const SkeletonTemplate plan = loadTemplate("biped");
  std::vector<NamedMotion> motions;
  for (const DatabaseEntry& e : readDatabase(path)) {
    const std::string file = (fs::path(path) / e.file).string();
    motions.push_back({file, readMotionFile(file, plan)});
  }
  if (motions.empty())
    throw InputError(path, "is a database without motions; add some by skel-style database add");
  return motions;
}

}  // namespace skel
