#pragma once

#include <mutex>
#include <span>
#include <vector>

#include "lapwing/laplacian/rsi_system.h"

namespace lapwing {

/// Where the unknowns of a region meet, and the order in which to eliminate them: one for M'M and
/// for L'L, since their rows hold the same vertices.
class SystemPattern {
 public:
  SystemPattern(const Topology& topology, std::span<const Index> roi, const Unknowns& unknowns);

  const NormalPattern& normal() const { return normal_; }
  const BlockPattern& blocks() const { return normal_.blocks(); }

  /// New to old. Found in the first call, by whichever thread that is.
  const std::vector<int>& order() const;
  /// Whether it has been; not to be asked while another thread may be finding it.
  bool is_ordered() const { return order_.size() == blocks().size(); }

 private:
  NormalPattern normal_;
  mutable std::once_flag ordered_;
  mutable std::vector<int> order_;
};

}  // namespace lapwing
