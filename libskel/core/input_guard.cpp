#include "libskel/core/input_guard.h"

#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "libskel/core/check.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

using Identity = std::pair<dev_t, ino_t>;

struct Lists {
  std::mutex mutex;
  bool on = false;
  std::map<Identity, std::string> inputs, outputs;
  std::set<Identity> own, pipes;
  std::map<std::string, std::string> named;  // outputs by their canonical paths
};

// Never destroyed: threads may still write while the program ends.
Lists& lists() {
  static Lists& all = *new Lists;
  return all;
}

thread_local int looks = 0;

// Of this thread, for now.
struct ForNow {
  bool on = false;
  std::set<Identity> inputs, outputs, own;
};
thread_local ForNow for_now;

bool identify(const std::string& path, Identity& identity) {
  struct stat status;
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
  identity = {status.st_dev, status.st_ino};
  return true;
}

[[noreturn]] void refuse(const std::string& output, const std::string& input) {
  throw OverwriteError(output + " would be written over, but it is an input" +
                       (input == output ? "" : " (" + input + ")") + "; name another output");
}

}  // namespace

void guardInputs() {
  const std::lock_guard lock(lists().mutex);
  lists().on = true;
}

void noteInput(const std::string& path) {
  Lists& all = lists();
  const std::lock_guard lock(all.mutex);
  Identity file;
  if (!all.on || looks > 0 || !identify(path, file) || all.own.contains(file)) return;
  if (all.inputs.emplace(file, path).second && for_now.on) for_now.inputs.insert(file);
  if (const auto output = all.outputs.find(file); output != all.outputs.end()) refuse(output->second, path);
}

void noteOutput(const std::string& path) {
  Lists& all = lists();
  const std::lock_guard lock(all.mutex);
  Identity file;
  if (!all.on || !identify(path, file) || all.own.contains(file)) return;
  if (const auto input = all.inputs.find(file); input != all.inputs.end()) refuse(path, input->second);
  if (all.outputs.emplace(file, path).second && for_now.on) for_now.outputs.insert(file);
}

void noteNamedOutput(const std::string& path) {
  if (path.empty()) throw UsageError("what is to be written has no name; name a file");
  if (path == "-") throw UsageError("- is the name of no output; /dev/stdout is the standard output");
  noteOutput(path);
  std::error_code failure;
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path), failure);
  const fs::file_type type = fs::status(path, failure).type();
  if (type == fs::file_type::none) throw OutputError(path, "cannot be written: " + failure.message());
  // Several things may go to one folder or one device.
  if (type != fs::file_type::regular && type != fs::file_type::not_found) return;
  Lists& all = lists();
  const std::lock_guard lock(all.mutex);
  if (!all.on) return;
  if (const auto [other, is_new] = all.named.emplace(canonical.string(), path); !is_new)
    throw UsageError(path + " is to be written twice" +
                     (other->second == path ? "" : ", also as " + other->second) +
                     "; name two different outputs");
}

void notePipe(const std::string& path) {
  struct stat status;
  if (::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode)) return;
  const std::lock_guard lock(lists().mutex);
  lists().pipes.insert({status.st_dev, status.st_ino});
}

bool mayOpenPipe(const struct stat& pipe) {
  const std::lock_guard lock(lists().mutex);
  return !lists().on || lists().pipes.contains({pipe.st_dev, pipe.st_ino});
}

void noteReplaced(const struct stat* before, const struct stat& after) {
  Lists& all = lists();
  const std::lock_guard lock(all.mutex);
  if (!all.on) return;
  // The system gives a number that has become free to the next new file.
  if (before && before->st_nlink <= 1) {
    const Identity gone{before->st_dev, before->st_ino};
    all.inputs.erase(gone), all.outputs.erase(gone), all.own.erase(gone);
    for_now.inputs.erase(gone), for_now.outputs.erase(gone), for_now.own.erase(gone);
  }
  const Identity own{after.st_dev, after.st_ino};
  if (all.own.insert(own).second && for_now.on) for_now.own.insert(own);
}

LookAtOutputs::LookAtOutputs() { ++looks; }
LookAtOutputs::~LookAtOutputs() { --looks; }

NotedForNow::NotedForNow() {
  SKEL_CHECK(!for_now.on);
  for_now.on = true;
}

NotedForNow::~NotedForNow() {
  Lists& all = lists();
  const std::lock_guard lock(all.mutex);
  for (const Identity& file : for_now.inputs) all.inputs.erase(file);
  for (const Identity& file : for_now.outputs) all.outputs.erase(file);
  for (const Identity& file : for_now.own) all.own.erase(file);
  for_now = {};
}

std::size_t notedFiles() {
  Lists& all = lists();
  const std::lock_guard lock(all.mutex);
  return all.inputs.size() + all.outputs.size() + all.own.size();
}

}  // namespace skel
