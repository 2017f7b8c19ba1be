#pragma once

#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Gives equal positions one vertex: numbers vertices in order of appearance and appends each new
/// one to a list. 0 and -0 are equal; a position with a NaN equals none.
class Welder {
 public:
  /// `positions` outlives the welder and is changed by it alone. Those that are there already are
  /// no vertices of its own: nothing is welded to them.
  explicit Welder(Positions& positions) : positions_(positions), first_(positions.size()) {}

  /// Makes room for `count` vertices.
  void reserve(std::size_t count);

  /// Expected constant time.
  Index vertex_at(const Eigen::Vector3d& position);

 private:
  // Where the position's vertex is, or the free slot where it would go.
  std::size_t find_slot(const Eigen::Vector3d& position) const;
  void resize_table(std::size_t size);

  Positions& positions_;
  std::size_t first_;
  std::vector<Index> slots_;  // open addressing, a power of two in size, at most half full
};

}  // namespace lapwing
