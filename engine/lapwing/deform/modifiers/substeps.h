#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/certificate.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// A request with its regions resolved. Everything it refers to must outlive it.
struct ResolvedRequest {
  const DeformRequest& request;
  const EditRegion& region;
  const Topology& topology;
  /// The handles' centroids before the request is carried out.
  std::span<const Eigen::Vector3d> centroids;

  /// Returns the motion of each handle between the shares `from` and `to` of the request.
  std::vector<Eigen::Affine3d> motions(double from, double to) const;
  /// Returns the same motions with their turns, including whole turns, and with the free handles.
  HandleMotions handle_motions(double from, double to) const;
  /// Returns the waypoints of the request's paths, in order. Empty without paths.
  std::vector<HandleMotions> path() const;
};

/// The handle of a request with the largest turn.
struct LargestTurn {
  std::size_t handle = 0;
  AxisRotation turn;  ///< degrees 0 or more
};
LargestTurn largest_turn(const DeformRequest& request);

/// More commits than this count as a mistake, since each repeats the preparation.
inline constexpr std::size_t kMostCommits = 1000;

/// Returns the largest turn of one part, which is `commit_every` if that is set. Otherwise returns
/// 90 degrees if `turn_degrees` exceeds kLargestSettledTurnDegrees and the surface does not settle
/// along a path. Beyond that turn, the energy may be lower in the other direction. Returns nothing
/// in all other cases.
std::optional<double> substep_degrees(const DeformParameters& parameters, double turn_degrees,
                                      bool has_path);

/// Returns the smallest number of equal parts of `request` that keeps the turn of every handle
/// within `substep_degrees`; 1 without that limit. Throws InputError, naming `where`, above
/// kMostCommits.
std::size_t commit_count(const DeformRequest& request);

/// One certificate for a request carried out in `parts`, from the surface `start` to `end`. Shape,
/// details, stretch and handles are measured between the two, since what the parts lose adds up.
/// Residual and last step are the worst of the parts, iterations their sum, and `settled` is true
/// only if every part settled. `stretch` is the rest stretch of all parts together. Throws
/// SolverError if the certificate does not hold.
Certificate certify(const ResolvedRequest& bound, std::span<const Eigen::Vector3d> start,
                    std::span<const Eigen::Vector3d> end, std::span<const Certificate> parts,
                    std::span<const Eigen::Matrix3d> stretch = {});

}  // namespace lapwing
