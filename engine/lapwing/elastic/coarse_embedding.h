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

  /// Returns the motion of each coarse vertex from pose `from` to pose `to`.
  std::vector<RowsOfMotion> motions(const Pose& from, const Pose& to) const;
  /// Adds to `u`, the displacements of the fine surface, the motions of the coarse vertices.
  void prolongate(std::span<const RowsOfMotion> motions, std::span<Eigen::Vector3d> u) const;

  /// Restricts forces on the fine vertices to the coarse vertices. `u` contains the fine
  /// displacements, `pose` the pose of the coarse surface. The total force and moment do not
  /// change. Returns one vector per coarse vertex.
  std::vector<Eigen::Vector3d> restrict_forces(std::span<const Eigen::Vector3d> forces,
                                               std::span<const Eigen::Vector3d> u,
                                               const Pose& pose) const;

  /// The vertices of the region that follow coarse vertices, and what each of them follows.
  const std::vector<Index>& vertices() const { return vertices_; }
  const std::vector<EmbeddedVertex>& embedded() const { return embedded_; }
  /// A point near the surface. Motions apply to coordinates relative to it, which have small
  /// rounding errors.
  const Eigen::Vector3d& origin() const { return origin_; }

 private:
  void bind(Index owner, std::span<const Index> owned);

  const std::shared_ptr<const Positions> rest_;
  const CoarseSurface& coarse_;
  const EmbeddingLoops& loops_;
  std::vector<Index> vertices_;
  std::vector<EmbeddedVertex> embedded_;  ///< per entry of vertices_
  /// For each coarse vertex, the nodes bound to it, as kEmbeddingNodes * (index in embedded_) +
  /// (index of the node).
  Adjacency bound_to_;
  Eigen::Vector3d origin_;
};

}  // namespace lapwing
