#include "libskel/core/own_format.h"

#include <fstream>

#include "libskel/core/error.h"
#include "libskel/core/net_format.h"
#include "libskel/core/standard_output.h"

namespace skel {
namespace {

constexpr std::size_t kHeader = 4096;

// For people.
std::string nameOf(std::string_view format) {
  const std::string net = netFormatName(format);
  return !net.empty() ? net : "a file of format \"" + std::string(format) + '"';
}

}  // namespace

std::string ownFormatOf(std::string_view bytes) {
  constexpr std::string_view kKey = "\"format\"", kOwn = "skel-";
  const std::string_view header = bytes.substr(0, kHeader);
  const std::size_t key = header.find(kKey);
  if (key == header.npos) return {};
  const std::size_t first = header.find('"', key + kKey.size());
  if (first == header.npos) return {};
  const std::string_view found = header.substr(first + 1, header.find('"', first + 1) - first - 1);
  return found.starts_with(kOwn) ? std::string(found) : std::string();
}

void keepOtherFormats(const std::string& path, std::string_view format) {
  if (!isFileToReplace(path)) return;
  std::string header(kHeader, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(header.data(), static_cast<std::streamsize>(header.size()));
  header.resize(static_cast<std::size_t>(file.gcount()));
  const std::string there = ownFormatOf(header);
  if (there.empty() || there == format) return;
  throw OutputError(path, "is " + nameOf(there) + ", and would be replaced by " +
                              (format.empty() ? "something else" : nameOf(format)) + "; name another output");
}

}  // namespace skel
