#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/mesh_file.h"

namespace lapwing {

/// Returns `text` as part of one line: NULs and line ends, which names in binary files may have,
/// become blanks.
std::string as_line(std::string text);

/// Appends the shortest text that reads back as the same number.
void append_number(std::string& out, double value);
void append_number(std::string& out, float value);
void append_number(std::string& out, std::size_t value);
/// Appends the shortest text that reads back as the same number of `type`. Rounds to integer types.
void append_number(std::string& out, double value, Scalar type);

/// Appends the numbers of a vector, with a blank before each.
template <class Vector>
void append_numbers(std::string& out, const Vector& values) {
  for (const auto value : values) {
    out += ' ';
    append_number(out, value);
  }
}

/// Reports "texture coordinates (14,290): OFF has no place for them", unless `count` is 0.
void report_loss(WriteReport& report, MeshFormat format, std::string_view what, std::size_t count);

/// Whether every number is finite after rounding to a 32-bit float.
template <class Vector>
bool is_finite_float(const Vector& numbers) {
  return std::ranges::all_of(
      numbers, [](double x) { return std::abs(x) <= double{std::numeric_limits<float>::max()}; });
}
/// Throws InputError, naming `vertex`, unless the 32-bit floats of `format` can hold `position`.
void require_float(const Eigen::Vector3d& position, Index vertex, MeshFormat format);

/// Reports polygons and isolated vertices of `mesh`, which triangle formats cannot hold.
void report_triangulation(WriteReport& report, MeshFormat format, const Mesh& mesh);

/// Rounding errors up to this multiple of the mean edge length are not reported.
inline constexpr double kHarmlessRounding = 1e-3;
/// The largest error that results if positions relative to an origin are rounded to 32-bit floats.
struct Rounding {
  double error = 0.0;
  double mean_edges = 0.0;  ///< `error` / mean edge length; 0 if the mesh has no edges
};
Rounding rounding_of(const Mesh& mesh, const Eigen::Vector3d& origin);
/// Reports the rounding error if it exceeds kHarmlessRounding.
void report_rounding(WriteReport& report, MeshFormat format, const Mesh& mesh,
                     const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// Reports extra attributes, which only PLY can hold.
void report_extras(WriteReport& report, MeshFormat format, const MeshAttributes& attributes);
/// Reports materials and textures. Call it for a format that cannot hold them.
void report_materials(WriteReport& report, MeshFormat format, const MeshAttributes& attributes);
/// Reports groups or objects. Call it for a format that cannot hold them.
void report_groups(WriteReport& report, MeshFormat format, const MeshAttributes& attributes);
/// Reports data that only the source file holds.
void report_uneditable(WriteReport& report, MeshFormat format, const MeshAttributes& attributes);

/// Views a list of vectors as one list of numbers.
template <class Vector>
std::span<const double> numbers_of(const std::vector<Vector>& vectors) {
  if (vectors.empty()) return {};
  return {vectors.front().data(), vectors.size() * Vector::SizeAtCompileTime};
}

/// Returns float32 if every number is exactly a float, else float64.
Scalar narrowest_type(std::span<const double> numbers);

/// Whether all colours are multiples of 1/255 in [0, 1], which fit bytes without loss.
bool fit_bytes(std::span<const Eigen::Vector4f> colors);
/// Whether some colour is not opaque.
bool has_alpha(std::span<const Eigen::Vector4f> colors);

/// Converts values per corner to values per vertex: 0 for vertices without corners, nullopt if
/// corners of a vertex differ. If `of_corner` is empty, values are per vertex already or absent.
template <class Vector>
std::optional<std::vector<Vector>> per_vertex(const Mesh& mesh, const std::vector<Vector>& values,
                                              const std::vector<Index>& of_corner) {
  if (values.empty()) return std::nullopt;
  if (of_corner.empty()) {
    if (values.size() != mesh.vertex_count()) return std::nullopt;
    return values;
  }
  std::vector<Vector> result(mesh.vertex_count(), Vector::Zero());
  std::vector<bool> known(mesh.vertex_count(), false);
  for (std::size_t c = 0; c < of_corner.size(); ++c) {
    if (of_corner[c] == kNoIndex) return std::nullopt;
    const Index v = mesh.face_vertices()[c];
    const Vector& value = values[of_corner[c]];
    if (known[v] && result[v] != value) return std::nullopt;
    known[v] = true;
    result[v] = value;
  }
  return result;
}

/// Throws InputError if an index of a face or attribute is out of range, or if a list does not have
/// the length that MeshAttributes states.
void validate_for_writing(const Mesh& mesh);

// These functions write each format except glTF. Each returns a complete new file, and appends to
// `report` all data that the format cannot hold. The report is in order of importance: materials,
// groups, other content of the file, precision, attributes.

std::string write_obj(const Mesh& mesh, WriteReport& report);
std::string write_off(const Mesh& mesh, WriteReport& report);
std::string write_ply(const Mesh& mesh, Encoding encoding, WriteReport& report);
std::string write_stl(const Mesh& mesh, Encoding encoding, WriteReport& report);

}  // namespace lapwing
