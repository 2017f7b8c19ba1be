#pragma once

#include <span>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/numbers.h"
#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/handle_weights.h"

namespace lapwing {

/// Returns the linear response of the n x n system (L'Om L + K + W) u = W d, whose matrix is the
/// same for x, y and z. In this system, Laplacian coordinates and edges do not rotate. Each of
/// `handles` has four columns (for its coordinates x, y, z and for 1), each over the moving
/// vertices (ResponseColumns::along_axes).
Numbers laplacian_response(const EditSystem& system, std::span<const std::size_t> handles);

/// Whether the springs of an edit's targets act.
enum class Springs { pull, ignored };

/// Solves the n x n system for the `prescribed` displacements of one motion. Returns the
/// displacement of every vertex.
std::vector<Eigen::Vector3d> laplacian_displacement(const EditSystem& system,
                                                    std::span<const Eigen::Vector3d> prescribed,
                                                    Springs springs = Springs::pull);

/// Returns the forces f of ResponseSystem at rest, to first order, if each ring i is scaled by 1 +
/// `growth[i]`. `growth` has one value per vertex of the region.
Numbers scale_forces(const EditSystem& system, std::span<const double> growth);

/// Returns the mean scale of a handle's motion to first order, minus 1.
double growth_of(const HandleFrame& frame, std::span<const double> parameters);

/// Returns the linear response to each parameter of `handles`, as columns of ResponseColumns.
/// `response` is the 3n x 3n system of `system`. If `handle_weights` is null, as for the RSI
/// system, no scale forces are added. Reports the progress of stage "response" handle by handle.
Numbers response_basis(const EditSystem& system, const ResponseSystem& response,
                       std::span<const std::size_t> handles, const HandleWeights* handle_weights,
                       const Progress& progress);

/// Solves the 3n x 3n system for the `prescribed` displacements and for `forces`, which may be
/// empty. Returns the displacement of every vertex.
std::vector<Eigen::Vector3d> linear_displacement(const EditSystem& system,
                                                 const ResponseSystem& response,
                                                 std::span<const Eigen::Vector3d> prescribed,
                                                 std::span<const double> forces);

}  // namespace lapwing
