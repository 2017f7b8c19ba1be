#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "lapwing/base/parallel.h"

namespace lapwing {

/// Vertex, face and corner numbers. Meshes hold fewer than 2^32 - 1 of each.
using Index = std::uint32_t;
inline constexpr Index kNoIndex = 0xFFFFFFFFU;

using Positions = std::vector<Eigen::Vector3d>;

/// A named attribute with `components` numbers per vertex or per face, such as a PLY property. The
/// engine carries it along without interpreting it.
struct ExtraAttribute {
  std::string name;
  std::string type;  ///< the type in the file: "uchar", "float", "list uchar int", ...
  int components = 1;
  std::vector<double> values;
};

/// Everything a mesh carries besides positions and polygons. Every list is either empty or of the
/// length stated. Editing never reads these; writing does.
struct MeshAttributes {
  std::vector<Eigen::Vector2d> uvs;            ///< the file's texture coordinates, in its order
  std::vector<Index> corner_uvs;               ///< per corner: index into `uvs`, or kNoIndex
  std::vector<Eigen::Vector3d> normals;        ///< the file's normals, in its order
  std::vector<Index> corner_normals;           ///< per corner: index into `normals`, or kNoIndex
  bool has_vertex_normals = false;             ///< one stored normal per vertex (PLY, NOFF)
  bool groups_are_objects = false;             ///< OBJ files get `o` instead of `g` statements
  std::vector<Eigen::Vector4f> vertex_colors;  ///< per vertex, RGBA in [0, 1]
  std::vector<Eigen::Vector4f> face_colors;    ///< per face, RGBA in [0, 1]
  std::vector<std::string> material_libraries;
  std::vector<std::string> materials;  ///< names
  std::vector<Index> face_materials;   ///< per face: index into `materials`, or kNoIndex
  std::vector<std::string> groups;     ///< names of OBJ groups and objects, glTF nodes, STL solids
  std::vector<Index> face_groups;      ///< per face: index into `groups`, or kNoIndex
  std::vector<std::string> comments;
  std::vector<ExtraAttribute> vertex_extras;
  std::vector<ExtraAttribute> face_extras;
  /// Other content of the file, counted by name: "line elements (6)". It survives only if the mesh
  /// is written to the same format with unchanged topology.
  std::vector<std::string> uneditable;
};

/// Data that a reader keeps so that the writer of the same format can restore everything that an
/// edit did not change (see io/source_file.h). Copies of a mesh share it. It is dropped when
/// vertices or faces change.
class SourceFile;

/// Polygons as lists of vertices, in compressed rows.
struct Faces {
  std::vector<Index> starts{0};  ///< face f is vertices[starts[f], starts[f+1])
  std::vector<Index> vertices;   ///< one entry per corner

  std::size_t count() const { return starts.size() - 1; }
  void add(std::span<const Index> polygon) {
    vertices.insert(vertices.end(), polygon.begin(), polygon.end());
    starts.push_back(static_cast<Index>(vertices.size()));
  }
};

struct Topology;

/// A polygon mesh: vertex positions, polygons as vertex lists, and attributes. The class guarantees
/// only the list sizes stated; `validate_indices` checks the indices.
///
/// Each copy has its own positions. Copies share polygons, topology and attributes until one of
/// them edits these, so a copy costs only its positions.
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
  // Overloads for temporaries, because a reference into one would dangle.
  void face(std::size_t f) && = delete;
  Faces faces() && { return faces(); }
  std::vector<Index> face_starts() && { return faces().starts; }
  std::vector<Index> face_vertices() && { return faces().vertices; }
  MeshAttributes attributes() && { return attributes(); }

  /// Returns whether the meshes share their polygons: neither has edited them since the copy.
  bool shares_faces_with(const Mesh& other) const { return connectivity_ == other.connectivity_; }

  /// Returns the polygons or attributes for editing, no longer shared. The reference is valid until
  /// the mesh is copied or moved, or `topology()` is called. Earlier references become invalid.
  Faces& edit_faces();
  MeshAttributes& edit_attributes();
  /// Appends a polygon. The caller must extend the attributes per corner and per face.
  void add_face(std::span<const Index> vertices) { edit_faces().add(vertices); }

  /// Returns the connectivity of the polygons. The first call builds it in linear time. Meshes that
  /// share their polygons share it, and it lives as long as any of them. The positions of the mesh
  /// that first calls this decide how larger polygons are triangulated. Thread-safe. Throws what
  /// `build_topology` throws. Throws std::logic_error if the mesh was moved from, or if vertices
  /// were added or dropped since without `edit_faces`.
  const Topology& topology() const&;
  void topology() && = delete;
  /// The same, for callers that may outlive every mesh that shares it.
  std::shared_ptr<const Topology> shared_topology() const;

 private:
  struct Connectivity {
    Faces faces;
    mutable Once building;
    mutable std::shared_ptr<const Topology> topology;
  };
  static const Faces kNoFaces;
  static const MeshAttributes kNoAttributes;

  // Null in a mesh that was moved from, which has no faces.
  std::shared_ptr<Connectivity> connectivity_ = std::make_shared<Connectivity>();
  std::shared_ptr<MeshAttributes> attributes_;  // null if there are none
};

/// Axis-aligned bounding box of the finite positions; both corners 0 if there are none.
struct Bounds {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  Eigen::Vector3d max = Eigen::Vector3d::Zero();
  Eigen::Vector3d center() const { return 0.5 * (min + max); }
  double diagonal() const { return (max - min).norm(); }
};
Bounds bounds_of(std::span<const Eigen::Vector3d> positions);
/// Returns the smallest box that contains both.
Bounds united(const Bounds& a, const Bounds& b);

/// Throws InputError, naming the face, if a face uses a vertex that the mesh does not have.
void validate_indices(const Mesh& mesh);

/// Throws InputError, naming the vertex, if a face has a vertex that is not finite.
void require_finite(const Mesh& mesh);

/// Sizes of meshes that the engine supports: all that 32-bit floats can hold (1e-38 to 3e38). The
/// mathematics uses up to the sixth power of edge lengths, which doubles hold even for edges of a
/// ten-thousandth of the size.
inline constexpr double kSmallestExtent = 1e-38;
inline constexpr double kLargestExtent = 1e39;

/// Returns the largest side of the bounding box of the vertices with finite positions, or 0 if they
/// coincide. Throws InputError, naming `where`, if any other size is outside those limits.
double require_extent(std::span<const Index> vertices, std::span<const Eigen::Vector3d> positions,
                      const std::string& where);

}  // namespace lapwing
