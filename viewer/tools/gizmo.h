#pragma once

#include <span>
#include <vector>

#include "tools/projection.h"

namespace lapwing::viewer {

enum class GizmoMode { translate, rotate, scale };

/// What of a gizmo is taken hold of: an axis or ring, the plane without that axis, or the middle,
/// which moves across the view, turns about the line of sight, or scales all axes alike.
enum class GizmoPart { none, x, y, z, without_x, without_y, without_z, view };

/// Which axis a part is about, 0 to 2; -1 for the view and none.
int axis_of(GizmoPart part);
bool is_plane(GizmoPart part);

/// Three axes at a handle.
struct Gizmo {
  GizmoMode mode = GizmoMode::translate;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< its columns; of length 1, perpendicular
};

/// How long the arms show.
inline constexpr double kArmPt = 90.0;

/// One line of the gizmo as it shows; what can be taken hold of is what is drawn.
struct GizmoLine {
  GizmoPart part = GizmoPart::none;
  std::vector<Eigen::Vector2d> pixels;
  bool closed = false;  ///< a loop; of a plane its inside counts, too
};

/// Arms with the planes between them, or rings with only their halves that face the eye. Arms and
/// planes that point at the eye are left out. Empty where the gizmo is behind the eye. Keeps its
/// memory from one frame to the next.
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
  std::size_t count_ = 0;  // of them, those that are shown
};

/// The part within a few points of `pixel`; the nearest of several, planes last.
GizmoPart hit_gizmo(const Gizmo& gizmo, const Projection& projection, const Eigen::Vector2d& pixel);

}  // namespace lapwing::viewer
