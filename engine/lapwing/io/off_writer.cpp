#include <cmath>

#include "lapwing/io/formats.h"
#include "lapwing/io/writing.h"

namespace lapwing {
namespace {

// Writes a list of colours: as bytes if that is lossless and readers cannot mistake them for
// fractions, and with opacity if one is not opaque.
class OffColors {
 public:
  explicit OffColors(const std::vector<Eigen::Vector4f>& colors)
      : colors_(colors), components_(has_alpha(colors) ? 4 : 3), bytes_(fit_bytes(colors)) {
    bool above_one = false;
    for (const Eigen::Vector4f& color : colors) {
      above_one = above_one || color.head<3>().maxCoeff() > 1.5F / 255.0F;
    }
    bytes_ = bytes_ && above_one;
  }

  void append(std::string& out, std::size_t element) const {
    if (colors_.empty()) return;
    for (Eigen::Index k = 0; k < components_; ++k) {
      const float value = colors_[element][k];
      out += ' ';
      if (bytes_) {
        append_number(out, static_cast<std::size_t>(std::lround(value * 255.0F)));
      } else {
        append_number(out, value);
      }
    }
  }

 private:
  const std::vector<Eigen::Vector4f>& colors_;
  Eigen::Index components_;
  bool bytes_;
};

}  // namespace

std::string write_off(const Mesh& mesh, WriteReport& report) {
  const MeshAttributes& a = mesh.attributes();
  const auto normals = per_vertex(mesh, a.normals, a.corner_normals);
  const auto uvs = per_vertex(mesh, a.uvs, a.corner_uvs);
  const OffColors vertex_colors(a.vertex_colors);
  const OffColors face_colors(a.face_colors);

  std::string out;
  if (uvs) out += "ST";
  if (!a.vertex_colors.empty()) out += 'C';
  if (normals) out += 'N';
  out += "OFF\n";
  for (const std::string& comment : a.comments) out += "# " + as_line(comment) + "\n";
  append_number(out, mesh.vertex_count());
  out += ' ';
  append_number(out, mesh.face_count());
  out += " 0\n";
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    append_number(out, mesh.positions[v].x());
    append_numbers(out, mesh.positions[v].tail<2>());
    if (normals) append_numbers(out, (*normals)[v]);
    vertex_colors.append(out, v);
    if (uvs) append_numbers(out, (*uvs)[v]);
    out += '\n';
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    append_number(out, mesh.face(f).size());
    for (const Index v : mesh.face(f)) {
      out += ' ';
      append_number(out, std::size_t{v});
    }
    face_colors.append(out, f);
    out += '\n';
  }

  constexpr MeshFormat kFormat = MeshFormat::off;
  if (!uvs) report_loss(report, kFormat, "texture coordinates", a.uvs.size());
  if (!normals)
    report_loss(report, kFormat, "normals that differ around a vertex", a.normals.size());
  report_materials(report, kFormat, a);
  report_loss(report, kFormat, "groups", a.groups.size());
  report_extras(report, kFormat, a);
  report_uneditable(report, kFormat, a);
  return out;
}

}  // namespace lapwing
