#include <algorithm>

#include "lapwing/base/cancellation.h"
#include "lapwing/solve/block_cholesky/symbolic.h"

namespace lapwing::cholesky {
namespace {

// Fills the lists of a Symbolic, front after front.
class StructureBuilder {
 public:
  StructureBuilder(const BlockPattern& pattern, const EliminationGraph& graph, Symbolic& symbolic)
      : pattern_(pattern), graph_(graph), symbolic_(symbolic) {}

  void run() {
    number_blocks();
    check_cancelled();
    size_fronts();
    symbolic_.entries.resize(pattern_.rows.size());
    CancelCheck check;
    for (int f = 0; f < symbolic_.front_count(); ++f) {
      check();
      find_rows(f);
      place_rows(f);
      place_children(symbolic_.fronts[f]);
      place_entries(symbolic_.fronts[f]);
    }
  }

 private:
  void number_blocks() {
    const int n = symbolic_.blocks;
    columns_.resize(n);
    number_.resize(n);
    for (int j = 0; j < n; ++j) {
      columns_[j] = graph_.places[symbolic_.order[j]];
      number_[columns_[j]] = j;
    }
    symbolic_.front_of_block.resize(n);
    for (int f = 0; f < symbolic_.front_count(); ++f) {
      const Front& front = symbolic_.fronts[f];
      for (int j = front.first_block; j < front.first_block + front.pivot_blocks; ++j) {
        symbolic_.front_of_block[symbolic_.order[j]] = f;
      }
    }
    mark_.assign(n, -1);
    found_.resize(n + 1);
    place_.resize(n);
  }

  void size_fronts() {
    const int b = symbolic_.block_size;
    std::size_t rows = 0;
    std::size_t panel = 0;
    for (Front& front : symbolic_.fronts) {
      front.pivots = b * front.pivot_blocks;
      front.updates = b * front.update_blocks;
      front.pivot_strips = strips_of(front.pivots);
      front.update_strips = strips_of(front.updates);
      front.rows_at = rows;
      front.positions_at = rows * b;
      rows += front.update_blocks;
      front.panel_at = panel;
      panel += pivot_part_size(front.pivots, front.pivot_strips) +
               static_cast<std::size_t>(front.update_strips) * kStrip * front.pivots;
    }
    symbolic_.rows.resize(rows);
    symbolic_.positions.resize(rows * b);
    symbolic_.factor_size = panel;
  }

  // Finds the update rows of a front: the rows of its columns and of its children, except its own
  // pivots.
  void find_rows(int f) {
    const Front& front = symbolic_.fronts[f];
    const int end = front.first_block + front.pivot_blocks;
    int* next = found_.data();
    // Branch-free, because half of the branches would be mispredicted.
    const auto add = [&](int row) {
      *next = row;
      next += static_cast<int>(row >= end) & static_cast<int>(mark_[row] != f);
      mark_[row] = f;
    };
    for (int j = front.first_block; j < end; ++j) {
      for (int e = graph_.starts[columns_[j]]; e < graph_.starts[columns_[j] + 1]; ++e) {
        add(number_[graph_.later[e]]);
      }
    }
    for (int c = front.children_begin; c < front.children_end; ++c) {
      const Front& child = symbolic_.fronts[symbolic_.children[c]];
      const int* from = symbolic_.rows.data() + child.rows_at;
      std::for_each(from, from + child.update_blocks, add);
    }
    std::sort(found_.data(), next);
    std::copy(found_.data(), next, symbolic_.rows.data() + front.rows_at);
  }

  // Sets the padded row of every block of a front.
  void place_rows(int f) {
    const Front& front = symbolic_.fronts[f];
    const int b = symbolic_.block_size;
    for (int j = 0; j < front.pivot_blocks; ++j) place_[front.first_block + j] = b * j;
    const int* rows = symbolic_.rows.data() + front.rows_at;
    for (int k = 0; k < front.update_blocks; ++k) {
      place_[rows[k]] = kStrip * front.pivot_strips + b * k;
    }
  }

  void place_children(const Front& front) {
    const int b = symbolic_.block_size;
    for (int c = front.children_begin; c < front.children_end; ++c) {
      Front& child = symbolic_.fronts[symbolic_.children[c]];
      int* position = symbolic_.positions.data() + child.positions_at;
      for (int k = 0; k < child.update_blocks; ++k) {
        const int place = place_[symbolic_.rows[child.rows_at + k]];
        for (int z = 0; z < b; ++z) position[b * k + z] = place + z;
      }
      child.parent_pivots = static_cast<int>(
          std::lower_bound(position, position + child.updates, front.pivots) - position);
      child.pieces_begin = symbolic_.pieces.size();
      cut_pieces(position, child.updates);
      child.pieces_end = symbolic_.pieces.size();
    }
  }

  void cut_pieces(const int* position, int updates) {
    for (int i = 0; i < updates;) {
      const int strip = i / kStrip;
      const int target = position[i] / kStrip;
      const int strip_end = std::min(updates, kStrip * (strip + 1));
      int end = i + 1;
      while (end < strip_end && position[end] == position[i] + (end - i) &&
             position[end] / kStrip == target) {
        ++end;
      }
      const int first = i % kStrip;
      symbolic_.pieces.push_back({strip, target, static_cast<std::int8_t>(first),
                                  static_cast<std::int8_t>(first + end - i),
                                  static_cast<std::int8_t>(position[i] % kStrip - first)});
      i = end;
    }
  }

  // Lists the matrix blocks whose first column in the order is a pivot of this front.
  void place_entries(Front& front) {
    front.entries_begin = placed_;
    MatrixEntry* next = symbolic_.entries.data() + placed_;
    for (int j = front.first_block; j < front.first_block + front.pivot_blocks; ++j) {
      const int column = symbolic_.order[j];
      const int pivot = place_[j];
      *next++ = {pattern_.starts[column], pivot, pivot};
      for (int e = graph_.starts[columns_[j]]; e < graph_.starts[columns_[j] + 1]; ++e) {
        const int later = number_[graph_.later[e]];
        // The pattern stores each block below the diagonal, that is, in the column with the smaller
        // number.
        const bool is_column = column < symbolic_.order[later];
        next->source = static_cast<std::size_t>(graph_.blocks[e]);
        next->row = is_column ? place_[later] : pivot;
        next->column = is_column ? pivot : place_[later];
        ++next;
      }
    }
    placed_ = static_cast<std::size_t>(next - symbolic_.entries.data());
    front.entries_end = placed_;
  }

  const BlockPattern& pattern_;
  const EliminationGraph& graph_;
  Symbolic& symbolic_;
  std::vector<int> columns_;  // graph column of each factor column
  std::vector<int> number_;   // factor column of each graph column
  std::vector<int> found_;    // rows of the current front, and one spare element
  std::size_t placed_ = 0;    // number of entries placed so far
  std::vector<int> mark_;     // last front whose rows include the block
  std::vector<int> place_;    // padded row of the block in the current front
};

}  // namespace

void find_structure(const BlockPattern& pattern, const EliminationGraph& graph,
                    Symbolic& symbolic) {
  StructureBuilder(pattern, graph, symbolic).run();
}

}  // namespace lapwing::cholesky
