#include "infer/deciding_options.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "libskel/core/files.h"
#include "libskel/core/sha256.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 17> kOthers = {
    "IMAGE",  "--out",     "--from",     "--null",  "--shard",   "--name",   "--resume", "--json",  "--jobs",
    "--help", "--version", "--help-all", "--quiet", "--timings", "--report", "--trace",  "--config"};

// Text that no other value has.
std::string contentOf(const std::string& value) {
  std::error_code not_there;
  if (fs::is_regular_file(value, not_there)) return "file " + sha256(readFile(value));
  if (!fs::is_directory(value, not_there)) return "text " + value;
  std::string all;
  for (const std::string& file : filesBelow(value))
    all += pathSeenFrom(value + "/.", file) + '\0' + sha256(readFile(file)) + '\n';
  return "folder " + sha256(all);
}

}  // namespace

std::vector<std::pair<std::string, std::vector<std::string>>> decidingOptions(const CLI::App& app) {
  std::vector<std::pair<std::string, std::vector<std::string>>> deciding;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    if (option->count() > 0 && std::count(kOthers.begin(), kOthers.end(), name) == 0)
      deciding.emplace_back(name, option->results());
  }
  return deciding;
}

std::string optionsHash(const InferOptions& options) {
  std::string all;
  for (const auto& [name, values] : options.deciding) {
    all += name + '\n';
    for (const std::string& value : values) all += contentOf(value) + '\0';
  }
  return sha256(all);
}

}  // namespace skel
