#pragma once

#include <optional>

#include "lapwing/deform/certificate.h"
#include "lapwing/deform/modifiers/resolved_request.h"

namespace lapwing {

/// More commits than this count as a mistake, since each repeats the preparation.
inline constexpr std::size_t kMostCommits = 1000;

/// Returns the largest turn of one part: `commit_every` if that is set. Without it, 90 degrees if
/// the surface settles, no handle has a path, and one turns by more than
/// kLargestSettledTurnDegrees, since the energy may then be less in the other direction. Otherwise
/// nothing.
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
