#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/deform.h"
#include "lapwing/deform/vertex_motion.h"
#include "lapwing/mesh/closest_point.h"

namespace lapwing {

/// The new positions of points that follow a surface.
struct CarriedPoints {
  Positions positions;
  /// Rotations of the surface at the points, with w >= 0, for directions attached to them. Exactly
  /// the identity for a point that did not move.
  std::vector<Eigen::Quaterniond> rotations;
};

/// The weight by which a point follows a vertex.
struct CarryShare {
  Index vertex = 0;
  double share = 0.0;
};

/// The shares of several points, in compressed rows. The shares of each point sum to 1.
struct CarryShares {
  std::vector<std::size_t> starts{0};
  std::vector<CarryShare> values;

  std::span<const CarryShare> operator[](std::size_t point) const {
    return std::span(values).subspan(starts[point], starts[point + 1] - starts[point]);
  }
};

/// Finds the vertices of a surface at rest that points around it follow.
///
/// On each triangle near a point, the contact is the triangle's closest point. Contacts count if
/// they are at most a band width farther away than the nearest contact. The band width is
/// kCarryBand times the distance of the nearest contact, but at most kWidestCarryBand times the
/// surface's diagonal. A contact's weight depends on area and distance. It decreases to 0 at the
/// far edge of the band.
class SurfaceContacts {
 public:
  /// `rest` and `topology` must outlive the object. Takes O(n log n). Throws InputError for a mesh
  /// without triangles.
  SurfaceContacts(std::span<const Eigen::Vector3d> rest, const Topology& topology);

  /// Sets `shares` to the shares of one finite point, in ascending order of vertices. Takes O(log
  /// n) near the surface. `hint` speeds up the search. Pass kNoIndex in the first call, and later
  /// the value that the last call for a nearby point has set.
  void find(const Eigen::Vector3d& point, Index& hint, std::vector<CarryShare>& shares) const;

  /// Returns the shares of all points, computed on all CPU cores. Returns nothing if there are more
  /// than `most` shares, which take 16 bytes each.
  std::optional<CarryShares> find_all(std::span<const Eigen::Vector3d> points,
                                      std::size_t most) const;

  std::span<const Eigen::Vector3d> rest() const { return rest_; }

 private:
  std::span<const Eigen::Vector3d> rest_;
  const Topology& topology_;
  std::vector<double> areas_;  ///< twice the area of each triangle
  double widest_band_ = 0.0;
  ClosestPoint surface_;
};

/// Moves points, such as a hat or a point cloud, with a surface that `deform` moved. Let x, x', R
/// and S be the weighted means of rest position, new position, rotation (VertexMotion) and rest
/// stretch over the contacts of a point p. Then
///     p' = x' + R S (p - x).
/// Points on the surface remain on it, and p' is continuous in p. Points whose contacts did not
/// move do not move either, exactly.
class AttachmentDeformer {
 public:
  /// `rest` are the positions before the deformation; `rest` and `deformed` must outlive the
  /// object. Takes O(n log n). Throws InputError for a mesh without triangles.
  AttachmentDeformer(std::span<const Eigen::Vector3d> rest, const Deformed& deformed);
  /// Uses `contacts`, which several deformations of one surface can share, for example in a drag.
  AttachmentDeformer(std::shared_ptr<const SurfaceContacts> contacts, const Deformed& deformed);

  /// Moves `points`, using all CPU cores. Positions must be finite.
  CarriedPoints carry(std::span<const Eigen::Vector3d> points) const;
  /// Like `carry` above, for known shares of the points; results are bitwise identical. Takes time
  /// linear in the number of shares.
  CarriedPoints carry(std::span<const Eigen::Vector3d> points, const CarryShares& shares) const;

 private:
  bool is_still(std::span<const CarryShare> shares) const;
  void carry(const Eigen::Vector3d& point, std::span<const CarryShare> shares,
             Eigen::Vector3d& position, Eigen::Quaterniond& rotation) const;

  std::shared_ptr<const SurfaceContacts> contacts_;
  const Deformed& deformed_;
  VertexMotion motion_;
};

/// Moves points with a single deformation, for example carry_points(hat.positions, head.positions,
/// deformed).
CarriedPoints carry_points(std::span<const Eigen::Vector3d> points,
                           std::span<const Eigen::Vector3d> rest, const Deformed& deformed);

/// Band widths of SurfaceContacts. Wider bands keep points over a fold together; with narrower
/// bands, a point follows the surface directly below it.
inline constexpr double kCarryBand = 0.5;
inline constexpr double kWidestCarryBand = 0.02;

}  // namespace lapwing
