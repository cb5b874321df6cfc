#include "animator/glb_output.h"

#include <filesystem>

#include "libskel/animation/clip_file.h"
#include "libskel/core/error.h"
#include "libskel/import/read_character.h"

namespace skel {
namespace fs = std::filesystem;

std::string glbNamedAfter(const std::string& source, const std::string& writer) {
  const std::string path = "out/" + clipNameIn(source) + ".glb";
  if (std::error_code unknown; fs::exists(path, unknown) && generatorOfGlb(path) != writer)
    throw UsageError(path + " is there, and was not written by " + writer + ": name the file to write by -o");
  return path;
}

}  // namespace skel
