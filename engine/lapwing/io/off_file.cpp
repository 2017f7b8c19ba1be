#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "lapwing/base/cancellation.h"
#include "lapwing/io/reading.h"
#include "lapwing/io/text_scanner.h"
#include "lapwing/io/writing.h"

namespace lapwing {

namespace {

// The header word [ST][C][N][4][n]OFF says what each vertex line holds. Other orders of the
// prefixes are read too, because MeshLab writes NCSTOFF.
struct OffHeader {
  bool has_uvs = false;
  bool has_colors = false;
  bool has_normals = false;
  bool has_colors_first = false;  ///< in vertex lines, colours of 4 numbers precede normals
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
    while (mesh_.face_count() < face_count_) {
      cancel_check();
      if (ends_within_face()) break;
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
    const auto take = [&rest](std::string_view prefix, bool& has) {
      if (has || !rest.starts_with(prefix)) return false;
      rest.remove_prefix(prefix.size());
      return has = true;
    };
    while (take("ST", header_.has_uvs) || take("C", header_.has_colors) ||
           take("N", header_.has_normals)) {
    }
    header_.has_colors_first =
        header_.has_colors && header_.has_normals && letters.find('N') < letters.find('C');
    if (rest == "4OFF" || rest == "nOFF" || rest == "4nOFF") {
      file_.fail_at_line(start.offset(),
                         "expected OFF with three coordinates per vertex, found '" + letters + "'");
    }
    if (rest != "OFF")
      start.fail_expected("'OFF', or a form of it such as 'COFF', 'NOFF' or 'STOFF'");
    if (!scan_.at_line_end() && scan_.peek() == 'B') {
      scan_.fail_expected("the counts of an ascii OFF file (binary OFF is not supported)");
    }
  }

  void read_counts() {
    skip_space();
    counts_offset_ = scan_.offset();
    vertex_count_ = read_count("the number of vertices");
    skip_space();
    face_count_ = read_count("the number of faces");
    skip_edge_count();
    // A vertex takes at least 6 bytes ("0 0 0\n") and a triangle at least 8 ("3 0 0 0\n"). The file
    // may lack the last line end, so one byte is added.
    const std::uint64_t room = file_.bytes().size() - scan_.offset() + 1;
    if (vertex_count_ > room / 6) {
      file_.fail_at_line(counts_offset_, "the header promises " + std::to_string(vertex_count_) +
                                             " vertices, more than the file has room for");
    }
    const std::uint64_t faces = std::min(face_count_, (room - 6 * vertex_count_) / 8);
    mesh_.positions.reserve(vertex_count_);
    polygons_.starts.reserve(faces + 1);
    polygons_.vertices.reserve(3 * faces);
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
    mesh_.positions.push_back(scan_.triple(file_.positions, "a coordinate of a vertex"));
    if (header_.has_colors_first && mesh_.vertex_count() == 1) {
      header_.has_colors_first = is_color_first();
    }
    std::array<double, 6> more{};
    std::size_t count = 0;
    while (header_.has_colors_first && count < 4) {
      more[count++] = scan_.number("a colour of a vertex");
    }
    if (header_.has_normals) {
      attributes_.normals.push_back(scan_.triple(file_.normals, "a coordinate of a normal"));
    }
    const TextScanner behind = scan_;
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
      const bool may_be_color = count == 3 || count == 4;
      undeclared_.push_back(kNoColor);
      for (Eigen::Index k = 0; may_be_color && k < static_cast<Eigen::Index>(count); ++k) {
        undeclared_.back()[k] = more[static_cast<std::size_t>(k)];
      }
    }
  }

  static bool is_unit_vector(const Eigen::Vector3d& vector) {
    constexpr double kDigitsOfText = 1e-3;
    return std::abs(vector.norm() - 1.0) < kDigitsOfText;
  }

  // Returns whether a colour of 4 numbers precedes the normal of this vertex. MeshLab writes the
  // prefix N before C but the normal after the colour. Other programs keep the specified order.
  bool is_color_first() const {
    TextScanner ahead = scan_;
    std::array<double, 7> numbers{};
    for (double& number : numbers) {
      if (ahead.at_line_end()) return false;
      number = ahead.number("a number of a vertex");
    }
    return is_unit_vector({numbers[4], numbers[5], numbers[6]}) &&
           !is_unit_vector({numbers[0], numbers[1], numbers[2]});
  }

