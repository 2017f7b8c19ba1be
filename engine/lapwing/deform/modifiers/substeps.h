#pragma once

#include <optional>

#include "lapwing/deform/certificate.h"
#include "lapwing/deform/modifiers/bound_request.h"

namespace lapwing {

/// More commits than this are taken for a mistake: each prepares anew.
inline constexpr std::size_t kMostCommits = 1000;

/// The largest turn that is made at once, if any handle's turn is larger: `commit_every`, and
/// without it 90 degrees where the surface settles and a handle turns by more than
/// kLargestSettledTurnDegrees without a path, since the energy may then be less wound the other
/// way.
std::optional<double> substep_degrees(const DeformParameters& parameters, double turn_degrees,
                                      bool has_path);

/// In how many equal parts `request` is carried out: as few as keep the turn of every handle within
/// `substep_degrees`, 1 without. Throws InputError, naming `where`, above kMostCommits.
std::size_t commit_count(const DeformRequest& request);

/// One certificate for a request carried out in `parts`, from the surface `start` to `end`. Shape,
/// details, stretch and handles are measured between the two, since what the parts lose adds up; of
/// the parts come the worst residual and last step, all iterations, and settled and exact only if
/// each is. `stretch` is the rest stretch of all parts together. Throws SolverError when it does
/// not hold.
Certificate certify(const BoundRequest& bound, std::span<const Eigen::Vector3d> start,
                    std::span<const Eigen::Vector3d> end, std::span<const Certificate> parts,
                    std::span<const Eigen::Matrix3d> stretch = {});

}  // namespace lapwing
