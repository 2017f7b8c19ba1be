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
  std::vector<Index> kept;  ///< coarse vertex -> vertex of the fine mesh
  /// Per vertex of the fine mesh, the coarse vertex it was merged into; kNoIndex far from the
  /// region.
  std::vector<Index> owners;
  Positions rest;  ///< of the coarse vertices
  Topology topology;
};

/// Binds each vertex of a fine region to up to eight coarse vertices near it, which it follows
/// rigidly, by weights that fall off smoothly (embedded deformation: Sumner, Schmid, Pauly, 2007).
/// 96 bytes per vertex.
class CoarseEmbedding {
 public:
  /// `rest` belongs to the fine mesh; `coarse` must outlive the object.
  CoarseEmbedding(std::shared_ptr<const Positions> rest, const VertexSet& roi,
                  const CoarseSurface& coarse);

  /// A pose of the coarse surface: per coarse vertex, its displacement and the transform T of its
  /// ring.
  struct Pose {
    std::vector<Eigen::Vector3d> displacement;
    std::vector<Eigen::Matrix3d> transforms;
  };

  /// Moves the fine surface, displaced by `u`, as the coarse one goes from one pose to another.
  void prolongate(const Pose& from, const Pose& to, std::span<Eigen::Vector3d> u) const;

  /// Restricts forces on the fine vertices, displaced by `u`, to the coarse ones in `pose`. Total
  /// force and moment are kept. Returns one vector per coarse vertex.
  std::vector<Eigen::Vector3d> restrict_forces(std::span<const Eigen::Vector3d> forces,
                                               std::span<const Eigen::Vector3d> u,
                                               const Pose& pose) const;

 private:
  void bind(Index owner, std::span<const Index> owned);

  const std::shared_ptr<const Positions> rest_;
  const CoarseSurface& coarse_;
  const EmbeddingLoops& loops_;
  std::vector<Index> vertices_;           ///< moving vertices, without loose parts
  std::vector<EmbeddedVertex> embedded_;  ///< per entry of vertices_
  /// Coarse vertex -> kEmbeddingNodes * index in embedded_ + index of its node.
  Adjacency bound_to_;
  Eigen::Vector3d origin_;  ///< a point near the surface
};

}  // namespace lapwing
