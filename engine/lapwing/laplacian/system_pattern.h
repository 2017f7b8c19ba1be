#pragma once

#include <mutex>
#include <span>
#include <vector>

#include "lapwing/laplacian/rsi_system.h"

namespace lapwing {

/// Where the unknowns of a region meet, and the orders in which to eliminate them. The rows of M
/// and of L hold the same vertices, so M'M and L'L have one pattern.
class SystemPattern {
 public:
  SystemPattern(const Topology& topology, std::span<const Index> roi, const Unknowns& unknowns);

  const NormalPattern& normal() const { return normal_; }
  const BlockPattern& blocks() const { return normal_.blocks(); }

  /// New to old, for L'L, found fast since a preview waits for it: by minimum degree, or in a large
  /// region (above kMinimumDegreeLimit) by dissection of small clusters. Found in the first call,
  /// by whichever thread that is.
  const std::vector<int>& order() const;
  /// Whether it has been; not to be asked while another thread may be finding it.
  bool is_ordered() const { return order_.size() == blocks().size(); }
  /// The order for M'M: the same, or where the region is so large that it saves more of the
  /// factorization's 27 times as many operations than it takes, by nested dissection; found
  /// likewise.
  const std::vector<int>& thorough_order() const;

 private:
  NormalPattern normal_;
  std::vector<Index> cluster_of_;  // per unknown of a large region
  mutable std::once_flag ordered_;
  mutable std::vector<int> order_;
  mutable std::once_flag thoroughly_ordered_;
  mutable std::vector<int> thorough_order_;  // empty where it is the same
};

}  // namespace lapwing
