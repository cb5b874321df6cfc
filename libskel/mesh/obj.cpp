#include "libskel/mesh/obj.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/number_chars.h"
#include "libskel/image/read_image.h"
#include "libskel/mesh/cut_polygon.h"
#include "libskel/mesh/plain_texture.h"
#include "libskel/mesh/texture_atlas.h"

namespace skel {
namespace {

constexpr std::string_view kBlank = " \t\r";
constexpr double kMaxWidth = 1e4;                                      // of a model, in its heights
constexpr std::size_t kMostCorners = 10000;                            // of a face
constexpr std::size_t kMostLibraries = 100;                            // of materials
constexpr std::size_t kMostCutting = 5 * kMostCorners * kMostCorners;  // of all faces: their corners squared

// A text file line by line: without comments, with lines that end in a backslash joined.
class Lines {
 public:
  explicit Lines(const std::string& path) : path_(path), text_(readFile(path)) {}

  // `line` lasts until the next one.
  bool next(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    number_ = following_;
    line = part();
    if (!line.ends_with('\\')) return true;
    joined_.clear();
    for (std::string_view more = line;; more = part()) {
      const bool last = !more.ends_with('\\');
      joined_.append(more.substr(0, more.size() - (last ? 0 : 1))).append(last ? "" : " ");
      if (last || at_ >= text_.size()) break;
    }
    line = joined_;
    return true;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(path_, "line " + std::to_string(number_) + ": " + problem);
  }

 private:
  // What one line of the file says.
  std::string_view part() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view part(text_.data() + at_, end - at_);
    at_ = end + 1;
    ++following_;
    part = part.substr(0, part.find('#'));
    return part.substr(0, part.find_last_not_of(kBlank) + 1);
  }

