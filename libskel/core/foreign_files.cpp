#include "libskel/core/foreign_files.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

#include "libskel/core/file_names.h"

namespace skel {
namespace {

constexpr std::string_view kRigged =
    "; open it in Blender and export it as glTF Binary (.glb), or as OBJ without its skeleton";
constexpr std::string_view kLoose =
    ": loose triangles without parts, colours or units; open it in Blender and export it as OBJ";
constexpr std::string_view kHeif =
    "; convert it by `heif-convert {} {png}` (Debian's package libheif-examples)";
constexpr std::string_view kPainted = "; open it in Krita or GIMP and export it as PNG";

// `{}` stands for the file, `{png}` for one beside it, `{stem}` for those without an ending, as words for the
// shell.
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
    {".heic", "a HEIC picture", kHeif},
    {".heif", "a HEIC picture", kHeif},
    {".avif", "an AVIF picture", kHeif},
    {".svg", "an SVG drawing",
     "; convert it by `rsvg-convert -h 1000 {} -o {png}` (Debian's package librsvg2-bin)"},
    {".pdf", "a PDF file",
     "; convert its pages by `pdftoppm -r 150 -png {} {stem}` (Debian's package poppler-utils)"},
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
  return howToConvert(path, ending);
}

std::string howToConvert(const std::string& path, std::string_view ending) {
  const std::filesystem::path file(path), stem = file.parent_path() / file.stem();
  for (const Kind& kind : kKinds) {
    if (kind.ending != ending) continue;
    std::string text = "is " + std::string(kind.what) + std::string(kind.remedy);
    const std::pair<std::string_view, std::string> words[] = {
        {"{}", path}, {"{png}", stem.string() + ".png"}, {"{stem}", stem.string()}};
    // From behind: a file may be called by such a word.
    for (std::size_t at = text.rfind('{'); at != std::string::npos && at > 0; at = text.rfind('{', at - 1))
      for (const auto& [word, name] : words)
        if (text.compare(at, word.size(), word) == 0) text.replace(at, word.size(), shellWord(name));
    return text;
  }
  return {};
}

void passOverConverted(std::vector<std::string>& pictures) {
  const auto isRead = [](const std::string& picture) { return howToConvert(picture).empty(); };
  const auto nameOf = [](const std::string& picture) {
    return std::filesystem::path(picture).replace_extension();
  };
  std::set<std::filesystem::path> read;
  for (const std::string& picture : pictures)
    if (isRead(picture)) read.insert(nameOf(picture));
  std::erase_if(pictures, [&](const std::string& picture) {
    return !isRead(picture) && read.contains(nameOf(picture));
  });
}

}  // namespace skel
