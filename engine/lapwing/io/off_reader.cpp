#include <array>
#include <cctype>

#include "lapwing/base/cancellation.h"
#include "lapwing/io/formats.h"
#include "lapwing/io/reading.h"
#include "lapwing/io/text_scanner.h"

namespace lapwing {
namespace {

// The header word [ST][C][N][4][n]OFF says what each vertex line holds.
struct OffHeader {
  bool has_uvs = false;
  bool has_colors = false;
  bool has_normals = false;
};

class OffReader {
 public:
  explicit OffReader(SourceFile& file) : file_(file), scan_(scan_text(file, '#')) {}

  Mesh read() {
    skip_space();
    if (!starts_with_counts()) read_header_word();
    read_counts();
    CancelCheck cancel_check;
    for (std::size_t v = 0; v < vertex_count_; ++v) {
      cancel_check();
      read_vertex();
    }
    for (std::size_t f = 0; f < face_count_; ++f) {
      cancel_check();
      read_face();
    }
    finish();
    return std::move(mesh_);
  }

 private:
  // Like TextScanner::skip_space, but keeps the comments.
  void skip_space() {
    while (scan_.at_line_end() && !scan_.at_end()) {
      if (scan_.peek() == '#') {
        scan_.advance();
        attributes_.comments.emplace_back(scan_.rest_of_line());
      }
      scan_.next_line();
    }
  }

  // The header word may be missing.
  bool starts_with_counts() const {
    TextScanner ahead = scan_;
    const std::string_view word = ahead.word();
    return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
  }

  void read_header_word() {
    // "OFF8 6 0", with no blank before the counts, is common.
    const TextScanner start = scan_;
    std::string letters;
    while (std::isalpha(static_cast<unsigned char>(scan_.peek())) != 0 ||
           (scan_.peek() == '4' && !letters.ends_with("OFF"))) {
      letters += scan_.peek();
      scan_.advance();
    }
    std::string_view rest = letters;
    const auto take = [&rest](std::string_view prefix) {
      const bool found = rest.starts_with(prefix);
      if (found) rest.remove_prefix(prefix.size());
      return found;
    };
    header_.has_uvs = take("ST");
    header_.has_colors = take("C");
    header_.has_normals = take("N");
    if (rest == "4OFF" || rest == "nOFF" || rest == "4nOFF") {
      file_.fail_at_line(start.offset(),
                         "expected OFF with three coordinates per vertex, found '" + letters + "'");
    }
    if (rest != "OFF") start.fail_expected("'OFF', 'COFF', 'NOFF' or 'CNOFF'");
    if (!scan_.at_line_end() && scan_.peek() == 'B') {
      scan_.fail_expected("the counts of an ascii OFF file (binary OFF is not supported)");
    }
  }

  void read_counts() {
    skip_space();
    const std::uint64_t offset = scan_.offset();
    vertex_count_ = read_count("the number of vertices");
    skip_space();
    face_count_ = read_count("the number of faces");
    skip_edge_count();
    // A vertex takes at least 6 bytes ("0 0 0\n") and a face 8 ("3 0 0 0\n"). The last line end may
    // be missing.
    const std::uint64_t room = file_.bytes().size() - scan_.offset() + 1;
    if (vertex_count_ > room / 6 || face_count_ > (room - 6 * vertex_count_) / 8) {
      file_.fail_at_line(offset, "the header promises " + std::to_string(vertex_count_) +
                                     " vertices and " + std::to_string(face_count_) +
                                     " faces, more than the file has room for");
    }
    mesh_.positions.reserve(vertex_count_);
    polygons_.starts.reserve(face_count_ + 1);
    polygons_.vertices.reserve(3 * face_count_);
    file_.positions.offsets.reserve(3 * vertex_count_);
  }

  // The edge count is not used. It is often missing, and may be on the next line.
  void skip_edge_count() {
    TextScanner ahead = scan_;
    const bool on_this_line = !ahead.at_line_end();
    ahead.skip_space();
    ahead.word();
    if (on_this_line || ahead.at_line_end()) scan_ = ahead;
    scan_.next_line();
  }

  std::uint64_t read_count(std::string_view what) {
    const TextScanner start = scan_;
    const std::int64_t count = scan_.integer(what);
    scan_.end_word(what);
    if (count < 0) start.fail_expected(what);
    return static_cast<std::uint64_t>(count);
  }

