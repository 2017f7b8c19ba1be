#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "lapwing/base/once.h"
#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/solve/block_solver.h"
#include "lapwing/solve/dissection/coupling_graph.h"

namespace lapwing {

/// How `rows` of M couple the unknowns of M'M; `rings` is the mesh's.
CouplingGraph coupling_graph(const Adjacency& rings, std::span<const Index> rows,
                             const Unknowns& unknowns);

/// Where the unknowns of a region meet, and the orders in which to eliminate them. The rows of M
/// and of L hold the same vertices, so M'M and L'L have one pattern.
class SystemPattern {
 public:
  SystemPattern(const Topology& topology, std::span<const Index> roi, const Unknowns& unknowns);

  const NormalPattern& normal() const { return normal_; }
  const BlockPattern& blocks() const { return normal_.blocks(); }

  /// New to old, for L'L, found fast since a preview waits for it: by minimum degree, or in a
  /// region of more than kMinimumDegreeLimit unknowns by nested dissection. Found in the first
  /// call, by whichever thread that is.
  const std::vector<int>& order() const;
  /// Whether it has been; not to be asked while another thread may be finding it.
  bool is_ordered() const { return order_.size() == blocks().size(); }
  /// The order for M'M: the same, or that of nested dissection if its search costs less than it
  /// saves in the factorization, which takes 27 times the operations. The first call finds it.
  const std::vector<int>& thorough_order() const;
  /// The symbolic factorization of M'M in that order, which all its factors share: found when it is
  /// asked for, and kept for as long as one of them has it.
  std::shared_ptr<const SolverAnalysis> analysis() const;
  /// Whether that is there. Waits for whoever is finding it.
  bool has_analysis() const;

 private:
  NormalPattern normal_;
  mutable CouplingGraph coupling_;  // until there are orders
  mutable Once ordering_;
  mutable std::vector<int> order_;
  mutable double operations_ = 0;  // of L'L in that order, where minimum degree found it
  mutable Once thorough_ordering_;
  mutable std::vector<int> thorough_order_;  // empty where it is the same
  mutable std::mutex analyzing_;
  mutable std::weak_ptr<const SolverAnalysis> analysis_;
};

}  // namespace lapwing
