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

/// Returns the linear response to each parameter of `handles`, as columns of ResponseColumns.
/// `response` is the 3n x 3n system of `system`. If `shares` is null there are no scale forces, as
/// for the RSI system. Reports stage "response", handle by handle.
Numbers response_basis(const EditSystem& system, const ResponseSystem& response,
                       std::span<const std::size_t> handles, const HandleWeights* shares,
                       const Progress& progress);

/// Returns the displacement of every vertex for one motion, with prescribed displacements `wanted`
/// and `forces` (empty for none). Solves a single right-hand side.
std::vector<Eigen::Vector3d> linear_displacement(const EditSystem& system,
                                                 const ResponseSystem& response,
                                                 std::span<const Eigen::Vector3d> wanted,
                                                 std::span<const double> forces);

}  // namespace lapwing