  void read_vertex() {
    skip_space();
    mesh_.positions.push_back(read_triple(file_.positions, "a coordinate of a vertex"));
    if (header_.has_normals) {
      attributes_.normals.push_back(read_triple(file_.normals, "a coordinate of a normal"));
    }
    const TextScanner behind = scan_;
    std::array<double, 6> more{};
    std::size_t count = 0;
    for (; !scan_.at_line_end(); ++count) {
      const double value = scan_.number("a number of a vertex");
      if (count < more.size()) more[count] = value;
    }
    if (header_.has_uvs) {
      if (count < 2 || count > more.size()) {
        behind.fail_expected("two texture coordinates at the end of the vertex");
      }
      attributes_.uvs.emplace_back(more[count - 2], more[count - 1]);
      count -= 2;
    }
    if (header_.has_colors) {
      if (count != 3 && count != 4) behind.fail_expected("a colour of 3 or 4 numbers");
      vertex_colors_.emplace_back(more[0], more[1], more[2], count == 4 ? more[3] : kNoColor[3]);
    } else if (count > 0) {
      uneditable_.add("vertices with numbers that the header does not declare");
    }
  }

  Eigen::Vector3d read_triple(NumberTriples& places, std::string_view what) {
    std::array<std::uint64_t, 3> offsets{};
    Eigen::Vector3d value;
    for (std::size_t k = 0; k < 3; ++k) {
      scan_.skip_blanks();
      offsets[k] = scan_.offset();
      value[static_cast<Eigen::Index>(k)] = scan_.number(what);
    }
    places.add(offsets[0], offsets[1], offsets[2]);
    return value;
  }

  void read_face() {
    skip_space();
    const std::uint64_t start = scan_.offset();
    const std::int64_t corners = scan_.integer("the number of corners of a face");
    scan_.end_word("the number of corners of a face");
    if (corners < 3) {
      file_.fail_at_line(
          start, "a face needs at least 3 corners, but this one has " + std::to_string(corners));
    }
    for (std::int64_t c = 0; c < corners; ++c) {
      scan_.skip_blanks();
      const std::uint64_t offset = scan_.offset();
      const std::int64_t vertex = scan_.integer("a vertex number of a face");
      scan_.end_word("a vertex number of a face");
      if (vertex < 0 || vertex >= static_cast<std::int64_t>(vertex_count_)) {
        fail_vertex(file_, offset, mesh_.face_count(), vertex, vertex_count_);
      }
      polygons_.vertices.push_back(static_cast<Index>(vertex));
    }
    close_face(file_, polygons_, start);
    read_face_color();
  }

  // A face has no colour, an index into a colour map outside the file, or 3 or 4 numbers.
  void read_face_color() {
    if (scan_.at_line_end()) return;
    const TextScanner start = scan_;
    Eigen::Vector4d color = kNoColor;
    Eigen::Index count = 0;
    while (count < 4 && !scan_.at_line_end()) color[count++] = scan_.number("a colour of a face");
    if (count == 2 || !scan_.at_line_end()) {
      start.fail_expected("no colour, 1, 3 or 4 numbers at the end of a face");
    }
    if (count == 1) {
      uneditable_.add("colour map indices");
      return;
    }
    face_colors_.resize(mesh_.face_count() - 1, kNoColor);
    face_colors_.push_back(color);
  }

  void finish() {
    skip_space();
    if (!scan_.at_end()) uneditable_.add("lines after the last face");
    if (!face_colors_.empty()) face_colors_.resize(face_count_, kNoColor);
    attributes_.has_vertex_normals = header_.has_normals && vertex_count_ > 0;
    if (header_.has_uvs) attributes_.corner_uvs = mesh_.face_vertices();
    attributes_.vertex_colors = unit_colors(vertex_colors_);
    attributes_.face_colors = unit_colors(face_colors_);
    attributes_.uneditable = uneditable_.lines();
  }

  SourceFile& file_;
  TextScanner scan_;
  OffHeader header_;
  std::uint64_t vertex_count_ = 0;
  std::uint64_t face_count_ = 0;
  Mesh mesh_;
  Faces& polygons_ = mesh_.edit_faces();
  MeshAttributes& attributes_ = mesh_.edit_attributes();
  std::vector<Eigen::Vector4d> vertex_colors_;
  std::vector<Eigen::Vector4d> face_colors_;
  Tally uneditable_;
};

}  // namespace

Mesh read_off(SourceFile& file) {
  return OffReader(file).read();
}

}  // namespace lapwing
