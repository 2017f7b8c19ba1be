#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tools/projection.h"

namespace lapwing::viewer {

enum class GizmoMode { translate, rotate, scale };

/// A part of a gizmo that can be dragged: an axis or ring, the plane across an axis (`without_x`),
/// or the middle, `view`. The middle moves in the view plane, turns about the line of sight, or
/// scales all axes alike.
enum class GizmoPart { none, x, y, z, without_x, without_y, without_z, view };

/// Returns the axis of an arm, ring or plane, 0 to 2; -1 for `view` and `none`.
int axis_of(GizmoPart part);
bool is_plane(GizmoPart part);
/// Returns the plane perpendicular to the axis if `plane` is true, otherwise the axis itself.
GizmoPart part_of_axis(int axis, bool plane);
/// Returns the mode for the keys W, E and Q, and nullopt for other keys.
std::optional<GizmoMode> mode_of_key(int key);

/// Three axes at a handle.
struct Gizmo {
  GizmoMode mode = GizmoMode::translate;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns are perpendicular unit vectors
};

/// Length of an arm in points.
inline constexpr double kArmPt = 90.0;

/// One line of the gizmo on the screen. Picking uses the same lines as drawing.
struct GizmoLine {
  GizmoPart part = GizmoPart::none;
  std::vector<Eigen::Vector2d> pixels;
  bool closed = false;  ///< a loop; a plane can also be picked inside it
};

/// Computes the lines of a gizmo on the screen: arms with the planes between them, or the halves of
/// the rings that face the camera. Omits arms that are parallel to the line of sight and planes
/// that are seen edge-on. There are no lines if the gizmo is behind the camera. Reuses its memory
/// in later frames.
class GizmoLines {
 public:
  GizmoLines() = default;
  GizmoLines(const Gizmo& gizmo, const Projection& projection) { renew(gizmo, projection); }

  void renew(const Gizmo& gizmo, const Projection& projection);
  std::span<const GizmoLine> lines() const { return std::span(lines_).first(count_); }

 private:
  GizmoLine& begin(GizmoPart part, bool closed);
  template <typename PointAt>
  void add(GizmoPart part, bool closed, int points, const Projection& projection,
           const PointAt& point_at);
  void add_circle(const Eigen::Vector2d& center, double radius);
  void add_rings(const Gizmo& gizmo, double arm, const Projection& projection);
  void add_arms(const Gizmo& gizmo, double arm, const Projection& projection);

  std::vector<GizmoLine> lines_;
  std::size_t count_ = 0;  // number of lines_ in use
};

/// Returns the part within a few points of `pixel`. The nearest arm or ring goes before a plane.
GizmoPart hit_gizmo(const Gizmo& gizmo, const Projection& projection, const Eigen::Vector2d& pixel);

}  // namespace lapwing::viewer
