#include <algorithm>
#include <cctype>

#include "lapwing/base/cancellation.h"
#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/formats.h"
#include "lapwing/io/reading.h"
#include "lapwing/io/stl_layout.h"
#include "lapwing/io/text_scanner.h"
#include "lapwing/io/welder.h"

namespace lapwing {
namespace {

std::string lower_word(TextScanner& scan) {
  std::string word(scan.word());
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

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
  TextScanner scan(file, '\0');
  scan.skip_space();
  return lower_word(scan) == "solid";
}

class AsciiStlReader {
 public:
  explicit AsciiStlReader(SourceFile& file) : file_(file), scan_(scan_text(file, '\0')) {}

  Mesh read() {
    for (scan_.skip_space(); !scan_.at_end(); scan_.skip_space()) read_solid();
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
  void read_solid() {
    expect("solid");
    attributes_.groups.emplace_back(scan_.rest_of_line());
    for (;;) {
      scan_.skip_space();
      const TextScanner start = scan_;
      const std::string word = lower_word(scan_);
      if (word == "endsolid") break;
      if (word != "facet") start.fail_expected("'facet' or 'endsolid'");
      read_facet();
    }
    scan_.next_line();
  }

  void read_facet() {
    const std::uint64_t start = scan_.offset();
    expect("normal");
    attributes_.normals.push_back(read_triple(file_.normals));
    expect("outer");
    expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect("vertex");
      polygons_.vertices.push_back(welder_.vertex_at(read_triple(file_.positions)));
    }
    expect("endloop");
    expect("endfacet");
    close_face(file_, polygons_, start);
    attributes_.face_groups.push_back(static_cast<Index>(attributes_.groups.size() - 1));
  }

  void expect(std::string_view keyword) {
    scan_.skip_space();
    const TextScanner start = scan_;
    if (lower_word(scan_) != keyword) start.fail_expected(keyword);
  }

  Eigen::Vector3d read_triple(NumberTriples& places) {
    std::array<std::uint64_t, 3> offsets{};
    Eigen::Vector3d value;
    for (std::size_t k = 0; k < 3; ++k) {
      scan_.skip_blanks();
      offsets[k] = scan_.offset();
      value[static_cast<Eigen::Index>(k)] = scan_.number("a coordinate");
    }
    places.add(offsets[0], offsets[1], offsets[2]);
    return value;
  }

  SourceFile& file_;
  TextScanner scan_;
  Mesh mesh_;
  Faces& polygons_ = mesh_.edit_faces();
  MeshAttributes& attributes_ = mesh_.edit_attributes();
  Welder welder_{mesh_.positions};
};

void check_binary_size(const SourceFile& file) {
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
    file.fail(80, "the header promises " + std::to_string(count) +
                      " triangles, but the file's size fits " + std::to_string(room));
  }
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
  check_binary_size(file);
  const std::string_view bytes = file.bytes();
  const std::size_t count = binary_count(bytes);
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

}  // namespace lapwing
