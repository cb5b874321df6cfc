#include "libskel/core/foreign_files.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "libskel/core/file_names.h"

namespace skel {
namespace {

constexpr std::string_view kRigged =
    "; open it in Blender and export it as glTF Binary (.glb), or as OBJ without its skeleton";
constexpr std::string_view kLoose =
    ": loose triangles without parts, colours or units; open it in Blender and export it as OBJ";
constexpr std::string_view kPainted = "; open it in Krita or GIMP and export it as PNG";

// `{}` stands for the file, as a word for the shell.
struct Kind {
  std::string_view ending, what, remedy;
};
constexpr Kind kKinds[] = {
    {".fbx", "an FBX file", kRigged},
    {".dae", "a Collada file", kRigged},
    {".gltf", "a glTF file in parts", kRigged},
    {".blend", "a Blender file", "; export it as glTF Binary (.glb), or as OBJ without its skeleton"},
    {".usdz", "a USD file", kRigged},
    {".usd", "a USD file", kRigged},
    {".stl", "an STL file", kLoose},
    {".ply", "a PLY file", kLoose},
    {".heic", "a HEIC picture", "; convert it by `heif-convert {} out.png`"},
    {".heif", "a HEIC picture", "; convert it by `heif-convert {} out.png`"},
    {".avif", "an AVIF picture", "; convert it by `heif-convert {} out.png`"},
    {".svg", "an SVG drawing", "; convert it by `rsvg-convert -h 1000 {} -o out.png`"},
    {".pdf", "a PDF file", "; convert its pages by `pdftoppm -r 150 -png {} page`"},
    {".psd", "a Photoshop file", kPainted},
    {".xcf", "a GIMP file", kPainted},
    {".kra", "a Krita file", kPainted},
};

}  // namespace

std::string howToConvert(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : static_cast<char>(c);
  });
  for (const Kind& kind : kKinds) {
    if (kind.ending != ending) continue;
    std::string text = "is " + std::string(kind.what) + std::string(kind.remedy);
    if (const std::size_t at = text.find("{}"); at != std::string::npos) text.replace(at, 2, shellWord(path));
    return text;
  }
  return {};
}

}  // namespace skel
