#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/elastic/embedding_loops.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// A surface with fewer vertices that replaces a region and its border.
struct CoarseSurface {
  std::vector<Index> kept;  ///< for each coarse vertex, the same vertex in the fine mesh
  /// For each vertex of the fine mesh, the coarse vertex that it was merged into; kNoIndex if the
  /// vertex is far from the region.
  std::vector<Index> owners;
  Positions rest;  ///< rest positions of the coarse vertices
  Topology topology;
};

/// Binds each vertex of a fine region to up to eight nearby coarse vertices. The vertex moves by
/// the weighted sum of their affine motions; the weights fall off smoothly (embedded deformation:
/// Sumner, Schmid, Pauly 2007). Needs 96 bytes per vertex.
class CoarseEmbedding {
 public:
  /// `rest` holds the rest positions of the fine mesh. `coarse` must outlive the object.
  CoarseEmbedding(std::shared_ptr<const Positions> rest, const VertexSet& roi,
                  const CoarseSurface& coarse);

  /// A pose of the coarse surface: for each coarse vertex, its displacement and the transform T_i
  /// of its ring.
  struct Pose {
    std::vector<Eigen::Vector3d> displacement;
    std::vector<Eigen::Matrix3d> transforms;
  };

  /// Adds to `u`, the displacements of the fine surface, the motion of the coarse surface from pose
  /// `from` to pose `to`.
  void prolongate(const Pose& from, const Pose& to, std::span<Eigen::Vector3d> u) const;

  /// Restricts forces on the fine vertices to the coarse vertices. `u` contains the fine
  /// displacements, `pose` the pose of the coarse surface. The total force and moment do not
  /// change. Returns one vector per coarse vertex.
  std::vector<Eigen::Vector3d> restrict_forces(std::span<const Eigen::Vector3d> forces,
                                               std::span<const Eigen::Vector3d> u,
                                               const Pose& pose) const;

 private:
  void bind(Index owner, std::span<const Index> owned);

  const std::shared_ptr<const Positions> rest_;
  const CoarseSurface& coarse_;
  const EmbeddingLoops& loops_;
  std::vector<Index> vertices_;           ///< vertices of the region that have an owner
  std::vector<EmbeddedVertex> embedded_;  ///< per entry of vertices_
  /// For each coarse vertex, the nodes bound to it, as kEmbeddingNodes * (index in embedded_) +
  /// (index of the node).
  Adjacency bound_to_;
  /// A point near the surface; coordinates relative to it have small rounding errors.
  Eigen::Vector3d origin_;
};

}  // namespace lapwing
