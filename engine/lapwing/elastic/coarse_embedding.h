#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/elastic/embedding_loops.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// A surface with fewer vertices in place of a region and what borders it.
struct CoarseSurface {
  std::vector<Index> kept;  ///< own vertex -> that of the fine mesh
  /// Per vertex of the fine mesh, the own vertex it went into; kNoIndex far from the region.
  std::vector<Index> owners;
  Positions rest;  ///< of its own vertices
  Topology topology;
};

/// How the vertices of a fine region go along with those of a coarse one that are near them: each
/// with up to eight rigidly, by weights that fall off smoothly (embedded deformation: Sumner,
/// Schmid, Pauly, 2007). 96 bytes a vertex.
class CoarseEmbedding {
 public:
  /// `rest` is that of the fine mesh; `coarse` must outlive the object.
  CoarseEmbedding(std::shared_ptr<const Positions> rest, const VertexSet& roi,
                  const CoarseSurface& coarse);

  /// A pose of the coarse surface: per own vertex, its displacement and how its ring has turned.
  struct Pose {
    std::vector<Eigen::Vector3d> displacement;
    std::vector<Eigen::Matrix3d> transforms;
  };

  /// Moves the fine surface, at `u` from rest, as the coarse one goes from one pose to another.
  void carry(const Pose& from, const Pose& to, std::span<Eigen::Vector3d> u) const;

  /// What forces on the fine vertices, at `u`, come to at the coarse ones in `pose`: as much for
  /// every motion of the whole surface, its turns included. One vector for each own vertex.
  std::vector<Eigen::Vector3d> gather(std::span<const Eigen::Vector3d> forces,
                                      std::span<const Eigen::Vector3d> u, const Pose& pose) const;

 private:
  void bind(Index owner, std::span<const Index> owned);

  const std::shared_ptr<const Positions> rest_;
  const CoarseSurface& coarse_;
  const EmbeddingLoops& loops_;
  std::vector<Index> vertices_;           ///< those that move, but for loose parts
  std::vector<EmbeddedVertex> embedded_;  ///< of each
  /// Coarse vertex -> kEmbeddingNodes * place in embedded_ + which of its nodes.
  Adjacency bound_to_;
  Eigen::Vector3d origin_;  ///< near the surface
};

}  // namespace lapwing
