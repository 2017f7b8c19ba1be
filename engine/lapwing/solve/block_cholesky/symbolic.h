#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lapwing/solve/block_cholesky/elimination_tree.h"
#include "lapwing/solve/block_cholesky/front_layout.h"
#include "lapwing/solve/block_matrix.h"

namespace lapwing::cholesky {

/// One dense step of the multifrontal method (Duff, Reid 1983). A front eliminates its pivot
/// columns, and passes the resulting update matrix to its parent. Sizes are in scalars unless the
/// name contains "blocks". Offsets are indices into the named array.
struct Front {
  int first_block = 0;  ///< first pivot block, in the factor's numbering
  int pivot_blocks = 0;
  int update_blocks = 0;
  int pivots = 0;
  int updates = 0;
  int pivot_strips = 0;
  int update_strips = 0;
  int parent = -1;  ///< a front with a higher number; -1 at the roots
  int children_begin = 0;
  int children_end = 0;       ///< in Symbolic::children
  int parent_pivots = 0;      ///< number of leading update rows that are pivots of the parent
  bool keeps_update = false;  ///< its update matrix is cached after its parent is done
  int depth_parity = 0;       ///< selects the stack of its update matrix if that is not cached
  std::size_t panel_at = 0;   ///< offset in the factor
  std::size_t update_at = 0;  ///< offset of its update matrix, in the cache or on its stack
  std::size_t vector_at = 0;  ///< the same for its update rows of one right-hand side
  std::size_t rows_at = 0;    ///< in Symbolic::rows
  std::size_t positions_at = 0;
  std::size_t pieces_begin = 0;
  std::size_t pieces_end = 0;
  std::size_t entries_begin = 0;
  std::size_t entries_end = 0;
  double flops = 0;  ///< operations without those on padding and on zeros from merging

  int strips() const { return pivot_strips + update_strips; }
};

/// The position of a matrix block in its front. `row` and `column` count padded rows. A block with
/// row < column is in the upper triangle of the front, so its transpose is added.
struct MatrixEntry {
  std::size_t source = 0;  ///< block number in the pattern
  int row = 0;
  int column = 0;
};

/// Memory for the data that fronts pass to their parents. Sizes count numbers, not bytes.
struct FrontMemoryPlan {
  std::size_t kept = 0;
  std::size_t stacks[2] = {0, 0};  ///< size per thread of the stack for each parity of depth
};

/// A dependency graph: for each node, the successors that wait for it.
struct WorkGraph {
  std::vector<int> successor_starts{0};
  std::vector<int> successors;
  std::vector<int> predecessor_counts;

  int size() const { return static_cast<int>(predecessor_counts.size()); }
};

/// The part of a factorization that depends only on the pattern.
///
/// The forest of fronts is cut into tasks and the top fronts above them. A task is one or more
/// whole subtrees and runs on one thread; threads share the top fronts. The cut does not depend on
/// the number of threads. Fronts are numbered task by task, followed by the top fronts; children
/// precede their parents.
struct Symbolic {
  int block_size = 3;
  int blocks = 0;
  std::vector<int> order;           ///< new to old
  std::vector<int> front_of_block;  ///< indexed by the block's old number
  std::vector<Front> fronts;
  std::vector<int> task_starts{0};  ///< task t is fronts [task_starts[t], task_starts[t+1])
  std::vector<int> children;
  std::vector<int> rows;       ///< block rows of the update parts, ascending in each front
  std::vector<int> positions;  ///< padded row of each update row in the parent
  std::vector<Piece> pieces;
  std::vector<MatrixEntry> entries;
  std::size_t factor_size = 0;
  FrontMemoryPlan updates;
  FrontMemoryPlan vectors;  ///< for a single right-hand side
  WorkGraph upward;         ///< nodes: tasks, then top fronts; children come before parents
  WorkGraph downward;       ///< the same nodes; parents come before children
  double flops = 0;         ///< sum over all fronts

  int task_count() const { return static_cast<int>(task_starts.size()) - 1; }
  int first_top() const { return task_starts.back(); }
  int front_count() const { return static_cast<int>(fronts.size()); }
  int node_of_front(int front) const;
  /// Returns the top front of a node, or null if the node is a task.
  const Front* top_front(int node) const {
    return node < task_count() ? nullptr : &fronts[first_top() + node - task_count()];
  }
};

/// Computes the symbolic factorization of `pattern` under `order` (new to old). Takes almost linear
/// time in the size of the factor's block structure.
Symbolic analyze_pattern(const BlockPattern& pattern, int block_size, std::span<const int> order);

/// Fills the remaining lists of `symbolic` (front_structure.cpp). The pivot blocks, children and
/// numbers of update blocks of its fronts must already be set.
void find_structure(const BlockPattern& pattern, const EliminationGraph& graph, Symbolic& symbolic);

}  // namespace lapwing::cholesky
