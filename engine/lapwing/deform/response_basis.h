#pragma once

#include <span>

#include "lapwing/base/numbers.h"
#include "lapwing/base/progress.h"
#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/handle_weights.h"

namespace lapwing {

/// What pulls at the unknowns at rest where the surface is asked to have another scale, s_i = 1 +
/// `growth` per vertex of the region, to first order (ENERGY.md section 3): the forces f of
/// ResponseSystem for the tangent, 3 numbers per unknown.
Numbers scale_forces(const EditSystem& system, std::span<const double> growth);

/// By how much the parameters of a handle's motion scale it to first order, less 1.
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
