#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/reading.h"
#include "lapwing/io/text_scanner.h"
#include "lapwing/io/writing.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/mesh/welder.h"

namespace lapwing {

/// Layout of a binary STL file, in bytes: free text and a count, then per facet a normal, three
/// corners and two bytes of attribute.
inline constexpr std::size_t kStlTextSize = 80;
inline constexpr std::size_t kStlHeaderSize = kStlTextSize + 4;
inline constexpr std::size_t kStlFacetSize = 50;
inline constexpr Encoding kStlOrder = Encoding::little_endian;

namespace {

std::size_t binary_count(std::string_view bytes) {
  return static_cast<std::size_t>(
      load_number(bytes.data() + kStlTextSize, Scalar::uint32, kStlOrder));
}

// Binary headers often begin with "solid" too. The file size decides first, then NUL bytes.
bool is_ascii(const SourceFile& file) {
  const std::string_view bytes = file.bytes();
  if (bytes.size() >= kStlHeaderSize &&
      bytes.size() == kStlHeaderSize + kStlFacetSize * binary_count(bytes)) {
    return false;
  }
  if (bytes.substr(0, 1024).find('\0') != std::string_view::npos) return false;
  TextScanner scan(file, '\0', bytes.starts_with("\xEF\xBB\xBF") ? 3U : 0U);
  scan.skip_space();
  return lowered(scan.word()) == "solid";
}

// Returns the offset of the last "endfacet" or "end facet" in upper or lower case, or 0 if the file
// has none.
std::uint64_t find_last_endfacet(std::string_view bytes) {
  constexpr std::string_view kFacet = "facet";
  constexpr std::string_view kBlanks = " \t";
  for (std::size_t end = bytes.size(); end >= kFacet.size(); --end) {
    if (lowered(bytes.substr(end - kFacet.size(), kFacet.size())) != kFacet) continue;
    std::string_view before = bytes.substr(0, end - kFacet.size());
    before = before.substr(0, before.find_last_not_of(kBlanks) + 1);
    if (before.size() >= 3 && lowered(before.substr(before.size() - 3)) == "end") {
      return before.size() - 3;
    }
  }
  return 0;
}

// Reads the keywords in upper or lower case, also if blanks separate their parts ("end loop") or
// if the blank is missing ("outerloop").
class AsciiStlReader {
 public:
  explicit AsciiStlReader(SourceFile& file) : file_(file), scan_(scan_text(file, '\0')) {}

  Mesh read() {
    for (scan_.skip_space(); !scan_.at_end(); scan_.skip_space()) {
      if (attributes_.groups.empty() || begins_solid()) {
        read_solid();
      } else {
        attributes_.uneditable = {"lines between or after the solids"};
        scan_.next_line();
      }
    }
    attributes_.corner_normals.reserve(mesh_.face_vertices().size());
    CancelCheck cancel_check;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      cancel_check();
      attributes_.corner_normals.insert(attributes_.corner_normals.end(), 3, f);
    }
    const bool named = std::any_of(attributes_.groups.begin(), attributes_.groups.end(),
                                   [](const std::string& name) { return !name.empty(); });
    if (attributes_.groups.size() < 2 && !named) {
      attributes_.groups.clear();
      attributes_.face_groups.clear();
    }
    return std::move(mesh_);
  }

 private:
  // A facet outside of the solids must not be skipped; `read_solid` reports it.
  bool begins_solid() const {
    TextScanner ahead = scan_;
    const std::string word = lowered(ahead.word());
    return word == "solid" || word == "facet";
  }

  void read_solid() {
    expect("solid");
    attributes_.groups.emplace_back(scan_.rest_of_line());
    for (;;) {
      scan_.skip_space();
      const TextScanner start = scan_;
      std::string word = lowered(scan_.word());
      if (word == "end") word += lowered(scan_.word());
      if (word == "endsolid") break;
      if (word.empty() || word == "solid") {
        file_.report_defect(FileDefectKind::missing_end, start.offset(),
                            "expected 'facet' or 'endsolid', found " +
                                (word.empty() ? "the end of the file" : "'" + word + "'"));
        scan_ = start;
        return;
      }
      const auto is_cut = [&](std::string_view whole) {
        return word != whole && whole.starts_with(word) && scan_.at_end();
      };
      if (is_cut("endsolid") || is_cut("facet")) {
        file_.report_defect(FileDefectKind::missing_end, start.offset(),
                            "the file ends within the word '" + word + "'");
        return;
      }
      if (word != "facet") start.fail_expected("'facet' or 'endsolid'");
      if (start.offset() > last_endfacet_) {
        file_.report_defect(FileDefectKind::missing_end, start.offset(),
                            "the file ends within this facet");
        while (!scan_.at_end()) scan_.next_line();
        return;
      }
      read_facet();
    }
    scan_.next_line();
  }

