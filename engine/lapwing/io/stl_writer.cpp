#include <array>

#include <Eigen/Geometry>

#include "lapwing/base/errors.h"
#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/formats.h"
#include "lapwing/io/stl_layout.h"
#include "lapwing/io/writing.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
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
      for (const double x : mesh.positions[v]) append(x, Scalar::float32);
    }
    append(words == nullptr ? 0.0 : words->values[facets.faces[t]], Scalar::uint16);
  }
  return out;
}

void report_losses(const Mesh& mesh, const Facets& facets, bool ascii, WriteReport& report) {
  const MeshAttributes& a = mesh.attributes();
  std::size_t polygons = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) polygons += mesh.face(f).size() > 3 ? 1 : 0;
  std::vector<bool> used(mesh.vertex_count(), false);
  for (const Triangle& t : facets.triangles) {
    for (const Index v : t) used[v] = true;
  }
  const auto loose = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));

  report_loss(report, MeshFormat::stl, "polygons, now written as triangles", polygons);
  report_loss(report, MeshFormat::stl, "vertices without a face", loose);
  if (!ascii && narrowest_type(numbers_of(mesh.positions)) != Scalar::float32) {
    report_loss(report, MeshFormat::stl,
                "positions in double precision, now rounded to 32-bit floats", mesh.vertex_count());
  }
  report_loss(report, MeshFormat::stl, "texture coordinates", a.uvs.size());
  if (a.normals.size() != mesh.face_count()) {
    report_loss(report, MeshFormat::stl, "normals other than those of triangles", a.normals.size());
  }
  report_loss(report, MeshFormat::stl, "vertex colours", a.vertex_colors.size());
  report_loss(report, MeshFormat::stl, "face colours", a.face_colors.size());
  report_materials(report, MeshFormat::stl, a);
  if (!ascii) report_loss(report, MeshFormat::stl, "groups", a.groups.size());
  report_loss(report, MeshFormat::stl, "comments", a.comments.size());
  report_extras(report, MeshFormat::stl, a);
  report_uneditable(report, MeshFormat::stl, a);
}

}  // namespace

std::string write_stl(const Mesh& mesh, Encoding encoding, WriteReport& report) {
  if (encoding == Encoding::big_endian) {
    throw InputError("STL has no big-endian form; write it as ascii or little endian");
  }
  const Facets facets = cut_into_triangles(mesh);
  const bool ascii = encoding == Encoding::ascii;
  report_losses(mesh, facets, ascii, report);
  return ascii ? write_ascii(mesh, facets) : write_binary(mesh, facets);
}

}  // namespace lapwing
