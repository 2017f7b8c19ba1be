#include <algorithm>
#include <unordered_map>

#include "lapwing/base/cancellation.h"
#include "lapwing/io/obj_colors.h"
#include "lapwing/io/reading.h"
#include "lapwing/io/source_file.h"
#include "lapwing/io/text_scanner.h"
#include "lapwing/io/writing.h"

namespace lapwing {

namespace {

// Assigns the names in `g`, `o` and `usemtl` statements to the faces that follow each statement.
// Omits names that no face has.
class FaceLabels {
 public:
  FaceLabels(std::vector<std::string>& names, std::vector<Index>& of_face)
      : names_(names), of_face_(of_face) {}

  /// An empty name ends the label.
  void begin(std::string_view name, std::size_t face) {
    spread(face);
    current_ = name;
  }
  void finish(std::size_t face_count) {
    spread(face_count);
    if (names_.empty()) of_face_.clear();
  }

 private:
  void spread(std::size_t face) {
    if (face == of_face_.size()) return;
    Index number = kNoIndex;
    if (!current_.empty()) {
      const auto [entry, added] = numbers_.try_emplace(current_, static_cast<Index>(names_.size()));
      if (added) names_.push_back(current_);
      number = entry->second;
    }
    of_face_.resize(face, number);
  }

  std::vector<std::string>& names_;
  std::vector<Index>& of_face_;
  std::unordered_map<std::string, Index> numbers_;
  std::string current_;
};

class ObjReader {
 public:
  explicit ObjReader(SourceFile& file) : file_(file), scan_(scan_text(file, '#')) {}

  Mesh read() {
    CancelCheck cancel_check;
    while (!scan_.at_end()) {
      cancel_check();
      read_statement();
      scan_.next_line();
    }
    finish();
    return std::move(mesh_);
  }

 private:
  enum Kind : std::size_t { kVertex, kTexture, kNormal };
  // An index beyond the elements read so far. It is legal if its element follows.
  struct Forward {
    Kind kind;
    std::uint64_t offset;
    Index index;
    std::size_t corner;  ///< number among all corners
    std::size_t face;
  };

  void read_statement() {
    scan_.skip_blanks();
    const std::uint64_t start = scan_.offset();
    if (scan_.peek() == '#') {
      scan_.advance();
      const std::string_view comment = scan_.rest_of_line();
      if (!colors_.add_comment(comment, uneditable_)) attributes_.comments.emplace_back(comment);
      return;
    }
    const std::string_view keyword = scan_.word();
    if (keyword.empty()) return;
    if (keyword == "v") {
      read_vertex();
    } else if (keyword == "f" || keyword == "fo") {
      read_face(start);
    } else if (keyword == "vt") {
      read_texture();
    } else if (keyword == "vn") {
      read_normal();
    } else {
      read_other(keyword);
    }
  }

  void read_vertex() {
    mesh_.positions.push_back(scan_.triple(file_.positions, "a coordinate"));
    if (scan_.at_line_end()) return;
    Eigen::Vector4d more = kNoColor;
    Eigen::Index count = 0;
    while (count < more.size() && !scan_.at_line_end()) {
      more[count++] = scan_.number("a weight or colour");
    }
    if (count == 1) {
      uneditable_.add("vertex weights");
    } else if (count >= 3) {
      colors_.add(mesh_.vertex_count() - 1, more);
    }
    if (count == 2 || !scan_.at_line_end()) {
      scan_.fail_expected("x y z, x y z w, x y z r g b or x y z w r g b");
    }
  }

  void read_texture() {
    Eigen::Vector2d uv = Eigen::Vector2d::Zero();
    uv.x() = scan_.number("a texture coordinate");
    if (!scan_.at_line_end()) uv.y() = scan_.number("a texture coordinate");
    if (!scan_.at_line_end() && scan_.number("a texture coordinate") != 0.0) {
      uneditable_.add("third texture coordinates");
    }
    attributes_.uvs.push_back(uv);
    skip_statement();
  }

  void read_normal() {
    attributes_.normals.push_back(scan_.triple(file_.normals, "a coordinate"));
    skip_statement();
  }

  void read_face(std::uint64_t start) {
    std::size_t corners = 0;
    for (; !scan_.at_line_end(); ++corners) read_corner();
    if (corners < 3) face_defects_.report_short(start, mesh_.face_count(), corners);
    close_face(file_, polygons_, start);
  }

