#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace lapwing {

/// Vertex, face and corner numbers. Meshes hold fewer than 2^32 - 1 of each.
using Index = std::uint32_t;
inline constexpr Index kNoIndex = 0xFFFFFFFFU;

using Positions = std::vector<Eigen::Vector3d>;

/// A named list of numbers, one tuple per vertex or per face, that the engine carries without
/// understanding it (a PLY property, say). `components` values per element.
struct ExtraAttribute {
  std::string name;
  std::string type;  ///< the type in the file: "uchar", "float", "list uchar int", ...
  int components = 1;
  std::vector<double> values;
};

/// Everything a mesh carries beside positions and polygons. Every list is either empty or of the
/// length stated. Editing never reads these; writing does.
struct MeshAttributes {
  std::vector<Eigen::Vector2d> uvs;            ///< the file's texture coordinates, in its order
  std::vector<Index> corner_uvs;               ///< per corner: into `uvs`, or kNoIndex
  std::vector<Eigen::Vector3d> normals;        ///< the file's normals, in its order
  std::vector<Index> corner_normals;           ///< per corner: into `normals`, or kNoIndex
  bool has_vertex_normals = false;             ///< one stored normal per vertex (PLY, NOFF)
  std::vector<Eigen::Vector4f> vertex_colors;  ///< per vertex, RGBA in [0, 1]
  std::vector<Eigen::Vector4f> face_colors;    ///< per face, RGBA in [0, 1]
  std::vector<std::string> material_libraries;
  std::vector<std::string> materials;  ///< names
  std::vector<Index> face_materials;   ///< per face: into `materials`, or kNoIndex
  std::vector<std::string> groups;     ///< names (OBJ groups, STL solids)
  std::vector<Index> face_groups;      ///< per face: into `groups`, or kNoIndex
  std::vector<std::string> comments;
  std::vector<ExtraAttribute> vertex_extras;
  std::vector<ExtraAttribute> face_extras;
  /// What the file holds beside all this, counted by name: "line elements (6)". Only a write of the
  /// same format, to an unchanged topology, keeps it.
  std::vector<std::string> uneditable;
};

/// What a reader keeps of the file so that the writer of the same format can put back all that an
/// edit did not change (see io/source_file.h). Shared between copies of a mesh; dropped when its
/// vertices or faces change.
class SourceFile;

/// A polygon mesh: vertex positions, polygons as vertex lists, and carried attributes. Plain data;
/// no invariant beyond the sizes stated. `validate_indices` checks the ones that the engine needs.
struct Mesh {
  Positions positions;
  std::vector<Index> face_starts{0};  ///< face f is face_vertices[face_starts[f], face_starts[f+1])
  std::vector<Index> face_vertices;   ///< one entry per corner
  MeshAttributes attributes;
  std::shared_ptr<const SourceFile> source;

  std::size_t vertex_count() const { return positions.size(); }
  std::size_t face_count() const { return face_starts.size() - 1; }
  std::span<const Index> face(std::size_t f) const {
    return std::span(face_vertices).subspan(face_starts[f], face_starts[f + 1] - face_starts[f]);
  }
  /// Appends a polygon. Attributes per corner and per face are the caller's business.
  void add_face(std::span<const Index> vertices) {
    face_vertices.insert(face_vertices.end(), vertices.begin(), vertices.end());
    face_starts.push_back(static_cast<Index>(face_vertices.size()));
  }
};

/// Axis-aligned bounding box of the finite positions; both corners 0 if there are none.
struct Bounds {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  Eigen::Vector3d max = Eigen::Vector3d::Zero();
  Eigen::Vector3d center() const { return 0.5 * (min + max); }
  double diagonal() const { return (max - min).norm(); }
};
Bounds bounds_of(std::span<const Eigen::Vector3d> positions);
/// The smallest that holds both.
Bounds united(const Bounds& a, const Bounds& b);

/// Throws InputError, naming the face, when a face names a vertex that the mesh does not have.
void validate_indices(const Mesh& mesh);

}  // namespace lapwing
