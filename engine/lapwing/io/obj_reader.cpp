#include <algorithm>
#include <unordered_map>

#include "lapwing/base/cancellation.h"
#include "lapwing/io/formats.h"
#include "lapwing/io/reading.h"
#include "lapwing/io/text_scanner.h"

namespace lapwing {
namespace {

// Assigns the labels of `g` and `usemtl` statements, which apply to the faces that follow.
class FaceLabels {
 public:
  FaceLabels(std::vector<std::string>& names, std::vector<Index>& of_face)
      : names_(names), of_face_(of_face) {}

  /// An empty name ends the label.
  void begin(std::string_view name, std::size_t face) {
    spread(face);
    current_ = kNoIndex;
    if (name.empty()) return;
    const auto [entry, added] =
        numbers_.try_emplace(std::string(name), static_cast<Index>(names_.size()));
    if (added) names_.emplace_back(name);
    current_ = entry->second;
  }
  void finish(std::size_t face_count) { spread(names_.empty() ? 0 : face_count); }

 private:
  void spread(std::size_t face) { of_face_.resize(face, current_); }

  std::vector<std::string>& names_;
  std::vector<Index>& of_face_;
  std::unordered_map<std::string, Index> numbers_;
  Index current_ = kNoIndex;
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
  };

  void read_statement() {
    scan_.skip_blanks();
    const std::uint64_t start = scan_.offset();
    if (scan_.peek() == '#') {
      scan_.advance();
      attributes_.comments.emplace_back(scan_.rest_of_line());
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
    Eigen::Vector3d p;
    read_triple(file_.positions, p);
    mesh_.positions.push_back(p);
    if (scan_.at_line_end()) return;
    Eigen::Vector4d more = kNoColor;
    Eigen::Index count = 0;
    while (count < more.size() && !scan_.at_line_end()) {
      more[count++] = scan_.number("a weight or colour");
    }
    if (count == 1) {
      uneditable_.add("vertex weights");
    } else if (count >= 3) {
      colors_.resize(mesh_.vertex_count() - 1, kNoColor);
      colors_.push_back(more);
    }
    if (count == 2 || !scan_.at_line_end()) {
      scan_.fail_expected("x y z, x y z w or x y z r g b");
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
    Eigen::Vector3d n;
    read_triple(file_.normals, n);
    attributes_.normals.push_back(n);
    skip_statement();
  }

  void read_triple(NumberTriples& places, Eigen::Vector3d& value) {
    std::array<std::uint64_t, 3> offsets{};
    for (std::size_t k = 0; k < 3; ++k) {
      scan_.skip_blanks();
      offsets[k] = scan_.offset();
      value[static_cast<Eigen::Index>(k)] = scan_.number("a coordinate");
    }
    places.add(offsets[0], offsets[1], offsets[2]);
  }

  void read_face(std::uint64_t start) {
    std::size_t corners = 0;
    for (; !scan_.at_line_end(); ++corners) read_corner();
    if (corners < 3) {
      file_.fail_at_line(
          start, "a face needs at least 3 corners, but this one has " + std::to_string(corners));
    }
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
      leave_out(kind, offset, number, known);
      return kNoIndex;
    }
    if (index >= static_cast<std::int64_t>(known)) {
      forward_.push_back({kind, offset, static_cast<Index>(index), polygons_.vertices.size()});
    }
    return static_cast<Index>(index);
  }

  // A shape needs its vertices, but not its texture coordinates and normals.
  void leave_out(Kind kind, std::uint64_t offset, std::int64_t number, std::size_t known) {
    if (kind == kTexture) return uneditable_.add("references to missing texture coordinates");
    if (kind == kNormal) return uneditable_.add("references to missing normals");
    file_.fail_at_line(offset, "the face names vertex " + std::to_string(number) +
                                   ", but the file has " + std::to_string(known) +
                                   " (numbered from 1)");
  }

  void read_other(std::string_view keyword) {
    if (keyword == "g") {
      groups_.begin(scan_.rest_of_line(), mesh_.face_count());
    } else if (keyword == "usemtl") {
      materials_.begin(scan_.rest_of_line(), mesh_.face_count());
    } else if (keyword == "mtllib") {
      attributes_.material_libraries.emplace_back(scan_.rest_of_line());
    } else {
      read_uneditable(keyword);
    }
  }

  void read_uneditable(std::string_view keyword) {
    if (keyword == "o") {
      uneditable_.add("object names");
    } else if (keyword == "s") {
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
                known[reference.kind]);
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
    materials_.finish(mesh_.face_count());
    if (!colors_.empty()) colors_.resize(mesh_.vertex_count(), kNoColor);
    attributes_.vertex_colors = unit_colors(colors_);
    attributes_.uneditable = uneditable_.lines();
  }

  SourceFile& file_;
  TextScanner scan_;
  Mesh mesh_;
  Faces& polygons_ = mesh_.edit_faces();
  MeshAttributes& attributes_ = mesh_.edit_attributes();
  FaceLabels groups_{attributes_.groups, attributes_.face_groups};
  FaceLabels materials_{attributes_.materials, attributes_.face_materials};
  std::vector<Eigen::Vector4d> colors_;
  std::vector<Forward> forward_;
  Tally uneditable_;
  std::uint64_t first_unknown_ = 0;
};

}  // namespace

Mesh read_obj(SourceFile& file) {
  return ObjReader(file).read();
}

}  // namespace lapwing
