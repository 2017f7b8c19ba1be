#pragma once

#include <span>
#include <string>

#include <Eigen/Geometry>

namespace lapwing {

/// How a part is placed by itself.
struct LoopFit {
  double rotate_degrees = 0.0;  ///< about the hole's normal, after the fit; right-handed
  double scale = 1.0;           ///< of the part, after the fit
  bool keep_size = false;       ///< the part is not scaled to the hole
  bool operator==(const LoopFit&) const = default;
};

/// The similarity that takes `part`, a boundary loop in order with its surface on its left, onto
/// the hole whose loop is `host` likewise, so that the loops run against each other as those of two
/// surfaces that are to be joined do, and the part stands on the side that the host's normals point
/// to. Points are spread evenly over both loops, by length; of all turns along the loop the one of
/// least squares is taken (Umeyama 1991 for each), finely searched, so that the counts may differ.
/// Where the loops are round, so that no turn is better than another by a hundredth, the least turn
/// about the normal. Then it moves along the normal, or not, so that the mean of the loop is on the
/// host's. Never mirrors. Throws InputError, naming `where`, for a loop of fewer than 3 points, one
/// that is not finite, and one whose points are on a line.
Eigen::Affine3d fit_loop(std::span<const Eigen::Vector3d> part,
                         std::span<const Eigen::Vector3d> host, const LoopFit& fit,
                         const std::string& where);

}  // namespace lapwing
