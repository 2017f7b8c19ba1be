#pragma once

#include <span>
#include <string>

#include <Eigen/Geometry>

namespace lapwing {

/// Options of `fit_loop`.
struct LoopFit {
  double rotate_degrees = 0.0;  ///< about the hole's normal, after the fit; right-handed
  double scale = 1.0;           ///< about the hole's centre, after the fit; above 0
  bool keep_size = false;       ///< do not scale the part to the hole
  bool operator==(const LoopFit&) const = default;
};

/// Returns the similarity that maps `part` onto the hole with the loop `host`. Both are boundary
/// loops in order, with their surface on the left. The placed part stands on the side that the
/// host's normals point to, so that the loops run in opposite directions, ready to be joined. The
/// map never mirrors.
///
/// The fit maps centre to centre and radius to radius (LoopFrame), both integrals over the length,
/// so that the vertex counts may differ. For every starting point along the loop, points spread
/// evenly over both loops give a least-squares rotation (Umeyama 1991). The closest fit wins. If
/// several are about as close, as for a loop with symmetries, the one nearest to the least rotation
/// that aligns the loops' normals wins. If the loops are so round that no start is better, the
/// result is that rotation. Takes a few milliseconds.
///
/// Throws InputError, naming `where`, if a loop has fewer than 3 points, a point that is not finite
/// or all points on a line, if the scale is not above 0 or the rotation is not finite, and for
/// `keep_size` with a scale other than 1.
Eigen::Affine3d fit_loop(std::span<const Eigen::Vector3d> part,
                         std::span<const Eigen::Vector3d> host, const LoopFit& fit,
                         const std::string& where);

}  // namespace lapwing
