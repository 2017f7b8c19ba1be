#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/io/gltf_accessor.h"
#include "lapwing/io/gltf_file.h"

namespace lapwing {

/// A node that shows a mesh, or an instance of such a node. Several objects may show the same mesh.
struct GltfObject {
  /// Name of the node, else of its mesh, else "node 3". An instance of a node is called
  /// "Tree (instance 0)". Unique in the file.
  std::string name;
  std::size_t node = 0;
  std::size_t mesh = 0;
  /// From mesh to world coordinates. The identity for a mesh with a skin, which its joints place:
  /// it is edited in its bind pose.
  Eigen::Affine3d to_world = Eigen::Affine3d::Identity();
  bool has_skin = false;
  /// Whether the node has several such objects (EXT_mesh_gpu_instancing), which have to show the
  /// same mesh.
  bool is_instance = false;
};

/// Returns all objects of the scene, or only those called `name` if it is not empty. Parents come
/// before children. `name` is the name of a node or, if no node has it, of a mesh. Throws
/// InputError if no object has that name; the message suggests names. Objects with a scale of 0
/// have no surface and are left out. Adds one of `notes` about these, and one about objects outside
/// the scene. Throws InputError if the nodes do not form trees, if all objects have a scale of 0,
/// or if a scale is not finite.
std::vector<GltfObject> find_objects(const GltfFile& file, const std::string& name,
                                     std::vector<std::string>& notes);

/// Returns the names of all objects that show mesh `mesh`, including those outside the scene.
std::vector<std::string> objects_showing(const GltfFile& file, std::size_t mesh);

/// The vertices of one or more primitives of an object, as the file stores them: split where
/// texture coordinates or normals differ. Records are numbered across all sets, and record k
/// belongs to mesh vertex GltfLayout::vertex_of_record[k]. Equal positions of an object are one
/// vertex.
struct GltfRecords {
  std::size_t object = 0;  ///< into GltfLayout::objects
  std::size_t first_record = 0;
  GltfAccessor positions;
  std::optional<GltfAccessor> normals;
  std::optional<GltfAccessor> tangents;

  std::size_t count() const { return positions.count(); }
};

/// What the glTF writer needs to know about the file that a mesh was read from.
struct GltfLayout {
  explicit GltfLayout(const SourceFile& source) : file(source) {}

  GltfFile file;
  std::vector<GltfObject> objects;
  std::vector<GltfRecords> records;
  std::vector<Index> vertex_of_record;
  /// Index into MeshAttributes::normals or kNoIndex; equal normals of a vertex share one.
  std::vector<Index> normal_of_record;
  std::vector<Index> record_of_corner;
  /// Byte ranges of triangle indices and of sparse indices.
  std::vector<GltfAccessor::Range> indices;

  /// Returns the position of element `k` in world coordinates, as read.
  Eigen::Vector3d position(const GltfRecords& set, std::size_t k) const {
    return objects[set.object].to_world * set.positions.vector3(k);
  }
};

}  // namespace lapwing