  void read_corner() {
    const Index vertex = read_index(kVertex, mesh_.positions.size());
    Index texture = kNoIndex;
    Index normal = kNoIndex;
    if (scan_.peek() == '/') {
      scan_.advance();
      if (has_index()) texture = read_index(kTexture, attributes_.uvs.size());
      if (scan_.peek() == '/') {
        scan_.advance();
        if (has_index()) normal = read_index(kNormal, attributes_.normals.size());
      }
    }
    scan_.end_word("a corner such as 7, 7/2, 7//3 or 7/2/3");
    set_corner(attributes_.corner_uvs, texture);
    set_corner(attributes_.corner_normals, normal);
    polygons_.vertices.push_back(vertex);
  }

  bool has_index() const {
    return scan_.peek() == '-' || scan_.peek() == '+' ||
           (scan_.peek() >= '0' && scan_.peek() <= '9');
  }

  // A list stays empty until a corner has an entry.
  void set_corner(std::vector<Index>& list, Index value) {
    if (value == kNoIndex && list.empty()) return;
    list.resize(mesh_.face_vertices().size(), kNoIndex);
    list.push_back(value);
  }

  Index read_index(Kind kind, std::size_t known) {
    scan_.skip_blanks();
    const std::uint64_t offset = scan_.offset();
    const std::int64_t number = scan_.integer("a corner such as 7, 7/2, 7//3 or 7/2/3");
    const std::int64_t index = number > 0 ? number - 1 : static_cast<std::int64_t>(known) + number;
    if (number == 0 || index < 0 || index >= std::int64_t{kNoIndex}) {
      leave_out(kind, offset, number, known, mesh_.face_count());
      return kNoIndex;
    }
    if (index >= static_cast<std::int64_t>(known)) {
      forward_.push_back(
          {kind, offset, static_cast<Index>(index), polygons_.vertices.size(), mesh_.face_count()});
    }
    return static_cast<Index>(index);
  }

  // A shape needs its vertices, but not its texture coordinates and normals.
  void leave_out(Kind kind, std::uint64_t offset, std::int64_t number, std::size_t known,
                 std::size_t face) {
    if (kind == kTexture) return uneditable_.add("references to missing texture coordinates");
    if (kind == kNormal) return uneditable_.add("references to missing normals");
    face_defects_.report(FileDefectKind::missing_vertex, offset, face,
                         "the face names vertex " + std::to_string(number) + ", but the file has " +
                             std::to_string(known) + " (numbered from 1)");
  }

  void read_other(std::string_view keyword) {
    if (keyword == "g") {
      group_ = scan_.rest_of_line();
      begin_group();
    } else if (keyword == "o") {
      object_ = scan_.rest_of_line();
      group_.clear();
      begin_group();
    } else if (keyword == "usemtl") {
      materials_.begin(scan_.rest_of_line(), mesh_.face_count());
    } else if (keyword == "mtllib") {
      const std::string_view library = scan_.rest_of_line();
      if (library.empty()) {
        uneditable_.add("mtllib statements without a file name");
      } else {
        attributes_.material_libraries.emplace_back(library);
      }
    } else {
      read_uneditable(keyword);
    }
  }

  // If the group and its object have different names, the combined name is "object/group".
  void begin_group() {
    std::string name = object_;
    if (!group_.empty() && group_ != object_) {
      name = object_.empty() ? group_ : object_ + "/" + group_;
      has_plain_groups_ = true;
    }
    groups_.begin(name, mesh_.face_count());
  }

  void read_uneditable(std::string_view keyword) {
    if (keyword == "s") {
      uneditable_.add("smoothing groups");
    } else if (keyword == "l") {
      uneditable_.add("line elements");
    } else if (keyword == "p") {
      uneditable_.add("point elements");
    } else {
      uneditable_.add("other statements");
      if (first_unknown_ == 0) first_unknown_ = scan_.offset();
    }
    skip_statement();
  }

  void skip_statement() {
    while (!scan_.at_line_end()) scan_.word();
  }

  void resolve_forward() {
    const std::array<std::size_t, 3> known{mesh_.positions.size(), attributes_.uvs.size(),
                                           attributes_.normals.size()};
    for (const Forward& reference : forward_) {
      if (reference.index < known[reference.kind]) continue;
      leave_out(reference.kind, reference.offset, std::int64_t{reference.index} + 1,
                known[reference.kind], reference.face);
      if (reference.kind == kVertex) continue;
      auto& corners =
          reference.kind == kTexture ? attributes_.corner_uvs : attributes_.corner_normals;
      corners[reference.corner] = kNoIndex;
    }
  }

  // Clears a list without entries; fills up any other.
  static void finish_corners(std::vector<Index>& list, std::size_t corners) {
    const bool has_none =
        std::all_of(list.begin(), list.end(), [](Index i) { return i == kNoIndex; });
    if (has_none) return list.clear();
    list.resize(corners, kNoIndex);
  }

