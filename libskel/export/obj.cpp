// Wavefront OBJ, for programs that want the shape alone.
#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/export/formats.h"
#include "libskel/export/number_text.h"
#include "libskel/image/write_image.h"
#include "libskel/mesh/vertex_normals.h"

namespace skel {

namespace {

template <class Row>
void appendRow(std::string& text, const char* keyword, const Row& row) {
  text += keyword;
  for (Eigen::Index i = 0; i < row.size(); ++i) {
    text += ' ';
    appendNumber(text, row[i]);
  }
  text += '\n';
}

// The stem as OBJ and MTL can name it.
std::string nameable(const std::string& stem) {
  for (const char c : stem)
    if (const auto byte = static_cast<unsigned char>(c); byte < 0x20 || byte == 0x7F || c == '#' || c == '\\')
      throw UsageError("the format obj cannot name \"" + safeFileName(stem) +
                       ".png\" as it is: rename the drawing, without #, \\ and line breaks");
  // Blanks before a name are lost, and a dash would begin an option.
  return stem.starts_with(' ') || stem.starts_with('-') ? "./" + stem : stem;
}

}  // namespace

std::vector<std::string> objSuffixes(const std::string& stem, const std::vector<Clip>&) {
  nameable(stem);
  return {".obj", ".mtl", ".png"};
}

std::vector<ExportedFile> exportObj(const ExportInput& input) {
  const TriangleMesh& mesh = input.character.mesh;
  const std::string name = nameable(input.options.name);
  const bool textured = !mesh.texture.empty() && mesh.uv.rows() == mesh.vertices.rows();
  const Eigen::MatrixX3f normals = vertexNormals(mesh.vertices, mesh.triangles);

  std::string obj = "# skel\nmtllib " + name + ".mtl\no " + input.options.name + "\n";
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) appendRow(obj, "v", mesh.vertices.row(i));
  if (textured)
    for (Eigen::Index i = 0; i < mesh.uv.rows(); ++i)
      appendRow(obj, "vt", Eigen::RowVector2f(mesh.uv(i, 0), 1 - mesh.uv(i, 1)));
  const bool parted = textured && mesh.back_uv.rows() == mesh.vertices.rows();
  if (parted)
    for (Eigen::Index i = 0; i < mesh.back_uv.rows(); ++i)
      appendRow(obj, "vt", Eigen::RowVector2f(mesh.back_uv(i, 0), 1 - mesh.back_uv(i, 1)));
  for (Eigen::Index i = 0; i < normals.rows(); ++i) appendRow(obj, "vn", normals.row(i));
  obj += "usemtl drawing\n";
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    obj += 'f';
    for (int k = 0; k < 3; ++k) {
      const std::string index = std::to_string(mesh.triangles(t, k) + 1);
      const bool back = parted && t >= mesh.first_back;
      const std::string corner =
          back ? std::to_string(mesh.triangles(t, k) + 1 + mesh.vertices.rows()) : index;
      obj += " " + index + "/" + (textured ? corner : "") + "/" + index;
    }
    obj += '\n';
  }

  std::string mtl = "newmtl drawing\nKd 1 1 1\nKs 0 0 0\n";
  if (textured) mtl += "map_Kd " + name + ".png\n";
  std::vector<ExportedFile> files;
  files.push_back({".obj", std::move(obj)});  // first: it is what was asked for
  files.push_back({".mtl", std::move(mtl)});
  if (textured) files.push_back({".png", encodePng(mesh.texture)});
  return files;
}

}  // namespace skel
