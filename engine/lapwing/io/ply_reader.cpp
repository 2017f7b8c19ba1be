#include <algorithm>
#include <array>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/ply_elements.h"
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
    strips_ = find_element("tristrips");
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
      } else if (&element == strips_) {
        read_strips();
      } else {
        skip(element);
      }
      if (is_cut_) break;
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
    const std::size_t polygon = find_vertex_list(element, "list uchar int vertex_indices");
    const std::size_t wedges = find_list(element, {"texcoord"});
    polygons_.starts.reserve(element.count + 1);
    polygons_.vertices.reserve(3 * element.count);
    std::vector<double> coordinates;
    CancelCheck cancel_check;
    for (std::size_t f = 0; f < element.promised; ++f) {
      cancel_check();
      if (ends_within_face(f, element.properties[polygon])) break;
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
    if (!colors.empty()) colors.resize(mesh_.face_count());
    for (ExtraAttribute& extra : attributes_.face_extras) extra.values.resize(mesh_.face_count());
    attributes_.face_colors = unit_colors(colors);
    count_lists(element);
  }

  // Returns whether the file ends before or within face `f`, for example after an interrupted
  // download. Most calls compare only offsets. The function reads the record only near the end of a
  // text file, or if the rest of a binary file is too short for the promised triangles.
  bool ends_within_face(std::size_t f, const PlyProperty& corners) {
    const PlyElement& element = *faces_;
    const bool is_text = file_.encoding == Encoding::ascii;
    cursor_.begin_record();
    const std::uint64_t room = file_.bytes().size() - cursor_.offset();
    const std::uint64_t triangle = element.binary_size() + 3 * size_of(corners.type);
    if (is_text ? cursor_.offset() < last_line_ : element.promised - f <= room / triangle) {
      return false;
    }
    Cursor trial = cursor_;
    try {
      skip_record(trial, element);
      // If the last line has no line end, its last number may be incomplete.
      is_cut_ = is_text && trial.offset() == file_.bytes().size() && f + 1 < element.promised;
    } catch (const InputError&) {
      is_cut_ = !is_text || trial.at_end();
    }
    if (is_cut_) {
      file_.report_defect(FileDefectKind::wrong_count,
                          is_text ? element.header_offset : cursor_.offset(),
                          "the header promises " + std::to_string(element.promised) +
                              " faces, but the file ends after " + std::to_string(f));
    }
    return is_cut_;
  }

  static void skip_record(Cursor& cursor, const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      const std::int64_t numbers = property.count_type ? cursor.integer(*property.count_type) : 1;
      for (std::int64_t i = 0; i < numbers; ++i) cursor.number(property.type);
    }
    cursor.end_record();
  }

  void read_polygon(const PlyProperty& property) {
    const std::int64_t corners = read_length(property);
    const std::uint64_t start = cursor_.place();
    if (corners < 3) {
      face_defects_.report_short(start, mesh_.face_count(), static_cast<std::size_t>(corners));
    }
    for (std::int64_t c = 0; c < corners; ++c) {
      const std::int64_t vertex = cursor_.integer(property.type);
      if (!is_vertex(vertex)) {
        face_defects_.report_vertex(cursor_.place(), mesh_.face_count(), vertex, vertices_->count);
      }
      polygons_.vertices.push_back(static_cast<Index>(vertex));
    }
    close_face(file_, polygons_, start);
  }

  void read_strips() {
    const PlyElement& element = *strips_;
    const std::size_t strip = find_vertex_list(element, "list int int vertex_indices");
    CancelCheck cancel_check;
    for (std::uint64_t r = 0; r < element.count; ++r) {
      cancel_check();
      cursor_.begin_record();
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        if (p == strip) {
          read_strip(element.properties[p]);
        } else {
          skip_property(element.properties[p]);
        }
      }
      cursor_.end_record();
    }
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      if (p == strip) continue;
      uneditable_.add("'" + element.properties[p].name + "' of triangle strips", element.count);
    }
  }

  // Each vertex of a strip forms a triangle with the two vertices before it. Every second triangle
  // has the opposite orientation. The index -1 starts a new strip. Repeated vertices join two
  // strips.
  void read_strip(const PlyProperty& property) {
    const std::int64_t count = read_length(property);
    std::size_t length = 0;
    Index a = 0;
    Index b = 0;
    for (std::int64_t k = 0; k < count; ++k) {
      const std::int64_t vertex = cursor_.integer(property.type);
      const bool is_end = vertex == -1 || vertex == kNoIndex;  // kNoIndex is an unsigned -1
      if (!is_end && !is_vertex(vertex)) report_vertex_of_strip(vertex);
      if (!is_vertex(vertex)) {
        length = 0;
        continue;
      }
      const auto c = static_cast<Index>(vertex);
      if (length >= 2 && a != b && b != c && c != a) {
        if (length % 2 == 0) strip_triangles_.push_back({a, b, c});
        if (length % 2 == 1) strip_triangles_.push_back({a, c, b});
      }
      a = b;
      b = c;
      ++length;
    }
  }

  void report_vertex_of_strip(std::int64_t vertex) {
    file_.report_defect(FileDefectKind::missing_vertex, cursor_.place(),
                        "a triangle strip names vertex " + std::to_string(vertex) +
                            ", but the file has " + std::to_string(vertices_->count) +
                            " (numbered from 0)");
  }

  // Appends the triangles of the strips. If the file also has faces with attributes, the new
  // triangles get default attributes.
  void add_strip_triangles() {
    if (strip_triangles_.empty()) return;
    for (const std::array<Index, 3>& triangle : strip_triangles_) {
      polygons_.vertices.insert(polygons_.vertices.end(), triangle.begin(), triangle.end());
      close_face(file_, polygons_, strips_->header_offset);
    }
    std::vector<Eigen::Vector4f>& colors = attributes_.face_colors;
    if (!colors.empty()) colors.resize(mesh_.face_count(), Eigen::Vector4f::Ones());
    for (ExtraAttribute& extra : attributes_.face_extras) extra.values.resize(mesh_.face_count());
    if (!wedge_uvs_.empty()) wedge_uvs_.resize(mesh_.face_vertices().size(), kNoIndex);
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
        skip_property(property);
      }
      cursor_.end_record();
    }
  }

  void skip_property(const PlyProperty& property) {
    if (property.count_type) {
      skip_list(property);
    } else {
      cursor_.number(property.type);
    }
  }

  bool is_vertex(std::int64_t number) const {
    return number >= 0 && number < static_cast<std::int64_t>(vertices_->count);
  }

  std::int64_t read_length(const PlyProperty& list) {
    const std::int64_t length = cursor_.integer(list.count_type.value_or(list.type));
    cursor_.check_list(length, list.type);
    return length;
  }

  void skip_list(const PlyProperty& property) { read_list(property, skipped_); }

  void read_list(const PlyProperty& property, std::vector<double>& values) {
    const std::int64_t count = read_length(property);
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

  // Returns the index of the property that lists the vertices of a record. Throws InputError if it
  // is missing or its type is not an integer. The message asks for `expected`.
  std::size_t find_vertex_list(const PlyElement& element, const std::string& expected) const {
    const std::size_t p = find_list(element, {"vertex_indices", "vertex_index"});
    if (p == PlyColumns::kNone || !is_integer(element.properties[p].type)) {
      file_.fail_at_line(element.header_offset,
                         "expected a property '" + expected + "' in '" + element.name + "'");
    }
    return p;
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
    add_strip_triangles();
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
    face_defects_.drop_faces(mesh_);
  }

  SourceFile& file_;
  const PlyHeader& header_;
  Cursor cursor_;
  const PlyElement* vertices_ = nullptr;
  const PlyElement* faces_ = nullptr;
  const PlyElement* strips_ = nullptr;
  Mesh mesh_;
  Faces& polygons_ = mesh_.edit_faces();
  MeshAttributes& attributes_ = mesh_.edit_attributes();
  std::vector<Eigen::Vector2d> wedge_values_;
  std::vector<Index> wedge_uvs_;
  std::vector<std::array<Index, 3>> strip_triangles_;
  std::vector<double> skipped_;
  FaceDefects face_defects_{file_};
  const std::uint64_t last_line_ = start_of_last_line(file_);
  bool is_cut_ = false;
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
