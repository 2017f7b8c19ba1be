#pragma once

#include <cstddef>
#include <vector>

#include "lapwing/coating/correspondence.h"

namespace lapwing {

/// How one source was put on the target of a coat or mix.
struct CoatSourceReport {
  std::size_t vertices = 0;        ///< of the source patch
  std::vector<VertexPair> pins;    ///< the boundary pairs, given or chosen
  std::size_t flipped_source = 0;  ///< triangles that a map turned over or flattened
  std::size_t flipped_target = 0;
  int warp_steps = 0;  ///< to meet the inner pairs
  int constrained_steps = 0;
  double mean_scale = 1.0;  ///< size of the coating on the target over that on the source
};

/// What a coat or mix did.
struct CoatReport {
  std::vector<CoatSourceReport> sources;      ///< one, or two for a mix
  std::size_t vertices_before_remeshing = 0;  ///< of the target patch; 0 if it was not remeshed
  double transition_width = 0.0;
  double relative_residual = 0.0;
  double largest_displacement = 0.0;
  Index largest_displacement_vertex = kNoIndex;
};

}  // namespace lapwing
