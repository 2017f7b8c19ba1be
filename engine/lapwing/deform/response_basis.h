#pragma once

#include <span>
#include <vector>

#include "lapwing/base/numbers.h"
#include "lapwing/base/progress.h"
#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/handle_shares.h"

namespace lapwing {

/// What pulls at the unknowns at rest where the handles ask for another scale (DESIGN section 3:
/// the s_i of the energy): the forces f of ResponseSystem. The RSI system has none.
class ScaleForces {
 public:
  ScaleForces() = default;  ///< none
  /// Of the tangent; the n x n system of `system` is held.
  ScaleForces(const EditSystem& system, const HandleShares& shares);

  /// Of motions with parameters q, to first order, where a handle's scale is the mean of its
  /// diagonal: 3 numbers per unknown, or nothing for none.
  Numbers of(std::span<const double> q) const;

 private:
  std::vector<Numbers> per_scale_;  ///< for each handle, of one more unit of its scale
  std::vector<double> radii_;       ///< of HandleFrame
};

/// How the surface answers each of the handles' parameters: columns as in ResponseColumns. The
/// 3n x 3n system of `system` is held. Stage "response" is reported, handle by handle.
Numbers response_basis(const EditSystem& system, const ScaleForces& forces,
                       const Progress& progress);

}  // namespace lapwing
