#pragma once

#include <memory>
#include <span>

#include "lapwing/deform/drag.h"

namespace lapwing::test {

/// Returns the positions of one drag frame, which the CPU computes.
inline Positions dragged(const std::shared_ptr<const DragResponse>& response,
                         std::span<const Eigen::Affine3d> motions,
                         const std::shared_ptr<const DragState>& from = nullptr) {
  Positions positions = response->rest();
  Drag(response, from).move(motions, positions);
  return positions;
}

}  // namespace lapwing::test
