#include "libskel/mesh/obj.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/image/read_image.h"
#include "libskel/mesh/cut_polygon.h"

namespace skel {
namespace {

constexpr std::string_view kBlank = " \t\r";
constexpr double kMaxWidth = 1e4;            // of a model, in its heights
constexpr std::size_t kMostCorners = 10000;  // of a face

// A text file line by line: without comments, with lines that end in a backslash joined.
class Lines {
 public:
  explicit Lines(const std::string& path) : path_(path), text_(readFile(path)) {}

  bool next(std::string& line) {
    line.clear();
    if (at_ >= text_.size()) return false;
    number_ = following_;
    for (bool more = true; more && at_ < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      std::string_view part(text_.data() + at_, end - at_);
      at_ = end + 1;
      ++following_;
      part = part.substr(0, part.find('#'));
      part = part.substr(0, part.find_last_not_of(kBlank) + 1);
      more = part.ends_with('\\');
      if (more) part.remove_suffix(1);
      line.append(part).append(more ? " " : "");
    }
    return true;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(path_, "line " + std::to_string(number_) + ": " + problem);
  }

 private:
  std::string path_, text_;
  std::size_t at_ = 0;
  int number_ = 0, following_ = 1;
};

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> result;
  for (;;) {
    const std::size_t begin = line.find_first_not_of(kBlank);
    if (begin == std::string_view::npos) return result;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(kBlank), line.size());
    result.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

// The first `count` numbers after the keyword; more may follow (weights, colours).
template <int kCount>
Eigen::Matrix<float, kCount, 1> numbers(const Lines& lines, const std::vector<std::string_view>& line) {
  if (line.size() < kCount + 1) {
    lines.fail("'" + std::string(line[0]) + "' needs " + std::to_string(kCount) + " numbers");
  }
  Eigen::Matrix<float, kCount, 1> result;
  for (int k = 0; k < kCount; ++k) {
    std::string_view word = line[k + 1];
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), result[k]);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(result[k])) {
      lines.fail("'" + std::string(line[k + 1]) + "' is not a finite number");
    }
  }
  return result;
}

// OBJ counts from 1, and backwards from -1.
int reference(const Lines& lines, std::string_view word, std::size_t count, const char* what) {
  int index = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
  if (error != std::errc() || end != word.data() + word.size()) {
    lines.fail("'" + std::string(word) + "' is not the index of a " + what);
  }
  const long at = index < 0 ? static_cast<long>(count) + index : index - 1L;
  if (at < 0 || at >= static_cast<long>(count)) {
    lines.fail("there is no " + std::string(what) + " " + std::to_string(index) + "; " +
               std::to_string(count) + " are defined so far");
  }
  return static_cast<int>(at);
}

// What follows a keyword, blanks inside it included: names of files may have some.
std::string remainder(const std::string& line, std::string_view keyword) {
  const std::size_t begin = line.find_first_not_of(kBlank, line.find(keyword) + keyword.size());
  return begin == std::string::npos ? "" : line.substr(begin);
}

std::string besides(const std::string& path, std::string name) {
  for (char& c : name) {
    if (c == '\\') c = '/';
  }
  return (std::filesystem::path(path).parent_path() / name).string();
}

// The first map_Kd of the materials that the mesh uses.
std::optional<std::string> textureFile(const std::string& mtl, const std::vector<std::string>& used) {
  Lines lines(mtl);
  std::string material;
  for (std::string line; lines.next(line);) {
    const std::vector<std::string_view> word = words(line);
    if (word.empty()) continue;
    if (word[0] == "newmtl") material = remainder(line, "newmtl");
    if (word[0] != "map_Kd") continue;
    if (!used.empty() && std::find(used.begin(), used.end(), material) == used.end()) continue;
    if (word.size() < 2) lines.fail("map_Kd names no picture");
    // Options such as "-s 1 1 1" come before the name.
    const bool options = word[1].starts_with('-');
    return besides(mtl, options ? std::string(word.back()) : remainder(line, "map_Kd"));
  }
  return std::nullopt;
}

}  // namespace