  // Returns whether the file ends before or within the next face. An interrupted download can cause
  // this.
  bool ends_within_face() {
    skip_space();
    if (scan_.offset() < last_line_) return false;
    TextScanner words = scan_;
    double corners = 0.0;
    double numbers = 0.0;
    for (; !words.at_line_end(); ++numbers) {
      const std::string_view word = words.word();
      if (numbers == 0.0) parse_number(word.data(), word.data() + word.size(), corners);
    }
    // If the last line has no line end, its last number may be incomplete.
    const bool is_whole = !words.at_end() || mesh_.face_count() + 1 == face_count_;
    if (numbers > 0.0 && numbers >= corners + 1.0 && is_whole) return false;
    file_.report_defect(FileDefectKind::wrong_count, counts_offset_,
                        "the header promises " + std::to_string(face_count_) +
                            " faces, but the file ends after " +
                            std::to_string(mesh_.face_count()));
    return true;
  }

  // Many files contain vertex colours that their header does not declare. Three undeclared numbers
  // may also be a normal.
  bool are_undeclared_colors() const {
    const auto is_color = [](const Eigen::Vector4d& color) {
      return color.head<3>().minCoeff() >= 0.0 && color.head<3>().maxCoeff() <= 255.0;
    };
    const auto is_normal = [](const Eigen::Vector4d& color) {
      return std::isnan(color[3]) && is_unit_vector(color.head<3>());
    };
    return undeclared_.size() == vertex_count_ && std::ranges::all_of(undeclared_, is_color) &&
           !std::ranges::all_of(undeclared_, is_normal);
  }

  void read_face() {
    const std::uint64_t start = scan_.offset();
    const TextScanner count = scan_;
    const std::int64_t corners = scan_.integer("the number of corners of a face");
    scan_.end_word("the number of corners of a face");
    if (corners < 0) count.fail_expected("the number of corners of a face");
    if (corners < 3) {
      face_defects_.report_short(start, mesh_.face_count(), static_cast<std::size_t>(corners));
    }
    for (std::int64_t c = 0; c < corners; ++c) {
      scan_.skip_blanks();
      const std::uint64_t offset = scan_.offset();
      const std::int64_t vertex = scan_.integer("a vertex number of a face");
      scan_.end_word("a vertex number of a face");
      if (vertex < 0 || vertex >= static_cast<std::int64_t>(vertex_count_)) {
        face_defects_.report_vertex(offset, mesh_.face_count(), vertex, vertex_count_);
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
      uneditable_.add(kColorMapIndices);
      return;
    }
    face_colors_.resize(mesh_.face_count() - 1, kNoColor);
    face_colors_.push_back(color);
  }

  void finish() {
    skip_space();
    if (!scan_.at_end()) uneditable_.add("lines after the last face");
    if (!face_colors_.empty()) face_colors_.resize(mesh_.face_count(), kNoColor);
    if (!undeclared_.empty() && are_undeclared_colors()) {
      vertex_colors_ = std::move(undeclared_);
    } else if (!undeclared_.empty()) {
      uneditable_.add(kUndeclaredNumbers, undeclared_.size());
    }
    attributes_.has_vertex_normals = header_.has_normals && vertex_count_ > 0;
    if (header_.has_uvs) attributes_.corner_uvs = mesh_.face_vertices();
    attributes_.vertex_colors = unit_colors(vertex_colors_);
    attributes_.face_colors = unit_colors(face_colors_);
    attributes_.uneditable = uneditable_.lines();
    face_defects_.drop_faces(mesh_);
  }

  SourceFile& file_;
  TextScanner scan_;
  OffHeader header_;
  std::uint64_t counts_offset_ = 0;
  const std::uint64_t last_line_ = start_of_last_line(file_);
  std::uint64_t vertex_count_ = 0;
  std::uint64_t face_count_ = 0;
  Mesh mesh_;
  Faces& polygons_ = mesh_.edit_faces();
  MeshAttributes& attributes_ = mesh_.edit_attributes();
  std::vector<Eigen::Vector4d> vertex_colors_;
  std::vector<Eigen::Vector4d> face_colors_;
  std::vector<Eigen::Vector4d> undeclared_;  ///< numbers after positions; see kUndeclaredNumbers
  FaceDefects face_defects_{file_};
  Tally uneditable_;
};

}  // namespace

Mesh read_off(SourceFile& file) {
  return OffReader(file).read();
}

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
  report_materials(report, kFormat, a);
  report_groups(report, kFormat, a);
  report_uneditable(report, kFormat, a);
  if (!uvs) report_loss(report, kFormat, "texture coordinates", a.uvs.size());
  if (!normals)
    report_loss(report, kFormat, "normals that differ around a vertex", a.normals.size());
  report_extras(report, kFormat, a);
  return out;
}

}  // namespace lapwing
