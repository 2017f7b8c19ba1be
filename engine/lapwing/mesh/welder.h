#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Merges equal positions into one vertex. Numbers vertices in order of appearance and appends each
/// new one to a list. 0 and -0 are equal; a position with a NaN equals none.
class Welder {
 public:
  /// `positions` must outlive the welder, which alone may change it. Nothing is welded to the
  /// positions that it already holds.
  explicit Welder(Positions& positions) : positions_(positions), first_(positions.size()) {}

  /// Makes room for `count` vertices.
  void reserve(std::size_t count);

  /// Returns the vertex at `position`, and adds it if it is new. Expected constant time.
  Index vertex_at(const Eigen::Vector3d& position);

 private:
  // Returns the slot of the vertex at `position`, or the free slot for it.
  std::size_t find_slot(const Eigen::Vector3d& position) const;
  void resize_table(std::size_t size);

  Positions& positions_;
  std::size_t first_;
  std::vector<Index> slots_;  // open addressing, a power of two in size, at most half full
};

/// Returns, for each position, the index of the first position exactly equal to it, which may be
/// its own. 0 equals -0. A position that is not finite equals no other. Expected linear time.
std::vector<Index> first_at_same_position(std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