  void read_facet() {
    const std::uint64_t start = scan_.offset();
    expect("normal");
    attributes_.normals.push_back(scan_.triple(file_.normals, "a coordinate"));
    expect("outer", "loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect("vertex");
      polygons_.vertices.push_back(
          welder_.vertex_at(scan_.triple(file_.positions, "a coordinate")));
    }
    expect("end", "loop");
    expect("end", "facet");
    close_face(file_, polygons_, start);
    attributes_.face_groups.push_back(static_cast<Index>(attributes_.groups.size() - 1));
  }

  void expect(std::string_view keyword) {
    scan_.skip_space();
    const TextScanner start = scan_;
    if (lowered(scan_.word()) != keyword) start.fail_expected(keyword);
  }

  // Reads a keyword of two parts, which may be one word.
  void expect(const std::string& first, const std::string& second) {
    scan_.skip_space();
    const TextScanner start = scan_;
    const std::string word = lowered(scan_.word());
    if (word == first) {
      expect(second);
    } else if (word != first + second) {
      start.fail_expected(first + second);
    }
  }

  SourceFile& file_;
  TextScanner scan_;
  const std::uint64_t last_endfacet_ = find_last_endfacet(file_.bytes());
  Mesh mesh_;
  Faces& polygons_ = mesh_.edit_faces();
  MeshAttributes& attributes_ = mesh_.edit_attributes();
  Welder welder_{mesh_.positions};
};

// Returns the number of facets of a binary file. Computes it from the size of the file, because the
// count in the header may be wrong.
std::size_t count_facets(SourceFile& file) {
  const std::size_t size = file.bytes().size();
  if (size < kStlHeaderSize) {
    file.fail(0,
              "expected an ascii STL file that starts with 'solid', or a binary one of at least "
              "84 bytes; found " +
                  std::to_string(size) + " bytes");
  }
  const std::size_t count = binary_count(file.bytes());
  const std::size_t room = (size - kStlHeaderSize) / kStlFacetSize;
  // Some programs append a few bytes. If a whole facet follows the last one, the count is wrong.
  if (count != room) {
    file.report_defect(FileDefectKind::wrong_count, kStlTextSize,
                       "the header promises " + std::to_string(count) +
                           " triangles, but the file's size fits " + std::to_string(room));
  }
  return room;
}

void describe_places(SourceFile& file, std::size_t count) {
  NumberTriples regular;
  regular.types = {Scalar::float32, Scalar::float32, Scalar::float32};
  regular.first = kStlHeaderSize;
  regular.stride = kStlFacetSize;
  regular.places = {0, 4, 8};

  file.normals = regular;
  file.normals.count = count;
  file.positions = regular;
  file.positions.count = 3 * count;
  file.positions.places = {12, 16, 20};
  file.positions.per_block = 3;
  file.positions.spacing = 12;
}

Mesh read_binary(SourceFile& file) {
  file.encoding = kStlOrder;
  const std::string_view bytes = file.bytes();
  const std::size_t count = count_facets(file);
  describe_places(file, count);

  Mesh mesh;
  Welder welder(mesh.positions);
  welder.reserve(count / 2);  // vertices of a closed surface
  MeshAttributes& attributes = mesh.edit_attributes();
  attributes.normals.reserve(count);
  attributes.corner_normals.reserve(3 * count);
  Faces& faces = mesh.edit_faces();
  faces.vertices.reserve(3 * count);
  faces.starts.reserve(count + 1);
  ExtraAttribute words{"attribute", "ushort", 1, std::vector<double>(count)};
  bool any_word = false;
  CancelCheck cancel_check;
  for (std::size_t f = 0; f < count; ++f) {
    cancel_check();
    attributes.normals.push_back(file.read_triple(file.normals, f));
    for (std::size_t corner = 0; corner < 3; ++corner) {
      faces.vertices.push_back(welder.vertex_at(file.read_triple(file.positions, 3 * f + corner)));
    }
    const std::uint64_t start = kStlHeaderSize + f * kStlFacetSize;
    close_face(file, faces, start);
    attributes.corner_normals.insert(attributes.corner_normals.end(), 3, static_cast<Index>(f));
    words.values[f] = load_number(bytes.data() + start + 48, Scalar::uint16, kStlOrder);
    any_word = any_word || words.values[f] != 0.0;
  }
  if (any_word) attributes.face_extras.push_back(std::move(words));
  if (bytes.size() > kStlHeaderSize + count * kStlFacetSize) {
    attributes.uneditable.emplace_back("bytes after the last triangle");
  }
  return mesh;
}

}  // namespace

Mesh read_stl(SourceFile& file) {
  file.positions_by_corner = true;
  if (is_ascii(file)) return AsciiStlReader(file).read();
  return read_binary(file);
}

