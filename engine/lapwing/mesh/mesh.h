#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "lapwing/base/once.h"

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

/// Polygons as lists of vertices, in compressed rows.
struct Faces {
  std::vector<Index> starts{0};  ///< face f is vertices[starts[f], starts[f+1])
  std::vector<Index> vertices;   ///< one entry per corner

  std::size_t count() const { return starts.size() - 1; }
  /// Appends a polygon.
  void add(std::span<const Index> polygon) {
    vertices.insert(vertices.end(), polygon.begin(), polygon.end());
    starts.push_back(static_cast<Index>(vertices.size()));
  }
};

struct Topology;

/// A polygon mesh: vertex positions, polygons as vertex lists, and carried attributes. No invariant
/// beyond the sizes stated; `validate_indices` checks the ones that the engine needs.
///
/// Positions belong to each mesh. Polygons, with their topology, and attributes are shared between
/// copies until one of them edits them: a copy costs its positions.
class Mesh {
 public:
  Positions positions;
  std::shared_ptr<const SourceFile> source;

  std::size_t vertex_count() const { return positions.size(); }
  std::size_t face_count() const { return faces().count(); }
  std::span<const Index> face(std::size_t f) const& {
    const Faces& all = faces();
    return std::span(all.vertices).subspan(all.starts[f], all.starts[f + 1] - all.starts[f]);
  }
  const Faces& faces() const& { return connectivity_ ? connectivity_->faces : kNoFaces; }
  const std::vector<Index>& face_starts() const& { return faces().starts; }
  const std::vector<Index>& face_vertices() const& { return faces().vertices; }
  const MeshAttributes& attributes() const& { return attributes_ ? *attributes_ : kNoAttributes; }
  // Of a mesh without a name, which is gone after the expression.
  void face(std::size_t f) && = delete;
  Faces faces() && { return faces(); }
  std::vector<Index> face_starts() && { return faces().starts; }
  std::vector<Index> face_vertices() && { return faces().vertices; }
  MeshAttributes attributes() && { return attributes(); }

  /// What both meshes know of their polygons is one object: no copy has edited them since.
  bool shares_faces_with(const Mesh& other) const { return connectivity_ == other.connectivity_; }

  /// The polygons (the attributes) of this mesh alone, to change. The reference holds until the
  /// mesh is copied, moved or asked for its topology; references from before the call are void.
  Faces& edit_faces();
  MeshAttributes& edit_attributes();
  /// Appends a polygon. Attributes per corner and per face are the caller's business.
  void add_face(std::span<const Index> vertices) { edit_faces().add(vertices); }

  /// What the mathematics needs to know of the polygons. Built when it is first asked for, in time
  /// linear in the size of the mesh, and shared as they are; polygons of more than three corners
  /// are cut into triangles as they lie in the mesh that asks first. Lives as long as any mesh that
  /// shares it. Threads may ask at once. Throws what `build_topology` does, and std::logic_error
  /// for a mesh that was moved from, or whose vertices were added or dropped since without
  /// `edit_faces`.
  const Topology& topology() const&;
  void topology() && = delete;
  /// The same, for those that outlive every mesh that shares it.
  std::shared_ptr<const Topology> shared_topology() const;

 private:
  struct Connectivity {
    Faces faces;
    mutable Once building;
    mutable std::shared_ptr<const Topology> topology;
  };
  static const Faces kNoFaces;
  static const MeshAttributes kNoAttributes;

  // Null after a move, which leaves no faces.
  std::shared_ptr<Connectivity> connectivity_ = std::make_shared<Connectivity>();
  std::shared_ptr<MeshAttributes> attributes_;  // null without any
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
