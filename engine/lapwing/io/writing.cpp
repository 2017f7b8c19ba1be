#include "lapwing/io/writing.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "lapwing/base/errors.h"
#include "lapwing/base/printable_text.h"
#include "lapwing/io/mesh_materials.h"
#include "lapwing/io/reading.h"

namespace lapwing {
namespace {

template <class Number>
void append_shortest(std::string& out, Number value) {
  std::array<char, 32> text{};  // the longest shortest double has 24 characters
  const std::to_chars_result end = std::to_chars(text.begin(), text.end(), value);
  out.append(text.begin(), end.ptr);
}

void check_size(std::string_view name, std::size_t size, std::size_t expected) {
  if (size == 0 || size == expected) return;
  throw InputError("the mesh has " + std::to_string(size) + " " + std::string(name) + " for " +
                   std::to_string(expected) + " elements; give one for each element, or none");
}

void check_range(std::string_view name, const std::vector<Index>& indices, std::size_t count) {
  const auto bad = std::find_if(indices.begin(), indices.end(),
                                [&](Index i) { return i != kNoIndex && i >= count; });
  if (bad == indices.end()) return;
  throw InputError("entry " + std::to_string(bad - indices.begin()) + " of the mesh's " +
                   std::string(name) + " is " + std::to_string(*bad) + ", but there are " +
                   std::to_string(count) + "; correct the index");
}

}  // namespace

std::string as_line(std::string text) {
  for (char& c : text) {
    if (c == '\0' || c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

void append_number(std::string& out, double value) {
  append_shortest(out, value);
}
void append_number(std::string& out, float value) {
  append_shortest(out, value);
}
void append_number(std::string& out, std::size_t value) {
  append_shortest(out, value);
}

void append_number(std::string& out, double value, Scalar type) {
  if (type == Scalar::float64) {
    append_number(out, value);
  } else if (type == Scalar::float32) {
    append_number(out, static_cast<float>(value));
  } else {
    constexpr double kLargest = 4294967295.0;  // beyond every integer type of a file
    append_shortest(out,
                    std::isnan(value) ? 0 : std::llround(std::clamp(value, -kLargest, kLargest)));
  }
}

void report_loss(WriteReport& report, MeshFormat format, std::string_view what, std::size_t count) {
  if (count == 0) return;
  report.not_carried.push_back(std::string(what) + " (" + grouped(count) +
                               "): " + std::string(name_of(format)) + " cannot store them");
}

void require_float(const Eigen::Vector3d& position, Index vertex, MeshFormat format) {
  if (is_finite_float(position)) return;
  throw InputError("vertex " + std::to_string(vertex) +
                       " has a coordinate that is not finite in the 32-bit floats of " +
                       std::string(name_of(format)) +
                       "; repair the mesh with `lapwing check MESH --fix OUT`, scale it, or write "
                       "another format",
                   {vertex});
}

void report_triangulation(WriteReport& report, MeshFormat format, const Mesh& mesh) {
  std::size_t polygons = 0;
  std::vector<bool> used(mesh.vertex_count(), false);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    polygons += mesh.face(f).size() > 3 ? 1 : 0;
    for (const Index v : mesh.face(f)) used[v] = true;
  }
  report_loss(report, format, "polygons, now written as triangles", polygons);
  report_loss(report, format, "vertices without a face",
              static_cast<std::size_t>(std::count(used.begin(), used.end(), false)));
}

namespace {

double mean_edge_length(const Mesh& mesh) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const double length =
          (mesh.positions[face[(k + 1) % face.size()]] - mesh.positions[face[k]]).norm();
      if (!std::isfinite(length)) continue;
      sum += length;
      ++count;
    }
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace

Rounding rounding_of(const Mesh& mesh, const Eigen::Vector3d& origin) {
  Rounding rounding;
  for (const Eigen::Vector3d& position : mesh.positions) {
    const Eigen::Vector3d local = position - origin;
    const double error = (local - local.cast<float>().cast<double>()).norm();
    if (std::isfinite(error)) rounding.error = std::max(rounding.error, error);
  }
  const double edge = rounding.error > 0.0 ? mean_edge_length(mesh) : 0.0;
  if (edge > 0.0) rounding.mean_edges = rounding.error / edge;
  return rounding;
}

void report_rounding(WriteReport& report, MeshFormat format, const Mesh& mesh,
                     const Eigen::Vector3d& origin) {
  const Rounding rounding = rounding_of(mesh, origin);
  if (rounding.mean_edges <= kHarmlessRounding) return;
  std::array<char, 160> numbers{};
  std::snprintf(numbers.data(), numbers.size(), "by up to %.3g, %.3g times the mean edge length",
                rounding.error, rounding.mean_edges);
  report.not_carried.push_back(
      "exact positions: the 32-bit floats of " + std::string(name_of(format)) + " move vertices " +
      numbers.data() +
      (is_gltf(format) ? "; write .obj or .ply instead" : "; write .obj, .ply or .glb instead"));
}

void report_extras(WriteReport& report, MeshFormat format, const MeshAttributes& attributes) {
  for (const ExtraAttribute& extra : attributes.vertex_extras) {
    report_loss(report, format, "vertex property '" + extra.name + "'", extra.values.size());
  }
  for (const ExtraAttribute& extra : attributes.face_extras) {
    report_loss(report, format, "face property '" + extra.name + "'", extra.values.size());
  }
}

void report_materials(WriteReport& report, MeshFormat format, const MeshAttributes& attributes) {
  report_loss(report, format, "colours and images of materials",
              std::max(attributes.materials.size(), texture_names(attributes).size()));
}

void report_groups(WriteReport& report, MeshFormat format, const MeshAttributes& attributes) {
  report_loss(report, format, attributes.groups_are_objects ? "names of objects" : "groups",
              attributes.groups.size());
}

void report_uneditable(WriteReport& report, MeshFormat format, const MeshAttributes& attributes) {
  for (const std::string& what : attributes.uneditable) {
    report.not_carried.push_back(what + ": kept only in the original file, not in a new " +
                                 std::string(name_of(format)) + " file");
  }
}

Scalar narrowest_type(std::span<const double> numbers) {
  const bool floats = std::all_of(numbers.begin(), numbers.end(), [](double x) {
    return std::isnan(x) || double{static_cast<float>(x)} == x;
  });
  return floats ? Scalar::float32 : Scalar::float64;
}

bool fit_bytes(std::span<const Eigen::Vector4f> colors) {
  return std::all_of(colors.begin(), colors.end(), [](const Eigen::Vector4f& color) {
    return std::all_of(color.begin(), color.end(), [](float x) {
      return x >= 0.0F && x <= 1.0F && static_cast<float>(std::round(x * 255.0) / 255.0) == x;
    });
  });
}

bool has_alpha(std::span<const Eigen::Vector4f> colors) {
  return std::any_of(colors.begin(), colors.end(),
                     [](const Eigen::Vector4f& color) { return color[3] != 1.0F; });
}

void validate_for_writing(const Mesh& mesh) {
  validate_indices(mesh);
  const MeshAttributes& a = mesh.attributes();
  check_size("corner_uvs", a.corner_uvs.size(), mesh.face_vertices().size());
  check_size("corner_normals", a.corner_normals.size(), mesh.face_vertices().size());
  check_size("vertex_colors", a.vertex_colors.size(), mesh.vertex_count());
  check_size("face_colors", a.face_colors.size(), mesh.face_count());
  check_size("face_materials", a.face_materials.size(), mesh.face_count());
  check_size("face_groups", a.face_groups.size(), mesh.face_count());
  check_range("corner_uvs", a.corner_uvs, a.uvs.size());
  check_range("corner_normals", a.corner_normals, a.normals.size());
  check_range("face_materials", a.face_materials, a.materials.size());
  check_range("face_groups", a.face_groups, a.groups.size());
  if (a.has_vertex_normals && a.normals.size() != mesh.vertex_count()) {
    throw InputError("the mesh has " + std::to_string(a.normals.size()) + " normals for " +
                     std::to_string(mesh.vertex_count()) +
                     " vertices; give one for each, or clear has_vertex_normals");
  }
  for (const ExtraAttribute& extra : a.vertex_extras) {
    check_size(extra.name, extra.values.size(), mesh.vertex_count());
  }
  for (const ExtraAttribute& extra : a.face_extras) {
    check_size(extra.name, extra.values.size(), mesh.face_count());
  }
}

}  // namespace lapwing