namespace {

// The triangles of a mesh, and the face each came from.
struct Facets {
  std::vector<Triangle> triangles;
  std::vector<Index> faces;
};

Facets cut_into_triangles(const Mesh& mesh) {
  Facets facets;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    triangulate_polygon(mesh.face(f), mesh.positions, facets.triangles);
    facets.faces.resize(facets.triangles.size(), static_cast<Index>(f));
  }
  return facets;
}

Eigen::Vector3d facet_normal(const Triangle& t, const Positions& p) {
  const Eigen::Vector3d normal = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).normalized();
  return normal.allFinite() ? normal : Eigen::Vector3d::Zero();
}

std::string write_ascii(const Mesh& mesh, const Facets& facets) {
  const MeshAttributes& a = mesh.attributes();
  const auto name_of_group = [&a](Index group) {
    return group == kNoIndex || a.groups[group].empty() ? std::string()
                                                        : " " + as_line(a.groups[group]);
  };
  const auto group_of = [&](std::size_t t) {
    return a.face_groups.empty() ? kNoIndex : a.face_groups[facets.faces[t]];
  };
  Index group = facets.triangles.empty() ? kNoIndex : group_of(0);
  std::string out = "solid" + name_of_group(group) + "\n";
  for (std::size_t t = 0; t < facets.triangles.size(); ++t) {
    if (group_of(t) != group) {
      out += "endsolid" + name_of_group(group) + "\n";
      group = group_of(t);
      out += "solid" + name_of_group(group) + "\n";
    }
    out += "facet normal";
    append_numbers(out, facet_normal(facets.triangles[t], mesh.positions));
    out += "\nouter loop\n";
    for (const Index v : facets.triangles[t]) {
      out += "vertex";
      append_numbers(out, mesh.positions[v]);
      out += '\n';
    }
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid" + name_of_group(group) + "\n";
}

const ExtraAttribute* attribute_words(const Mesh& mesh) {
  for (const ExtraAttribute& extra : mesh.attributes().face_extras) {
    if (extra.name == "attribute" && extra.type == "ushort") return &extra;
  }
  return nullptr;
}

std::string write_binary(const Mesh& mesh, const Facets& facets) {
  std::string out = "binary STL";
  out.resize(kStlTextSize, ' ');
  out.reserve(kStlHeaderSize + kStlFacetSize * facets.triangles.size());
  const auto append = [&out](double value, Scalar type) {
    append_binary(out, value, type, kStlOrder);
  };
  append(static_cast<double>(facets.triangles.size()), Scalar::uint32);
  const ExtraAttribute* const words = attribute_words(mesh);
  for (std::size_t t = 0; t < facets.triangles.size(); ++t) {
    for (const double x : facet_normal(facets.triangles[t], mesh.positions)) {
      append(x, Scalar::float32);
    }
    for (const Index v : facets.triangles[t]) {
      require_float(mesh.positions[v], v, MeshFormat::stl);
      for (const double x : mesh.positions[v]) append(x, Scalar::float32);
    }
    append(words == nullptr ? 0.0 : words->values[facets.faces[t]], Scalar::uint16);
  }
  return out;
}

void report_losses(const Mesh& mesh, bool ascii, WriteReport& report) {
  const MeshAttributes& a = mesh.attributes();
  report_materials(report, MeshFormat::stl, a);
  if (!ascii) report_groups(report, MeshFormat::stl, a);
  report_uneditable(report, MeshFormat::stl, a);
  if (!ascii) report_rounding(report, MeshFormat::stl, mesh);
  report_triangulation(report, MeshFormat::stl, mesh);
  report_loss(report, MeshFormat::stl, "texture coordinates", a.uvs.size());
  if (a.normals.size() != mesh.face_count()) {
    report_loss(report, MeshFormat::stl, "normals other than those of triangles", a.normals.size());
  }
  report_loss(report, MeshFormat::stl, "vertex colours", a.vertex_colors.size());
  report_loss(report, MeshFormat::stl, "face colours", a.face_colors.size());
  report_loss(report, MeshFormat::stl, "comments", a.comments.size());
  report_extras(report, MeshFormat::stl, a);
}

}  // namespace

std::string write_stl(const Mesh& mesh, Encoding encoding, WriteReport& report) {
  if (encoding == Encoding::big_endian) {
    throw InputError("STL has no big-endian form; write it as ascii or little endian");
  }
  require_finite(mesh);
  const Facets facets = cut_into_triangles(mesh);
  const bool ascii = encoding == Encoding::ascii;
  report_losses(mesh, ascii, report);
  return ascii ? write_ascii(mesh, facets) : write_binary(mesh, facets);
}

}  // namespace lapwing
