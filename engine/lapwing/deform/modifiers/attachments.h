#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/closest/closest_point.h"
#include "lapwing/deform/deform.h"
#include "lapwing/deform/vertex_motion.h"

namespace lapwing {

/// Where points that follow a surface came to.
struct CarriedPoints {
  Positions positions;
  /// By which the surface turned there, w >= 0: what a point points at turns along. Exactly the
  /// identity for a point that stayed.
  std::vector<Eigen::Quaterniond> rotations;
};

/// By how much a point follows a vertex.
struct CarryShare {
  Index vertex = 0;
  double share = 0.0;
};

/// What each of some points follows, in compressed rows; the shares of a row sum to 1.
struct CarryShares {
  std::vector<std::size_t> starts{0};
  std::vector<CarryShare> values;

  std::span<const CarryShare> operator[](std::size_t point) const {
    return std::span(values).subspan(starts[point], starts[point + 1] - starts[point]);
  }
};

/// Which vertices of a surface at rest the points around it follow.
///
/// The contacts of a point p are the closest points x_k of the triangles that are hardly farther
/// from it than the nearest one: within a band of kCarryBand times its distance, at most
/// kWidestCarryBand of the surface's diagonal. The triangles count by area and by closeness, down
/// to none at the edge of the band; the share of a vertex is what it has of all contacts.
class SurfaceContacts {
 public:
  /// Both must outlive the object. O(n log n). Throws InputError for a mesh without triangles.
  SurfaceContacts(std::span<const Eigen::Vector3d> rest, const Topology& topology);

  /// Of one point, ascending by vertex; replaces `shares`. O(log n) for a point near the surface;
  /// one farther than a few of its features has many contacts. The position must be finite.
  /// `hint` of the last search close by, kNoIndex at first, makes it quicker.
  void find(const Eigen::Vector3d& point, Index& hint, std::vector<CarryShare>& shares) const;

  /// Of all, on all processors; nothing where they are more than `most`, of 16 bytes each.
  std::optional<CarryShares> find_all(std::span<const Eigen::Vector3d> points,
                                      std::size_t most) const;

  std::span<const Eigen::Vector3d> rest() const { return rest_; }

 private:
  std::span<const Eigen::Vector3d> rest_;
  const Topology& topology_;
  std::vector<double> areas_;  ///< of the triangles, times two
  double widest_band_ = 0.0;
  ClosestPoint surface_;
};

/// Carries points of space along with the surface that `deform` moved: a hat, a point cloud. Let x,
/// x', R and S be the weighted means of rest position, new position, rotation (VertexMotion) and
/// rest stretch over the contacts of a point p (SurfaceContacts). Then
///
///     p' = x' + R S (p - x)
///
/// A point on the surface stays on it. Where the surface moves rigidly, so do the points. p' is a
/// continuous function of p, also half way between two parts of the surface. Points whose contacts
/// did not move keep their bits.
class SurfaceCarrier {
 public:
  /// `rest` are the positions before `deformed`; both must outlive the object. O(n log n). Throws
  /// InputError for a mesh without triangles.
  SurfaceCarrier(std::span<const Eigen::Vector3d> rest, const Deformed& deformed);
  /// The same where the contacts with the surface at rest are kept from one deform of it to the
  /// next, as in a drag. Linear in the region.
  SurfaceCarrier(std::shared_ptr<const SurfaceContacts> contacts, const Deformed& deformed);

  /// On all processors. Positions must be finite.
  CarriedPoints carry(std::span<const Eigen::Vector3d> points) const;
  /// The same bits where the shares of the points are known. Linear in these.
  CarriedPoints carry(std::span<const Eigen::Vector3d> points, const CarryShares& shares) const;

 private:
  bool is_still(std::span<const CarryShare> shares) const;
  void carry(const Eigen::Vector3d& point, std::span<const CarryShare> shares,
             Eigen::Vector3d& position, Eigen::Quaterniond& rotation) const;

  std::shared_ptr<const SurfaceContacts> contacts_;
  const Deformed& deformed_;
  VertexMotion motion_;
};

/// The same for one use: carry_points(hat.positions, head.positions, deformed).
CarriedPoints carry_points(std::span<const Eigen::Vector3d> points,
                           std::span<const Eigen::Vector3d> rest, const Deformed& deformed);

/// Wide enough that what hangs over a fold is not torn, narrow enough that a point follows what is
/// under it.
inline constexpr double kCarryBand = 0.5;
inline constexpr double kWidestCarryBand = 0.02;

}  // namespace lapwing