  std::string path_, text_, joined_;
  std::size_t at_ = 0;
  int number_ = 0, following_ = 1;
};

void splitWords(std::string_view line, std::vector<std::string_view>& result) {
  result.clear();
  for (;;) {
    const std::size_t begin = line.find_first_not_of(kBlank);
    if (begin == std::string_view::npos) return;
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
    const auto [end, error] = from_chars(word.data(), word.data() + word.size(), result[k]);
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
std::string remainder(std::string_view line, std::string_view keyword) {
  const std::size_t begin = line.find_first_not_of(kBlank, line.find(keyword) + keyword.size());
  return begin == std::string_view::npos ? "" : std::string(line.substr(begin));
}

std::string besides(const std::string& path, std::string name) {
  for (char& c : name) {
    if (c == '\\') c = '/';
  }
  return (std::filesystem::path(path).parent_path() / name).string();
}

// One file has many paths: ./a.png, b/../a.png, links.
std::string sameForAllNames(const std::string& path) {
  std::error_code unknown;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(path, unknown);
  return unknown ? path : whole.string();
}

struct Material {
  Eigen::Array3f color = Eigen::Array3f::Ones();  // Kd
  std::string picture;                            // a path; empty: none
};

// In the order of their files; of two with one name the first counts.
struct Materials {
  std::deque<Material> all;
  std::map<std::string, const Material*> by_name;
};

void readMaterials(const std::string& mtl, Materials& materials) {
  Lines lines(mtl);
  Material* material = nullptr;
  Material ignored;
  std::vector<std::string_view> word;
  for (std::string_view line; lines.next(line);) {
    splitWords(line, word);
    if (word.empty()) continue;
    if (word[0] == "newmtl") {
      const std::string name = remainder(line, "newmtl");
      if (materials.by_name.contains(name)) {
        material = &ignored;
      } else {
        material = &materials.all.emplace_back();
        materials.by_name.emplace(name, material);
      }
    } else if (material && word[0] == "Kd") {
      material->color = numbers<3>(lines, word).array().max(0.0f).min(1.0f);
    } else if (material && word[0] == "map_Kd" && material->picture.empty()) {
      if (word.size() < 2) lines.fail("map_Kd names no picture");
      // Options such as "-s 1 1 1" come before the name.
      const bool options = word[1].starts_with('-');
      material->picture = besides(mtl, options ? std::string(word.back()) : remainder(line, "map_Kd"));
    }
  }
}

using Corner = std::array<int, 2>;  // position, texture coordinate or -1

struct Triangle {
  std::array<Corner, 3> corners;
  int material;  // index into Obj::used, -1: none
};

// What an OBJ file says.
struct Obj {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector2f> coordinates;
  std::vector<Triangle> triangles;
  std::vector<std::string> libraries, used;  // files of materials; names of materials; each once
};

Obj parseObj(const std::string& path) {
  Lines lines(path);
  Obj obj;
  int material = -1;
  std::set<std::string> libraries;
  std::map<std::string, int> used;
  std::vector<std::string_view> word;
  std::vector<Corner> polygon;
  std::vector<Eigen::Vector3f> places;
  std::size_t cutting = 0;
  const auto addTriangle = [&](int a, int b, int c) {
    const Triangle triangle{{polygon[a], polygon[b], polygon[c]}, material};
    const auto& [p, q, r] = triangle.corners;
    // A corner named twice has no area: nothing is lost.
    if (p[0] != q[0] && q[0] != r[0] && r[0] != p[0]) obj.triangles.push_back(triangle);
  };
  for (std::string_view line; lines.next(line);) {
    splitWords(line, word);
    if (word.empty()) continue;
    if (word[0] == "v") {
      obj.positions.push_back(numbers<3>(lines, word));
      if (obj.positions.back().cwiseAbs().maxCoeff() > float(kFarthest))
        lines.fail("a vertex is farther than 1e6 from the origin");
    } else if (word[0] == "vt") {
      const Eigen::Vector2f uv = numbers<2>(lines, word);
      obj.coordinates.emplace_back(uv.x(), 1 - uv.y());  // OBJ's v goes up
    } else if (word[0] == "mtllib") {
      std::string library = remainder(line, "mtllib");
      if (libraries.insert(library).second) obj.libraries.push_back(std::move(library));
      if (libraries.size() > kMostLibraries)
        lines.fail("the model names more than " + std::to_string(kMostLibraries) +
                   " files of materials; join them");
    } else if (word[0] == "usemtl") {
      const std::string name = remainder(line, "usemtl");
      const auto [known, is_new] = used.emplace(name, static_cast<int>(obj.used.size()));
      material = known->second;
      if (is_new) obj.used.push_back(name);
    } else if (word[0] == "f") {
      if (word.size() < 4) lines.fail("a face needs at least 3 corners");
      if (word.size() > kMostCorners + 1)
        lines.fail("a face has " + std::to_string(word.size() - 1) + " corners, at most " +
                   std::to_string(kMostCorners) + " are read; export the model as triangles");
      polygon.clear();
      for (std::size_t k = 1; k < word.size(); ++k) {
        const std::size_t slash = word[k].find('/');
        Corner corner{reference(lines, word[k].substr(0, slash), obj.positions.size(), "vertex"), -1};
        if (slash != std::string_view::npos) {
          const std::string_view rest = word[k].substr(slash + 1);
          const std::string_view uv = rest.substr(0, rest.find('/'));
          if (!uv.empty()) corner[1] = reference(lines, uv, obj.coordinates.size(), "texture coordinate");
        }
        polygon.push_back(corner);
      }
      if (polygon.size() == 3) {
        addTriangle(0, 1, 2);
        continue;
      }
      cutting += polygon.size() * polygon.size();
      if (cutting > kMostCutting)
        lines.fail("the faces have too many corners to be cut; export the model as triangles");
      places.clear();
      for (const Corner& corner : polygon) places.push_back(obj.positions[corner[0]]);
      for (const auto& [a, b, c] : cutPolygon(places)) addTriangle(a, b, c);
    }
  }
  if (obj.triangles.empty()) throw InputError(path, "holds no faces; export the model as a polygon mesh");
  return obj;
}

// What a triangle looks like: a picture, or one colour.
struct Looks {
  std::vector<AtlasTile> tiles;  // several of them, or one picture; empty: all is plain
  std::vector<int> of_triangle;
  std::vector<bool> plain;  // tiles of one colour
};

InputError texturesDoNotFit(const std::string& path) {
  return InputError(path, "its textures do not fit into one of " + std::to_string(kMaxAtlas_px) +
                              " px a side; make them smaller, or repeat less often");
}

bool hasCoordinates(const Triangle& triangle) {
  return std::all_of(triangle.corners.begin(), triangle.corners.end(),
                     [](const Corner& c) { return c[1] >= 0; });
}

Looks looksOf(const Obj& obj, const std::string& path) {
  Materials materials;
  std::set<std::string> read;
  for (const std::string& library : obj.libraries)
    if (const std::string mtl = besides(path, library); read.insert(sameForAllNames(mtl)).second)
      readMaterials(mtl, materials);
  const Material none;
  const auto named = [&](int used) -> const Material& {
    // A file that never says which is meant means the first picture.
    if (obj.used.empty())
      for (const Material& material : materials.all)
        if (!material.picture.empty()) return material;
    if (used < 0) return none;
    const auto known = materials.by_name.find(obj.used[static_cast<std::size_t>(used)]);
    return known == materials.by_name.end() ? none : *known->second;
  };
  Looks looks;
  double pixels = 0;  // of all pictures
  std::map<std::string, int> by_look;
  std::vector<std::array<int, 2>> of_material(obj.used.size() + 1,
                                              {-1, -1});  // with coordinates, and without
  for (const Triangle& triangle : obj.triangles) {
    const bool coordinates = hasCoordinates(triangle);
    int& look = of_material[static_cast<std::size_t>(triangle.material + 1)][coordinates ? 0 : 1];
    if (look < 0) {
      const Material& material = named(triangle.material);
      const bool picture = coordinates && !material.picture.empty();
      const Eigen::Array3i rgb = (255 * material.color + 0.5f).cast<int>();
      const std::string key =
          picture ? "picture " + sameForAllNames(material.picture)
                  : std::to_string(rgb[0]) + " " + std::to_string(rgb[1]) + " " + std::to_string(rgb[2]);
      const auto [known, added] = by_look.emplace(key, static_cast<int>(looks.tiles.size()));
      look = known->second;
      if (added) {
        AtlasTile tile;
        if (picture) {
          tile.image = readImage(material.picture);
          pixels += static_cast<double>(tile.image.width) * tile.image.height;
        } else {
          tile.image = plainTexture({static_cast<std::uint8_t>(rgb[0]), static_cast<std::uint8_t>(rgb[1]),
                                     static_cast<std::uint8_t>(rgb[2])});
        }
        looks.tiles.push_back(std::move(tile));
        looks.plain.push_back(!picture);
        // Not all are read before that is said.
        if (looks.tiles.size() > 1 && pixels > 1. * kMaxAtlas_px * kMaxAtlas_px) throw texturesDoNotFit(path);
      }
    }
    looks.of_triangle.push_back(look);
  }
  const bool white = looks.tiles.size() == 1 && looks.plain[0] && (looks.tiles[0].image.rgba == 255).all();
  if (white) looks.tiles.clear();
  return looks;
}

// Rows of the mesh by what they show.
class Rows {
 public:
  explicit Rows(std::size_t triangles) : table_(std::bit_ceil(6 * triangles + 1), -1) {}

  struct Row {
    int position, coordinate, look;
    bool operator==(const Row&) const = default;
  };
  int of(const Row& row) {
    std::uint64_t hash = static_cast<std::uint32_t>(row.position);
    hash |= std::uint64_t{static_cast<std::uint32_t>(row.coordinate)} << 32;
    hash ^= std::uint64_t{static_cast<std::uint32_t>(row.look)} * 0x9e3779b97f4a7c15u;
    // The finalizer of MurmurHash3 (A. Appleby): positions and coordinates often count in step.
    hash = (hash ^ hash >> 33) * 0xff51afd7ed558ccdu;
    hash = (hash ^ hash >> 33) * 0xc4ceb9fe1a85ec53u;
    hash ^= hash >> 33;
    std::size_t slot = hash & (table_.size() - 1);
    while (table_[slot] >= 0 && !(rows[static_cast<std::size_t>(table_[slot])] == row))
      slot = (slot + 1) & (table_.size() - 1);
    if (table_[slot] < 0) {
      table_[slot] = static_cast<int>(rows.size());
      rows.push_back(row);
    }
    return table_[slot];
  }

  std::vector<Row> rows;

 private:
  std::vector<int> table_;
};

}  // namespace

TriangleMesh readObj(const std::string& path) {
  const Obj obj = parseObj(path);
  Looks looks = looksOf(obj, path);
  TriangleMesh mesh;
  Rows rows(obj.triangles.size());
  const auto rowOf = [&](std::size_t t, int k) -> Rows::Row {
    const int look = looks.tiles.empty() ? -1 : looks.of_triangle[t];
    const bool pictured = look >= 0 && !looks.plain[static_cast<std::size_t>(look)];
    const Corner& corner = obj.triangles[t].corners[static_cast<std::size_t>(k)];
    return {corner[0], pictured ? corner[1] : -1, look};
  };
  // The first rows of all positions come before the others.
  std::vector<Rows::Row> firsts(obj.positions.size(), {-1, -1, -1});
  for (std::size_t t = 0; t < obj.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Rows::Row row = rowOf(t, k);
      Rows::Row& first = firsts[static_cast<std::size_t>(row.position)];
      if (first.position < 0) first = row;
    }
  for (const Rows::Row& first : firsts)
    if (first.position >= 0) rows.of(first);
  mesh.triangles.resize(static_cast<Eigen::Index>(obj.triangles.size()), 3);
  for (std::size_t t = 0; t < obj.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) mesh.triangles(static_cast<Eigen::Index>(t), k) = rows.of(rowOf(t, k));
  mesh.vertices.resize(static_cast<Eigen::Index>(rows.rows.size()), 3);
  mesh.file_vertex.resize(mesh.vertices.rows());
  mesh.file_vertices = static_cast<Eigen::Index>(obj.positions.size());
  for (std::size_t v = 0; v < rows.rows.size(); ++v) {
    const int position = rows.rows[v].position;
    mesh.vertices.row(static_cast<Eigen::Index>(v)) = obj.positions[static_cast<std::size_t>(position)];
    mesh.file_vertex[static_cast<Eigen::Index>(v)] = position;
  }
  const Eigen::RowVector3d size =
      mesh.vertices.colwise().maxCoeff().cast<double>() - mesh.vertices.colwise().minCoeff().cast<double>();
  if (!(size.y() * kMaxWidth > size.maxCoeff()))
    throw InputError(path, "is flat: it has no height along y; turn it so that y points up");
  if (looks.tiles.empty()) return mesh;

  const Eigen::Array2f middle(0.5f, 0.5f);
  mesh.uv.resize(mesh.vertices.rows(), 2);
  for (std::size_t v = 0; v < rows.rows.size(); ++v) {
    const Rows::Row& row = rows.rows[v];
    const Eigen::Array2f uv = row.coordinate < 0
                                  ? middle
                                  : Eigen::Array2f(obj.coordinates[static_cast<std::size_t>(row.coordinate)]);
    mesh.uv.row(static_cast<Eigen::Index>(v)) = uv.transpose();
    AtlasTile& tile = looks.tiles[static_cast<std::size_t>(row.look)];
    tile.low = tile.low.min(uv), tile.high = tile.high.max(uv);
  }
  if (looks.tiles.size() == 1) {
    mesh.texture = std::move(looks.tiles[0].image);
    return mesh;
  }
  TextureAtlas atlas = packAtlas(looks.tiles);
  if (atlas.image.empty()) throw texturesDoNotFit(path);
  for (std::size_t v = 0; v < rows.rows.size(); ++v) {
    const auto look = static_cast<std::size_t>(rows.rows[v].look);
    const auto row = static_cast<Eigen::Index>(v);
    mesh.uv.row(row) =
        (atlas.scale[look] * mesh.uv.row(row).transpose().array() + atlas.offset[look]).transpose();
  }
  mesh.texture = std::move(atlas.image);
  return mesh;
}

}  // namespace skel
