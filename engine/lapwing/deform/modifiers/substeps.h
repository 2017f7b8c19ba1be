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

/// A request with its resolved regions. The referenced objects must outlive it.
struct ResolvedRequest {
  const DeformRequest& request;
  const EditRegion& region;
  const Topology& topology;
  /// The centroids of the handles before the deformation.
  std::span<const Eigen::Vector3d> centroids;

  /// Returns the motion of each handle between the fractions `from` and `to` (0 to 1) of its move.
  std::vector<Eigen::Affine3d> motions(double from, double to) const;
  /// Like `motions`, but also returns the turns (including whole turns) and the list of free
  /// handles.
  HandleMotions handle_motions(double from, double to) const;
  /// Returns the waypoints of the request's paths, in order. Returns an empty list if there are no
  /// paths.
  std::vector<HandleMotions> path() const;
};

/// The handle of a request with the largest turn.
struct LargestTurn {
  std::size_t handle = 0;
  AxisRotation turn;  ///< 0 degrees or more
};
LargestTurn largest_turn(const DeformRequest& request);

/// The largest number of substeps. More are rejected as a mistake, because each substep repeats the
/// preparation.
inline constexpr std::size_t kMostCommits = 1000;

/// Returns the largest turn of one substep, which is `commit_every` if that is set. Otherwise
/// returns 90 degrees if `turn_degrees` exceeds kLargestSettledTurnDegrees, because the energy may
/// then be lower for a turn in the other direction. Returns nothing for smaller turns, and if the
/// surface settles along a path.
std::optional<double> substep_degrees(const DeformParameters& parameters, double turn_degrees,
                                      bool has_path);

/// Returns the smallest number of equal substeps in which no handle turns by more than
/// `substep_degrees`, or 1 if there is no such limit. Throws InputError if the number exceeds
/// kMostCommits.
std::size_t commit_count(const DeformRequest& request);

/// Returns one certificate for a request carried out in substeps `parts`, from the surface `start`
/// to `end`. Shape, details, stretch and handle errors are measured between these two surfaces,
/// because the errors of the substeps add up. Residual and last step are the maxima over all
/// substeps. The number of iterations is their sum, and `settled` is true only if every substep
/// settled. `stretch` is the rest stretch of all substeps together. Throws SolverError if the
/// certificate does not hold.
Certificate certify(const ResolvedRequest& bound, std::span<const Eigen::Vector3d> start,
                    std::span<const Eigen::Vector3d> end, std::span<const Certificate> parts,
                    std::span<const Eigen::Matrix3d> stretch = {});

}  // namespace lapwing
