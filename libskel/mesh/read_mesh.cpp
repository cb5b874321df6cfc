#include "libskel/mesh/read_mesh.h"

#include <algorithm>
#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/foreign_files.h"
#include "libskel/mesh/obj.h"

namespace skel {

TriangleMesh readMesh(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : static_cast<char>(c);
  });
  if (ending == ".obj") return readObj(path);
  if (const std::string remedy = howToConvert(path); !remedy.empty()) throw InputError(path, remedy);
  throw InputError(path, "is no model that can be read; export it as OBJ");
}

}  // namespace skel