  void finish() {
    if (mesh_.positions.empty() && mesh_.face_count() == 0 && first_unknown_ != 0) {
      file_.fail_at_line(first_unknown_, "expected an OBJ statement such as 'v' or 'f'");
    }
    resolve_forward();
    const std::size_t corners = mesh_.face_vertices().size();
    finish_corners(attributes_.corner_uvs, corners);
    finish_corners(attributes_.corner_normals, corners);
    groups_.finish(mesh_.face_count());
    attributes_.groups_are_objects = !attributes_.groups.empty() && !has_plain_groups_;
    materials_.finish(mesh_.face_count());
    attributes_.vertex_colors = colors_.finish(mesh_.vertex_count(), uneditable_);
    attributes_.uneditable = uneditable_.lines();
    face_defects_.drop_faces(mesh_);
  }

  SourceFile& file_;
  TextScanner scan_;
  Mesh mesh_;
  Faces& polygons_ = mesh_.edit_faces();
  MeshAttributes& attributes_ = mesh_.edit_attributes();
  FaceLabels groups_{attributes_.groups, attributes_.face_groups};
  std::string object_;
  std::string group_;
  bool has_plain_groups_ = false;
  FaceLabels materials_{attributes_.materials, attributes_.face_materials};
  ObjColors colors_;
  std::vector<Forward> forward_;
  FaceDefects face_defects_{file_};
  Tally uneditable_;
  std::uint64_t first_unknown_ = 0;
};

}  // namespace

Mesh read_obj(SourceFile& file) {
  return ObjReader(file).read();
}

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
    append_label(out, a.groups_are_objects ? "o" : "g", a.groups, a.face_groups, f);
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

  report_uneditable(report, MeshFormat::obj, a);
  if (has_alpha(a.vertex_colors)) {
    report_loss(report, MeshFormat::obj, "opacities of vertex colours", a.vertex_colors.size());
  }
  report_loss(report, MeshFormat::obj, "face colours", a.face_colors.size());
  report_extras(report, MeshFormat::obj, a);
  return out;
}

namespace {

// Returns the part of a corner such as "7/2/-3" behind its second slash; empty without one.
std::string_view normal_part(std::string_view corner) {
  const std::size_t first = corner.find('/');
  if (first == std::string_view::npos) return {};
  const std::size_t second = corner.find('/', first + 1);
  return second == std::string_view::npos ? std::string_view{} : corner.substr(second + 1);
}

std::string normal_lines(const StoredNormals& updated, std::size_t first, std::string_view ending) {
  std::string lines;
  for (std::size_t n = first; n < updated.normals.size(); ++n) {
    lines += "vn";
    append_numbers(lines, updated.normals[n]);
    lines += ending;
  }
  return lines;
}

}  // namespace

void add_obj_normals(const Mesh& mesh, const StoredNormals& updated, const SourceFile& source,
                     FilePatch& patch) {
  const std::string_view bytes = source.bytes();
  const std::string_view ending = bytes.find("\r\n") == std::string_view::npos ? "\n" : "\r\n";
  const std::size_t own = source.normals.count;
  TextScanner behind(source, '#', source.normals.offset(own - 1, 2));
  behind.next_line();
  const std::uint64_t insertion = behind.offset();
  std::string lines = normal_lines(updated, own, ending);
  if (bytes[insertion - 1] != '\n' && bytes[insertion - 1] != '\r') {
    lines.insert(0, ending);
  }
  patch.set_text(insertion, 0, std::move(lines));

  std::size_t corner = 0;
  for (TextScanner scan = scan_text(source, '#'); !scan.at_end(); scan.next_line()) {
    const std::string_view keyword = scan.word();
    if (keyword == "g" || keyword == "o" || keyword == "usemtl" || keyword == "mtllib") continue;
    if (keyword != "f" && keyword != "fo") {
      while (!scan.at_line_end()) scan.word();  // includes continued lines
      continue;
    }
    for (; !scan.at_line_end(); ++corner) {
      const std::string_view number = normal_part(scan.word());
      if (number.empty()) continue;
      const Index now = updated.corner_normals[corner];
      const auto offset = static_cast<std::uint64_t>(number.data() - bytes.data());
      // A relative index behind the inserted lines would count them as well.
      const bool shifted = number.front() == '-' && offset > insertion;
      if (now == mesh.attributes().corner_normals[corner] && !shifted) continue;
      patch.set_text(offset, number.size(), std::to_string(std::size_t{now} + 1));
    }
  }
}

}  // namespace lapwing
