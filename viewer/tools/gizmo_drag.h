#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "lapwing/deform/move.h"
#include "tools/gizmo.h"

namespace lapwing::viewer {

/// Steps to which a drag snaps; all positive.
struct SnapSteps {
  double length = 0.1;
  double degrees = 15.0;
  double factor = 0.1;
};

/// Returns 1, 2 or 5 times a power of ten that shows as about a tenth of the gizmo's arm.
double snap_length(const Gizmo& gizmo, const Projection& projection);

/// How far a part of a gizmo was dragged. Only the member for the gizmo's mode counts.
struct GizmoAmount {
  Eigen::Vector3d lengths = Eigen::Vector3d::Zero();  ///< along the gizmo's axes
  double degrees = 0.0;                               ///< whole turns included
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();  ///< along the gizmo's axes; above 0

  bool operator==(const GizmoAmount&) const = default;
};

/// A drag of one part of a gizmo. The camera must not move during the drag.
class GizmoDrag {
 public:
  GizmoDrag(const Gizmo& gizmo, GizmoPart part, const Projection& projection,
            const Eigen::Vector2d& start);

  /// Moves the cursor to `pixel`. Turns add up past 360 degrees, as long as one call turns by less
  /// than 180.
  void move_to(const Eigen::Vector2d& pixel);

  /// Moves the gizmo's centre to `place`, as far as the part allows.
  void move_center_to(const Eigen::Vector3d& place);

  GizmoPart part() const { return part_; }
  GizmoMode mode() const { return gizmo_.mode; }

  /// Returns the amount of the drag, rounded to the steps of `snap`. A number `typed` replaces it:
  /// a length along each axis of the part, degrees, or a factor.
  GizmoAmount amount(const std::optional<SnapSteps>& snap = {},
                     const std::optional<double>& typed = {}) const;

  /// Returns the affine map for an amount, about the gizmo's centre.
  Eigen::Affine3d motion(const GizmoAmount& amount) const;

  /// Returns the handle's move from rest: `before`, followed by a drag of `amount`. Its angle
  /// includes whole turns. Returns exactly `before` if `amount` is none.
  Move move_after(const Move& before, const Eigen::Vector3d& handle_centroid,
                  const GizmoAmount& amount) const;

 private:
  Eigen::Vector3d axis() const;
  Eigen::Vector3d point_on_part(const Eigen::Vector2d& pixel) const;
  double angle_at(const Eigen::Vector2d& pixel) const;
  double factor_at(const Eigen::Vector2d& pixel) const;
  Eigen::Array3d moved_axes() const;

  Gizmo gizmo_;
  GizmoPart part_;
  Projection projection_;
  Eigen::Vector3d toward_eye_;
  Eigen::Vector2d start_;
  Eigen::Vector2d center_pixel_;
  Eigen::Vector2d last_;
  GizmoAmount dragged_;
};

}  // namespace lapwing::viewer
