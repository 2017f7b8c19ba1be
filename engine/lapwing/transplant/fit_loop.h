#pragma once

#include <span>
#include <string>

#include <Eigen/Geometry>

namespace lapwing {

struct LoopFit {
  double rotate_degrees = 0.0;  ///< about the hole's normal, after the fit; right-handed
  double scale = 1.0;           ///< about the hole's centre, after the fit; positive
  bool keep_size = false;       ///< whether the fit must not scale the part
  bool operator==(const LoopFit&) const = default;
};

/// Returns the similarity transform, never a reflection, that maps the loop `part` onto the hole
/// with the loop `host`. Both are boundary loops in order, with their surface on the left. The
/// placed part is on the side to which the host's normals point, so the loops have opposite
/// directions, as joining requires.
///
/// The transform maps centre to centre and radius to radius (LoopFrame). For many starting points
/// on the host's loop, a least-squares rotation aligns evenly spaced points of both loops (Umeyama
/// 1991), and the best fit is chosen. If several fits are about equally good, as for symmetric
/// loops, the one nearest to the smallest rotation that aligns the loops' normals is chosen. For
/// round loops, the result is this smallest rotation. Takes a few milliseconds.
///
/// Throws InputError, naming `where`, if a loop has fewer than 3 points, a point that is not finite
/// or all points on a line, unless the scale is positive and the rotation finite, and for
/// `keep_size` with a scale other than 1.
Eigen::Affine3d fit_loop(std::span<const Eigen::Vector3d> part,
                         std::span<const Eigen::Vector3d> host, const LoopFit& fit,
                         const std::string& where);

}  // namespace lapwing
