#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "lapwing/deform/move.h"
#include "tools/gizmo.h"

namespace lapwing::viewer {

/// To what steps a drag keeps while it snaps; above 0.
struct SnapSteps {
  double length = 0.1;
  double degrees = 15.0;
  double factor = 0.1;
};

/// A length of 1, 2 or 5 times a power of ten that shows as about a tenth of the gizmo's arm.
double snap_length(const Gizmo& gizmo, const Projection& projection);

/// How far a part of a gizmo was dragged; only what its mode speaks of counts.
struct GizmoAmount {
  Eigen::Vector3d lengths = Eigen::Vector3d::Zero();  ///< along the gizmo's axes
  double degrees = 0.0;                               ///< whole turns included
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();  ///< along the gizmo's axes; above 0

  bool operator==(const GizmoAmount&) const = default;
};

/// A part of a gizmo taken hold of. The camera stays while it is dragged.
class GizmoDrag {
 public:
  GizmoDrag(const Gizmo& gizmo, GizmoPart part, const Projection& projection,
            const Eigen::Vector2d& start);

  /// The cursor is at `pixel` now. Turns add up over whole turns as long as the cursor goes less
  /// than half of one at a time.
  void move_to(const Eigen::Vector2d& pixel);

  /// Moved, the gizmo's centre goes to `place`, as far as the part lets it.
  void move_center_to(const Eigen::Vector3d& place);

  GizmoPart part() const { return part_; }
  GizmoMode mode() const { return gizmo_.mode; }

  /// How far it is: as dragged, in whole `snap` steps if there are some, or by a number typed (a
  /// length along each axis of the part, degrees, or a factor), which goes before both.
  GizmoAmount amount(const std::optional<SnapSteps>& snap = {},
                     const std::optional<double>& typed = {}) const;

  /// The map of space for an amount: about the gizmo's centre.
  Eigen::Affine3d motion(const GizmoAmount& amount) const;

  /// The move of a handle at rest that was moved by `before` and is dragged by `amount` now, with
  /// the whole turn by which that comes about. Bit for bit `before` where it is dragged by nothing.
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
