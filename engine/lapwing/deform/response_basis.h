#pragma once

#include <span>

#include "lapwing/base/numbers.h"
#include "lapwing/base/progress.h"
#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/handle_weights.h"

namespace lapwing {

/// Returns the forces on the unknowns at rest, to first order, if ring i grows by the factor 1 +
/// `growth`_i, per vertex of the region: f of ResponseSystem for the tangent, 3 numbers per
/// unknown.
Numbers scale_forces(const EditSystem& system, std::span<const double> growth);

/// Returns the mean scale of a handle's motion to first order, minus 1.
double growth_of(const HandleFrame& frame, std::span<const double> parameters);

/// How the surface answers each parameter of `handles`: columns as in ResponseColumns. `response`
/// is the 3n x 3n system of `system`. `shares` null: no scale forces, as the RSI system has it.
/// Stage "response" is reported, handle by handle.
Numbers response_basis(const EditSystem& system, const ResponseSystem& response,
                       std::span<const std::size_t> handles, const HandleWeights* shares,
                       const Progress& progress);

/// The same for one motion, whose parameters ask for `wanted` and `forces` (empty for none): the
/// displacement of every vertex, by a single right-hand side.
std::vector<Eigen::Vector3d> linear_displacement(const EditSystem& system,
                                                 const ResponseSystem& response,
                                                 std::span<const Eigen::Vector3d> wanted,
                                                 std::span<const double> forces);

}  // namespace lapwing
