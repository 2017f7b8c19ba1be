#include <algorithm>
#include <cmath>

#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/ply_elements.h"
#include "lapwing/io/writing.h"

namespace lapwing {
namespace {

// Appends the numbers of a record in the file's encoding.
class PlyRecords {
 public:
  PlyRecords(std::string& out, Encoding encoding) : out_(out), encoding_(encoding) {}

  void number(double value, Scalar type) {
    if (encoding_ != Encoding::ascii) {
      append_binary(out_, value, type, encoding_);
      return;
    }
    if (!first_) out_ += ' ';
    first_ = false;
    append_number(out_, value, type);
  }
  void end() {
    if (encoding_ == Encoding::ascii) out_ += '\n';
    first_ = true;
  }

 private:
  std::string& out_;
  Encoding encoding_;
  bool first_ = true;
};

// Numbers of each element, written under consecutive property names.
struct Column {
  std::vector<std::string> names;
  Scalar type = Scalar::float64;
  const double* numbers = nullptr;          // names.size() per element, or
  const Eigen::Vector4f* colors = nullptr;  // the first names.size() components of each
};

class Columns {
 public:
  template <class Vector>
  void add(std::vector<std::string> names, const std::vector<Vector>& values) {
    if (values.empty()) return;
    columns_.push_back(
        {std::move(names), narrowest_type(numbers_of(values)), values.front().data(), nullptr});
  }
  void add_colors(const std::vector<Eigen::Vector4f>& colors) {
    if (colors.empty()) return;
    std::vector<std::string> names{"red", "green", "blue"};
    if (has_alpha(colors)) names.emplace_back("alpha");
    columns_.push_back({std::move(names), fit_bytes(colors) ? Scalar::uint8 : Scalar::float32,
                        nullptr, colors.data()});
  }
  void add_extras(const std::vector<ExtraAttribute>& extras) {
    for (const ExtraAttribute& extra : extras) {
      if (extra.values.empty()) continue;
      columns_.push_back({{extra.name},
                          ply_type(extra.type).value_or(Scalar::float64),
                          extra.values.data(),
                          nullptr});
    }
  }

  void declare(std::string& out) const {
    for (const Column& column : columns_) {
      for (const std::string& name : column.names) {
        out += "property " + std::string(ply_name(column.type)) + " " + name + "\n";
      }
    }
  }
  void append(PlyRecords& records, std::size_t element) const {
    for (const Column& column : columns_) {
      const std::size_t width = column.names.size();
      for (std::size_t k = 0; k < width; ++k) {
        records.number(value(column, element, k), column.type);
      }
    }
  }

 private:
  static double value(const Column& column, std::size_t element, std::size_t k) {
    if (column.colors == nullptr) return column.numbers[element * column.names.size() + k];
    const double part = column.colors[element][static_cast<Eigen::Index>(k)];
    return column.type == Scalar::uint8 ? std::round(255.0 * part) : part;
  }

  std::vector<Column> columns_;
};

std::size_t most_corners(const Mesh& mesh) {
  std::size_t most = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) most = std::max(most, mesh.face(f).size());
  return most;
}

class PlyWriter {
 public:
  PlyWriter(const Mesh& mesh, Encoding encoding)
      : mesh_(mesh),
        encoding_(encoding),
        normals_(per_vertex(mesh, mesh.attributes().normals, mesh.attributes().corner_normals)),
        uvs_(per_vertex(mesh, mesh.attributes().uvs, mesh.attributes().corner_uvs)),
        has_wedges_(!uvs_ && !mesh.attributes().corner_uvs.empty()),
        wedge_type_(narrowest_type(numbers_of(mesh.attributes().uvs))),
        // The same type must also count two texture coordinates per corner.
        count_type_(most_corners(mesh) > 127 ? Scalar::int32 : Scalar::uint8) {
    const MeshAttributes& a = mesh.attributes();
    vertex_columns_.add({"x", "y", "z"}, mesh.positions);
    if (normals_) vertex_columns_.add({"nx", "ny", "nz"}, *normals_);
    if (uvs_) vertex_columns_.add({"s", "t"}, *uvs_);
    vertex_columns_.add_colors(a.vertex_colors);
    vertex_columns_.add_extras(a.vertex_extras);
    face_columns_.add_colors(a.face_colors);
    face_columns_.add_extras(a.face_extras);
  }

  std::string write() {
    std::string out = header();
    PlyRecords records(out, encoding_);
    for (std::size_t v = 0; v < mesh_.vertex_count(); ++v) {
      vertex_columns_.append(records, v);
      records.end();
    }
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) append_face(records, f);
    return out;
  }

  void report_losses(WriteReport& report) const {
    const MeshAttributes& a = mesh_.attributes();
    report_groups(report, MeshFormat::ply, a);
    report_uneditable(report, MeshFormat::ply, a);
    if (!normals_) {
      report_loss(report, MeshFormat::ply, "normals that differ around a vertex", a.normals.size());
    }
  }

 private:
  std::string header() const {
    std::string out = "ply\nformat ";
    out += encoding_ == Encoding::ascii           ? "ascii"
           : encoding_ == Encoding::little_endian ? "binary_little_endian"
                                                  : "binary_big_endian";
    out += " 1.0\n";
    for (const std::string& comment : mesh_.attributes().comments)
      out += "comment " + as_line(comment) + "\n";
    out += "element vertex " + std::to_string(mesh_.vertex_count()) + "\n";
    if (mesh_.vertex_count() == 0) out += "property float x\nproperty float y\nproperty float z\n";
    vertex_columns_.declare(out);
    out += "element face " + std::to_string(mesh_.face_count()) + "\n";
    const std::string list = "property list " + std::string(ply_name(count_type_)) + " ";
    out += list + "int vertex_indices\n";
    if (has_wedges_) out += list + std::string(ply_name(wedge_type_)) + " texcoord\n";
    face_columns_.declare(out);
    return out + "end_header\n";
  }

  void append_face(PlyRecords& records, std::size_t f) const {
    const auto corners = mesh_.face(f);
    records.number(static_cast<double>(corners.size()), count_type_);
    for (const Index v : corners) records.number(v, Scalar::int32);
    if (has_wedges_) append_wedges(records, f);
    face_columns_.append(records, f);
    records.end();
  }

  // Readers expect texture coordinates at all corners of a face, or at none.
  void append_wedges(PlyRecords& records, std::size_t f) const {
    const MeshAttributes& a = mesh_.attributes();
    const auto uvs = std::span(a.corner_uvs).subspan(mesh_.face_starts()[f], mesh_.face(f).size());
    const bool complete = std::find(uvs.begin(), uvs.end(), kNoIndex) == uvs.end();
    records.number(complete ? 2.0 * static_cast<double>(uvs.size()) : 0.0, count_type_);
    if (!complete) return;
    for (const Index uv : uvs) {
      records.number(a.uvs[uv].x(), wedge_type_);
      records.number(a.uvs[uv].y(), wedge_type_);
    }
  }

  const Mesh& mesh_;
  Encoding encoding_;
  std::optional<std::vector<Eigen::Vector3d>> normals_;
  std::optional<std::vector<Eigen::Vector2d>> uvs_;
  bool has_wedges_;
  Scalar wedge_type_;
  Scalar count_type_;
  Columns vertex_columns_;
  Columns face_columns_;
};

}  // namespace

std::string write_ply(const Mesh& mesh, Encoding encoding, WriteReport& report) {
  PlyWriter writer(mesh, encoding);
  writer.report_losses(report);
  return writer.write();
}

}  // namespace lapwing
