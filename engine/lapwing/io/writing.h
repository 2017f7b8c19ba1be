#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/mesh_file.h"

namespace lapwing {

/// Append the shortest text that reads back as the same double, or the same float.
/// `text` in a text file's line: a NUL, or an end of a line, which names of binary files may have,
/// becomes a blank.
std::string as_line(std::string text);

void append_number(std::string& out, double value);
void append_number(std::string& out, float value);
void append_number(std::string& out, std::size_t value);
/// The shortest text that a reader of a property of this type reads back; nearest integer for
/// integer types.
void append_number(std::string& out, double value, Scalar type);

/// Appends the numbers of a vector, each behind a blank.
template <class Vector>
void append_numbers(std::string& out, const Vector& values) {
  for (const auto value : values) {
    out += ' ';
    append_number(out, value);
  }
}

/// "texture coordinates (14,290): OFF has no place for them", unless `count` is 0.
void report_loss(WriteReport& report, MeshFormat format, std::string_view what, std::size_t count);

/// Reports extra attributes, which only PLY has places for.
void report_extras(WriteReport& report, MeshFormat format, const MeshAttributes& attributes);
/// Reports materials, in a format that has no place for them.
void report_materials(WriteReport& report, MeshFormat format, const MeshAttributes& attributes);
/// Reports what only the file it came from holds.
void report_uneditable(WriteReport& report, MeshFormat format, const MeshAttributes& attributes);

/// The numbers of a list of vectors, one after the other.
template <class Vector>
std::span<const double> numbers_of(const std::vector<Vector>& vectors) {
  if (vectors.empty()) return {};
  return {vectors.front().data(), vectors.size() * Vector::SizeAtCompileTime};
}

/// kFloat32 if every one of the numbers is a float, else kFloat64.
Scalar narrowest_type(std::span<const double> numbers);

/// Whether all colours are whole numbers of 255ths; they then fit bytes without loss.
bool fit_bytes(std::span<const Eigen::Vector4f> colors);
/// Whether some colour is not opaque.
bool has_alpha(std::span<const Eigen::Vector4f> colors);

/// Values per corner as values per vertex, if the corners of each vertex agree; 0 for a vertex
/// without corners. `of_corner` empty: the values are per vertex already, or there are none.
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

/// Throws InputError when a face or an attribute names what the mesh does not have, or a list has
/// not the length that MeshAttributes states.
void validate_for_writing(const Mesh& mesh);

}  // namespace lapwing
