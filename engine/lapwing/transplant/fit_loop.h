#pragma once

#include <span>
#include <string>

#include <Eigen/Geometry>

namespace lapwing {

/// How a part is placed by itself.
struct LoopFit {
  double rotate_degrees = 0.0;  ///< about the hole's normal, after the fit; right-handed
  double scale = 1.0;           ///< of the part about the hole's centre, after the fit; above 0
  bool keep_size = false;       ///< the part is not scaled at all
  bool operator==(const LoopFit&) const = default;
};

/// The similarity that takes `part`, a boundary loop in order with its surface on its left, onto
/// the hole whose loop is `host` likewise, so that the loops run against each other as those of two
/// surfaces that are to be joined do, and the part stands on the side that the host's normals point
/// to. Never mirrors.
///
/// Centre goes to centre, and radius to radius (see LoopFrame; both by length, so that the counts
/// may differ). Of all starting points along the loop the one is taken from which the rotation of
/// least squares between points spread evenly over both loops (Umeyama 1991) leaves them closest.
/// Where several fit as well, as of a loop with symmetries, the one nearest to the least rotation
/// that makes the loops' normals agree; and that rotation itself where the loops are so round that
/// no start is better than another. A few milliseconds.
///
/// Throws InputError, naming `where`, for a loop of fewer than 3 points, one that is not finite,
/// one whose points are on a line, and for a scale that is not above 0 or a turn that is not
/// finite, and for both a scale other than 1 and `keep_size`.
Eigen::Affine3d fit_loop(std::span<const Eigen::Vector3d> part,
                         std::span<const Eigen::Vector3d> host, const LoopFit& fit,
                         const std::string& where);

}  // namespace lapwing