TriangleMesh readObj(const std::string& path) {
  Lines lines(path);
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector2f> coordinates;
  using Corner = std::array<int, 2>;  // position, texture coordinate or -1
  std::vector<std::array<Corner, 3>> triangles;
  std::vector<std::string> libraries, materials;
  bool textured = true;
  std::vector<Corner> polygon;
  for (std::string line; lines.next(line);) {
    const std::vector<std::string_view> word = words(line);
    if (word.empty()) continue;
    if (word[0] == "v") {
      positions.push_back(numbers<3>(lines, word));
    } else if (word[0] == "vt") {
      const Eigen::Vector2f uv = numbers<2>(lines, word);
      coordinates.emplace_back(uv.x(), 1 - uv.y());  // OBJ's v goes up
    } else if (word[0] == "mtllib") {
      libraries.push_back(remainder(line, "mtllib"));
    } else if (word[0] == "usemtl") {
      materials.push_back(remainder(line, "usemtl"));
    } else if (word[0] == "f") {
      if (word.size() < 4) lines.fail("a face needs at least 3 corners");
      if (word.size() > kMostCorners + 1)
        lines.fail("a face has " + std::to_string(word.size() - 1) + " corners, at most " +
                   std::to_string(kMostCorners) + " are read; export the model as triangles");
      polygon.clear();
      for (std::size_t k = 1; k < word.size(); ++k) {
        const std::size_t slash = word[k].find('/');
        Corner corner{reference(lines, word[k].substr(0, slash), positions.size(), "vertex"), -1};
        if (slash != std::string_view::npos) {
          const std::string_view rest = word[k].substr(slash + 1);
          const std::string_view uv = rest.substr(0, rest.find('/'));
          if (!uv.empty()) corner[1] = reference(lines, uv, coordinates.size(), "texture coordinate");
        }
        textured = textured && corner[1] >= 0;
        polygon.push_back(corner);
      }
      std::vector<Eigen::Vector3f> corners;
      for (const Corner& corner : polygon) corners.push_back(positions[corner[0]]);
      for (const auto& [a, b, c] : cutPolygon(corners)) {
        const std::array<Corner, 3> triangle{polygon[a], polygon[b], polygon[c]};
        // A corner named twice has no area: nothing is lost.
        if (triangle[0][0] == triangle[1][0] || triangle[1][0] == triangle[2][0] ||
            triangle[2][0] == triangle[0][0]) {
          continue;
        }
        triangles.push_back(triangle);
      }
    }
  }
  if (triangles.empty()) throw InputError(path, "holds no faces; export the model as a polygon mesh");

  TriangleMesh mesh;
  std::map<Corner, int> index;
  std::vector<Corner> corners;
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      Corner corner = triangles[t][k];
      if (!textured) corner[1] = -1;
      const auto [found, added] = index.try_emplace(corner, static_cast<int>(corners.size()));
      if (added) corners.push_back(corner);
      mesh.triangles(static_cast<Eigen::Index>(t), k) = found->second;
    }
  }
  mesh.vertices.resize(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t v = 0; v < corners.size(); ++v) {
    mesh.vertices.row(static_cast<Eigen::Index>(v)) = positions[corners[v][0]];
  }
  const Eigen::RowVector3d size =
      mesh.vertices.colwise().maxCoeff().cast<double>() - mesh.vertices.colwise().minCoeff().cast<double>();
  if (!(size.y() * kMaxWidth > size.maxCoeff()))
    throw InputError(path, "is flat: it has no height along y; turn it so that y points up");
  if (!textured) return mesh;
  for (const std::string& library : libraries) {
    const std::optional<std::string> picture = textureFile(besides(path, library), materials);
    if (!picture) continue;
    mesh.texture = readImage(*picture);
    mesh.uv.resize(static_cast<Eigen::Index>(corners.size()), 2);
    for (std::size_t v = 0; v < corners.size(); ++v) {
      mesh.uv.row(static_cast<Eigen::Index>(v)) = coordinates[corners[v][1]];
    }
    break;
  }
  return mesh;
}

}  // namespace skel
