#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "lapwing/base/parallel.h"
#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/solve/block_solver.h"
#include "lapwing/solve/dissection/order_choice.h"

namespace lapwing {

/// Returns the graph of the rows `rows` of M, which couple the unknowns of M'M. `rings` are the
/// rings of the whole mesh.
CouplingGraph coupling_graph(const Adjacency& rings, std::span<const Index> rows,
                             const Unknowns& unknowns);

/// The pattern of a region's normal matrices and their elimination orders. The rows of M and L
/// contain the same vertices, so M'M and L'L have the same pattern.
class SystemPattern {
 public:
  SystemPattern(const Topology& topology, std::span<const Index> roi, const Unknowns& unknowns);

  const NormalPattern& normal() const { return normal_; }
  const BlockPattern& blocks() const { return normal_.blocks(); }

  /// Returns the elimination order for L'L, new to old (`quick_order`). The first call computes it,
  /// on any thread.
  const std::vector<int>& order() const { return quick().order; }
  /// Returns true if `order` has been computed. Do not call this while another thread may compute
  /// it.
  bool is_ordered() const { return quick_.order.size() == blocks().size(); }
  /// Returns the elimination order for M'M: `thorough_order` if it saves more time than it takes,
  /// otherwise `order()`. The first call computes it.
  const std::vector<int>& factorization_order() const;
  /// Returns the symbolic factorization of M'M in `factorization_order`, which all factors share.
  /// It is computed on demand, and cached while a factor uses it.
  std::shared_ptr<const SolverAnalysis> analysis() const;
  /// Returns true if the symbolic factorization is cached. Waits if another thread is computing it.
  bool has_analysis() const;

 private:
  const EliminationOrder& quick() const;

  NormalPattern normal_;
  mutable CouplingGraph coupling_;  // cleared when both orders are known
  mutable Once ordering_;
  mutable EliminationOrder quick_;
  mutable Once thorough_ordering_;
  mutable std::vector<int> thorough_;  // empty if it equals `order()`
  mutable std::mutex analyzing_;
  mutable std::weak_ptr<const SolverAnalysis> analysis_;
};

}  // namespace lapwing
