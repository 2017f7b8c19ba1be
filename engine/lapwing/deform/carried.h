#pragma once

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

/// Carries points of space along with the surface that `deform` moved: a hat, a point cloud.
///
/// The contacts of a point p are the closest points x_k of the triangles that are hardly farther
/// from it than the nearest one: within a band of kCarryBand times its distance, at most
/// kWidestCarryBand of the surface's diagonal. The triangles count by area and by closeness, down
/// to none at the edge of the band. With x, x', R and s the means over the contacts of place before
/// and after, rotation (VertexMotion) and the scale that the handles ask for,
///
///     p' = x' + s R (p - x)
///
/// So a point on the surface stays on it, what moves rigidly carries rigidly, and p' depends on p
/// continuously, also half way between two parts of the surface. Points whose contacts did not move
/// keep their bits.
class SurfaceCarrier {
 public:
  /// `rest` are the positions before `deformed`; both must outlive the object. O(n log n). Throws
  /// InputError for a mesh without triangles.
  SurfaceCarrier(std::span<const Eigen::Vector3d> rest, const Deformed& deformed);

  /// On all processors, O(log n) for a point near the surface; one farther than a few of its
  /// features has many contacts. Positions must be finite.
  CarriedPoints carry(std::span<const Eigen::Vector3d> points) const;

 private:
  struct Contact {
    TrianglePoint place;
    double weight = 0.0;
  };

  std::vector<Contact> contacts_of(const Eigen::Vector3d& point, Index& hint) const;
  bool is_still(std::span<const Contact> contacts) const;
  void carry(const Eigen::Vector3d& point, Index& hint, Eigen::Vector3d& position,
             Eigen::Quaterniond& rotation) const;

  std::span<const Eigen::Vector3d> rest_;
  const Deformed& deformed_;
  const Topology& topology_;
  VertexMotion motion_;
  std::vector<double> areas_;  ///< of the triangles at rest, times two
  double widest_band_ = 0.0;
  ClosestPoint surface_;
};

/// The same for one use: carry_points(hat.positions, head.positions, deformed).
CarriedPoints carry_points(std::span<const Eigen::Vector3d> points,
                           std::span<const Eigen::Vector3d> rest, const Deformed& deformed);

/// Wide enough that what hangs over a fold is not torn, narrow enough that a point follows what is
/// under it.
inline constexpr double kCarryBand = 0.5;
inline constexpr double kWidestCarryBand = 0.02;

}  // namespace lapwing
