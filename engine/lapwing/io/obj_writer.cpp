#include "lapwing/io/formats.h"
#include "lapwing/io/writing.h"

namespace lapwing {
namespace {

template <class Vector>
void append_line(std::string& out, std::string_view keyword, const Vector& values) {
  out += keyword;
  append_numbers(out, values);
  out += '\n';
}

void append_vertices(std::string& out, const Mesh& mesh) {
  const auto& colors = mesh.attributes().vertex_colors;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    out += 'v';
    append_numbers(out, mesh.positions[v]);
    if (!colors.empty()) append_numbers(out, colors[v].head<3>());
    out += '\n';
  }
}

void append_corner(std::string& out, const Mesh& mesh, std::size_t corner) {
  const MeshAttributes& a = mesh.attributes();
  const Index vertex = mesh.face_vertices()[corner];
  const Index uv = a.corner_uvs.empty() ? kNoIndex : a.corner_uvs[corner];
  Index normal = a.corner_normals.empty() ? kNoIndex : a.corner_normals[corner];
  if (a.has_vertex_normals) normal = vertex;

  const auto append_index = [&out](Index i) { append_number(out, std::size_t{i} + 1); };
  out += ' ';
  append_index(vertex);
  if (uv == kNoIndex && normal == kNoIndex) return;
  out += '/';
  if (uv != kNoIndex) append_index(uv);
  if (normal == kNoIndex) return;
  out += '/';
  append_index(normal);
}

// Appends a `usemtl` or `g` statement if the label differs from that of the previous face.
void append_label(std::string& out, std::string_view keyword, const std::vector<std::string>& names,
                  const std::vector<Index>& of_face, std::size_t face) {
  if (of_face.empty()) return;
  const Index before = face == 0 ? kNoIndex : of_face[face - 1];
  if (of_face[face] == before) return;
  out += keyword;
  if (of_face[face] != kNoIndex) out += " " + as_line(names[of_face[face]]);
  out += '\n';
}

void append_faces(std::string& out, const Mesh& mesh) {
  const MeshAttributes& a = mesh.attributes();
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    append_label(out, "g", a.groups, a.face_groups, f);
    append_label(out, "usemtl", a.materials, a.face_materials, f);
    out += 'f';
    for (std::size_t c = mesh.face_starts()[f]; c < mesh.face_starts()[f + 1]; ++c) {
      append_corner(out, mesh, c);
    }
    out += '\n';
  }
}

}  // namespace

std::string write_obj(const Mesh& mesh, WriteReport& report) {
  const MeshAttributes& a = mesh.attributes();
  std::string out;
  for (const std::string& comment : a.comments) out += "# " + as_line(comment) + "\n";
  for (const std::string& library : a.material_libraries)
    out += "mtllib " + as_line(library) + "\n";
  append_vertices(out, mesh);
  for (const Eigen::Vector2d& uv : a.uvs) append_line(out, "vt", uv);
  for (const Eigen::Vector3d& normal : a.normals) append_line(out, "vn", normal);
  append_faces(out, mesh);

  if (has_alpha(a.vertex_colors)) {
    report_loss(report, MeshFormat::obj, "opacities of vertex colours", a.vertex_colors.size());
  }
  report_loss(report, MeshFormat::obj, "face colours", a.face_colors.size());
  report_extras(report, MeshFormat::obj, a);
  report_uneditable(report, MeshFormat::obj, a);
  return out;
}

}  // namespace lapwing
