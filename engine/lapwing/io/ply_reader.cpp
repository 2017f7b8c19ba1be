#include <algorithm>

#include "lapwing/base/cancellation.h"
#include "lapwing/io/formats.h"
#include "lapwing/io/ply_columns.h"
#include "lapwing/io/ply_cursor.h"
#include "lapwing/io/reading.h"

namespace lapwing {
namespace {

template <class Cursor>
class PlyReader {
 public:
  PlyReader(SourceFile& file, const PlyHeader& header)
      : file_(file), header_(header), cursor_(file, header) {}

  Mesh read() {
    vertices_ = find_element("vertex");
    faces_ = find_element("face");
    if (vertices_ == nullptr) {
      file_.fail_at_line(header_.data_offset - 1, "expected an element 'vertex' in the header");
    }
    if (vertices_->count >= kNoIndex) {
      file_.fail_at_line(vertices_->header_offset, "a mesh has at most 4,294,967,294 vertices");
    }
    for (const PlyElement& element : header_.elements) {
      if (&element == vertices_) {
        read_vertices();
      } else if (&element == faces_) {
        read_faces();
      } else {
        skip(element);
      }
    }
    finish();
    return std::move(mesh_);
  }

 private:
  const PlyElement* find_element(std::string_view name) const {
    const auto at = std::find_if(header_.elements.begin(), header_.elements.end(),
                                 [&](const PlyElement& e) { return e.name == name; });
    return at == header_.elements.end() ? nullptr : &*at;
  }

  void read_vertices() {
    const PlyElement& element = *vertices_;
    PlyColumns columns(element);
    if (!columns.take(mesh_.positions, {{"x", "y", "z"}})) {
      file_.fail_at_line(element.header_offset, "expected properties x, y and z in 'vertex'");
    }
    attributes_.has_vertex_normals =
        columns.take(attributes_.normals, {{"nx", "ny", "nz"}}) && element.count > 0;
    columns.take(attributes_.uvs, {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}});
    std::vector<Eigen::Vector4d> colors;
    columns.take_colors(colors);
    columns.take_rest(attributes_.vertex_extras);
    read_vertex_records(columns);
    attributes_.vertex_colors = unit_colors(colors);
  }

  void read_vertex_records(PlyColumns& columns) {
    const PlyElement& element = *vertices_;
    PlyOffsets positions(file_.positions, element, columns.find({"x", "y", "z"}));
    PlyOffsets normals(file_.normals, element, columns.find({"nx", "ny", "nz"}));
    const bool regular = file_.encoding != Encoding::ascii && !element.has_list();
    if (regular) {
      positions.describe(element, cursor_.offset());
      normals.describe(element, cursor_.offset());
    } else {
      file_.positions.offsets.resize(3 * file_.positions.count);
      file_.normals.offsets.resize(3 * file_.normals.count);
    }
    CancelCheck cancel_check;
    for (std::size_t v = 0; v < element.count; ++v) {
      cancel_check();
      cursor_.begin_record();
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        if (element.properties[p].count_type) {
          skip_list(element.properties[p]);
          continue;
        }
        columns.put(p, v, cursor_.number(element.properties[p].type));
        if (regular) continue;
        positions.note(p, v, cursor_.place());
        normals.note(p, v, cursor_.place());
      }
      cursor_.end_record();
    }
    count_lists(element);
  }

