#pragma once

#include <cstddef>
#include <span>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// How the vertices of a mesh follow some parameters linearly (kernel blend_response):
///     position[v] = rest[v] + sum_k parameters[k] column_k[v]     for v in `moving`.
struct ResponseColumns {
  std::span<const Index> moving;  ///< ascending
  std::size_t count = 0;
  /// Column after column, 3 |moving| numbers each; x, y, z of moving[0] first.
  std::span<const double> numbers;
  /// The columns displace along one axis each, x, y and z by the same numbers: column 12 h + 4 axis
  /// + k by column 4 h + k of `numbers`, which has |moving| in each, a third of the columns.
  /// `count` is a multiple of 12.
  bool along_axes = false;
};

}  // namespace lapwing
