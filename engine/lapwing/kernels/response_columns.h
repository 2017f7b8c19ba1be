#pragma once

#include <cstddef>
#include <span>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A linear response of a mesh's vertices to some parameters (kernel blend_response):
///     position[v] = rest[v] + sum_k parameters[k] column_k[v]     for v in `moving`.
struct ResponseColumns {
  std::span<const Index> moving;  ///< ascending
  std::size_t count = 0;
  /// Column after column, 3 |moving| numbers each; x, y, z of moving[0] first.
  std::span<const double> numbers;
  /// If true, each column displaces along one axis, and x, y and z share their numbers. For each
  /// axis, column 12 h + 4 axis + k is column 4 h + k of `numbers`, which holds a third of the
  /// columns with |moving| numbers each. `count` must be a multiple of 12.
  bool along_axes = false;
};

}  // namespace lapwing