  void read_faces() {
    const PlyElement& element = *faces_;
    PlyColumns columns(element);
    std::vector<Eigen::Vector4d> colors;
    columns.take_colors(colors);
    columns.take_rest(attributes_.face_extras);
    const std::size_t polygon = find_list(element, {"vertex_indices", "vertex_index"});
    const std::size_t wedges = find_list(element, {"texcoord"});
    if (polygon == PlyColumns::kNone || !is_integer(element.properties[polygon].type)) {
      file_.fail_at_line(element.header_offset,
                         "expected a property 'list uchar int vertex_indices' in 'face'");
    }
    polygons_.starts.reserve(element.count + 1);
    polygons_.vertices.reserve(3 * element.count);
    std::vector<double> coordinates;
    CancelCheck cancel_check;
    for (std::size_t f = 0; f < element.count; ++f) {
      cancel_check();
      cursor_.begin_record();
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (p == polygon) {
          read_polygon(property);
        } else if (p == wedges) {
          read_list(property, coordinates);
        } else if (property.count_type) {
          skip_list(property);
        } else {
          columns.put(p, f, cursor_.number(property.type));
        }
      }
      if (wedges != PlyColumns::kNone) add_wedges(coordinates);
      cursor_.end_record();
    }
    attributes_.face_colors = unit_colors(colors);
    count_lists(element);
  }

  void read_polygon(const PlyProperty& property) {
    const std::int64_t corners = cursor_.integer(*property.count_type);
    const std::uint64_t start = cursor_.place();
    cursor_.check_list(corners, property.type);
    if (corners < 3) {
      file_.fail(start, "face " + std::to_string(mesh_.face_count()) +
                            " needs at least 3 corners, but has " + std::to_string(corners));
    }
    for (std::int64_t c = 0; c < corners; ++c) {
      const std::int64_t vertex = cursor_.integer(property.type);
      if (vertex < 0 || vertex >= static_cast<std::int64_t>(vertices_->count)) {
        fail_vertex(file_, cursor_.place(), mesh_.face_count(), vertex, vertices_->count);
      }
      polygons_.vertices.push_back(static_cast<Index>(vertex));
    }
    close_face(file_, polygons_, start);
  }

  // Texture coordinates per corner, as MeshLab writes them: u v u v ..., or nothing.
  void add_wedges(const std::vector<double>& coordinates) {
    const std::size_t corners = mesh_.face(mesh_.face_count() - 1).size();
    if (!coordinates.empty() && coordinates.size() != 2 * corners) {
      file_.fail(cursor_.place(), "expected " + std::to_string(2 * corners) +
                                      " texture coordinates for " + std::to_string(corners) +
                                      " corners, found " + std::to_string(coordinates.size()));
    }
    for (std::size_t c = 0; c < corners; ++c) {
      wedge_uvs_.push_back(coordinates.empty() ? kNoIndex
                                               : static_cast<Index>(wedge_values_.size()));
      if (coordinates.empty()) continue;
      wedge_values_.emplace_back(coordinates[2 * c], coordinates[2 * c + 1]);
    }
  }

  void skip(const PlyElement& element) {
    uneditable_.add("'" + element.name + "' elements", element.count);
    if (element.properties.empty()) return;
    for (std::uint64_t r = 0; r < element.count; ++r) {
      cursor_.begin_record();
      for (const PlyProperty& property : element.properties) {
        if (property.count_type) {
          skip_list(property);
        } else {
          cursor_.number(property.type);
        }
      }
      cursor_.end_record();
    }
  }

  void skip_list(const PlyProperty& property) { read_list(property, skipped_); }

  void read_list(const PlyProperty& property, std::vector<double>& values) {
    const std::int64_t count = cursor_.integer(*property.count_type);
    cursor_.check_list(count, property.type);
    values.clear();
    for (std::int64_t i = 0; i < count; ++i) values.push_back(cursor_.number(property.type));
  }

  void count_lists(const PlyElement& element) {
    for (const PlyProperty& p : element.properties) {
      const bool known = &element == faces_ && (p.name == "vertex_indices" ||
                                                p.name == "vertex_index" || p.name == "texcoord");
      if (p.count_type && !known) uneditable_.add("'" + p.name + "' lists", element.count);
    }
  }

  static std::size_t find_list(const PlyElement& element, PlyColumns::Names names) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (!property.count_type) continue;
      if (std::find(names.begin(), names.end(), property.name) != names.end()) return p;
    }
    return PlyColumns::kNone;
  }

  // Texture coordinates per corner are finer and replace those per vertex.
  void finish() {
    if (!cursor_.at_end()) uneditable_.add("data after the last element");
    if (!wedge_values_.empty()) {
      if (!attributes_.uvs.empty()) uneditable_.add("texture coordinates per vertex");
      attributes_.uvs = std::move(wedge_values_);
      attributes_.corner_uvs = std::move(wedge_uvs_);
    } else if (!attributes_.uvs.empty()) {
      attributes_.corner_uvs = mesh_.face_vertices();
    }
    attributes_.comments = header_.comments;
    attributes_.uneditable = uneditable_.lines();
  }

  SourceFile& file_;
  const PlyHeader& header_;
  Cursor cursor_;
  const PlyElement* vertices_ = nullptr;
  const PlyElement* faces_ = nullptr;
  Mesh mesh_;
  Faces& polygons_ = mesh_.edit_faces();
  MeshAttributes& attributes_ = mesh_.edit_attributes();
  std::vector<Eigen::Vector2d> wedge_values_;
  std::vector<Index> wedge_uvs_;
  std::vector<double> skipped_;
  Tally uneditable_;
};

}  // namespace

Mesh read_ply(SourceFile& file) {
  const PlyHeader header = read_ply_header(file);
  file.encoding = header.encoding;
  if (header.encoding == Encoding::ascii) return PlyReader<PlyTextCursor>(file, header).read();
  return PlyReader<PlyBinaryCursor>(file, header).read();
}

}  // namespace lapwing
