#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "lapwing/deform/edit_system.h"
#include "lapwing/mesh/decimate.h"

namespace lapwing {

/// An edit on a surface with fewer vertices: that of another edit with some of its vertices, held
/// and moved alike. The energy approaches an integral over the surface, so that what makes it least
/// there is near what makes it least here (EnergyWeights).
struct CoarseRegion {
  std::vector<Index> kept;  ///< own vertex -> that of the fine mesh
  Topology topology;
  std::unique_ptr<PreparedRegion> prepared;
  std::unique_ptr<const EditSystem> edit;  ///< holds its n x n system
  /// Per vertex of the fine mesh, the own vertex it went into; kNoIndex far from the region.
  std::vector<Index> owners;
};

/// With about `count` vertices in the region. Null where that would leave more than half of them,
/// since too many are held one by one, or where so few hold the surface no more.
std::unique_ptr<CoarseRegion> coarse_region(const EditSystem& fine, std::size_t count);

/// How the vertices of a fine region go along with those of a coarse one that are near them: each
/// with up to eight rigidly, by weights that fall off smoothly (embedded deformation: Sumner,
/// Schmid, Pauly, 2007). 96 bytes a vertex.
class CoarseEmbedding {
 public:
  CoarseEmbedding(const EditSystem& fine, const CoarseRegion& coarse);

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
  static constexpr std::size_t kNodes = 8;
  struct Bound {
    std::array<Index, kNodes> nodes{};
    std::array<double, kNodes> weights{};  ///< 0 for those that are not there
  };
  void bind(Index owner, std::span<const Index> owned);

  const EditSystem& fine_;
  const CoarseRegion& coarse_;
  std::vector<Index> vertices_;  ///< those that move, but for loose parts
  std::vector<Bound> bounds_;    ///< of each
  Adjacency bound_to_;      ///< coarse vertex -> kNodes * place in bounds_ + which of its nodes
  Eigen::Vector3d origin_;  ///< near the surface
};

}  // namespace lapwing
