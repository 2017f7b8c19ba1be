#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/io/gltf_accessor.h"
#include "lapwing/io/gltf_scene.h"

namespace lapwing {

/// The vertices of one or more primitives of an object, as the file stores them: split where a
/// texture coordinate or a normal is. Record k of all of them belongs to vertex
/// GltfLayout::vertex_of_record[k] of the mesh that was read, where equal positions of one object
/// are one vertex.
struct GltfRecords {
  std::size_t object = 0;  ///< into GltfLayout::objects
  std::size_t first_record = 0;
  GltfAccessor positions;
  std::optional<GltfAccessor> normals;
  std::optional<GltfAccessor> tangents;

  std::size_t count() const { return positions.count(); }
};

/// What the writer of a glTF file needs to know of the one that a mesh was read from.
struct GltfLayout {
  explicit GltfLayout(const SourceFile& source) : file(source) {}

  GltfFile file;
  std::vector<GltfObject> objects;
  std::vector<GltfRecords> records;
  std::vector<Index> vertex_of_record;
  /// Into MeshAttributes::normals, where equal ones of a vertex are one; kNoIndex for none.
  std::vector<Index> normal_of_record;
  std::vector<Index> record_of_corner;
  /// Where the corners of triangles stand, and the elements of sparse accessors.
  std::vector<GltfAccessor::Range> indices;

  /// The position of element `k` in the world's coordinates, where the mesh has it.
  Eigen::Vector3d position(const GltfRecords& set, std::size_t k) const {
    return objects[set.object].to_world * set.positions.vector3(k);
  }
};

}  // namespace lapwing
