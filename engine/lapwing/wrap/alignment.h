#pragma once

#include <span>

#include <Eigen/Geometry>

#include "lapwing/wrap/scan_surface.h"

namespace lapwing {

/// How a similarity was found.
enum class AlignmentMethod {
  none,       ///< the surfaces are already in place
  landmarks,  ///< least squares over pairs of points (Umeyama 1991)
  surfaces,   ///< principal axes, then iterative closest points
};

/// A similarity transformation that aligns a surface with a scan.
struct Alignment {
  AlignmentMethod method = AlignmentMethod::none;
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  double scale = 1.0;  ///< of `map`
  /// The pose from which the surface is deformed: an affine map near `map` that fits better, or
  /// `map`.
  Eigen::Affine3d start = Eigen::Affine3d::Identity();
  /// For the method `surfaces`: the mean distance between the surfaces after the map `start`,
  /// without the farthest fifth, over the scan's diagonal.
  double mean_distance = 0.0;
};

/// Returns the similarity that minimizes the squared distances of `to` from the mapped `from`. Its
/// rotation is never a reflection. Throws InputError unless each side contains three points that
/// are not on one line.
Alignment align_points(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to);

/// Returns a similarity transformation that aligns `surface` with `scan`. Tries all 24 rotations
/// that map principal axes to principal axes. From each, it iterates closest points (Besl and McKay
/// 1992) with samples of both surfaces, and leaves out the farthest fifth. An affine map is then
/// fitted in the same way. With similarities alone, a bent or stretched surface can fit no better
/// in the right orientation than in a wrong one. Returns the result from the start whose affine map
/// has the smallest mean distance. A symmetric surface may be aligned in the wrong orientation.
/// Throws InputError if no start succeeds, and Cancelled.
Alignment align_surfaces(const ScanSurface& surface, const ScanSurface& scan);

}  // namespace lapwing
