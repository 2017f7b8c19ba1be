#include "lapwing/solve/block_cholesky/front_structure.h"

#include <algorithm>

#include "lapwing/base/cancellation.h"

namespace lapwing::cholesky {
namespace {

// Fills the parts of a Symbolic front after front.
class StructureBuilder {
 public:
  StructureBuilder(const BlockPattern& pattern, const BlockGraph& graph, Symbolic& symbolic)
      : pattern_(pattern), graph_(graph), symbolic_(symbolic) {}

  void run() {
    number_blocks();
    check_cancelled();
    size_fronts();
    check_cancelled();
    sort_entries();
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
    inverse_.resize(n);
    for (int i = 0; i < n; ++i) inverse_[symbolic_.order[i]] = i;
    front_of_new_.resize(n);
    symbolic_.front_of_block.resize(n);
    for (int f = 0; f < symbolic_.front_count(); ++f) {
      const Front& front = symbolic_.fronts[f];
      for (int j = front.first_block; j < front.first_block + front.pivot_blocks; ++j) {
        front_of_new_[j] = f;
        symbolic_.front_of_block[symbolic_.order[j]] = f;
      }
    }
    mark_.assign(n, -1);
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

  // Counting sort of the matrix's blocks by the front that owns the earlier of row and column.
  void sort_entries() {
    std::vector<std::size_t> next(symbolic_.fronts.size() + 1, 0);
    for_each_block([&](std::size_t, int row, int column) {
      ++next[front_of_new_[std::min(row, column)] + 1];
    });
    for (std::size_t f = 0; f < symbolic_.fronts.size(); ++f) {
      next[f + 1] += next[f];
      symbolic_.fronts[f].entries_begin = next[f];
      symbolic_.fronts[f].entries_end = next[f + 1];
    }
    symbolic_.entries.resize(pattern_.rows.size());
    for_each_block([&](std::size_t source, int row, int column) {
      symbolic_.entries[next[front_of_new_[std::min(row, column)]]++] = {source, row, column};
    });
  }

  template <typename Visit>
  void for_each_block(Visit visit) {
    for (std::size_t c = 0; c < pattern_.size(); ++c) {
      const int column = inverse_[c];
      for (std::size_t e = pattern_.starts[c]; e < pattern_.starts[c + 1]; ++e) {
        visit(e, inverse_[pattern_.rows[e]], column);
      }
    }
  }

  // The update rows of a front: what its columns and its children reach beyond its pivots.
  void find_rows(int f) {
    const Front& front = symbolic_.fronts[f];
    const int end = front.first_block + front.pivot_blocks;
    int* rows = symbolic_.rows.data() + front.rows_at;
    int* next = rows;
    const auto add = [&](int row) {
      if (row < end || mark_[row] == f) return;
      mark_[row] = f;
      *next++ = row;
    };
    for (int j = front.first_block; j < end; ++j) {
      const int old = symbolic_.order[j];
      for (int e = graph_.starts[old]; e < graph_.starts[old + 1]; ++e) {
        add(inverse_[graph_.neighbours[e]]);
      }
    }
    for (int c = front.children_begin; c < front.children_end; ++c) {
      const Front& child = symbolic_.fronts[symbolic_.children[c]];
      const int* from = symbolic_.rows.data() + child.rows_at;
      std::for_each(from, from + child.update_blocks, add);
    }
    std::sort(rows, next);
  }

  // The padded row of every block of a front.
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

  void place_entries(const Front& front) {
    for (std::size_t e = front.entries_begin; e < front.entries_end; ++e) {
      MatrixEntry& entry = symbolic_.entries[e];
      entry.row = place_[entry.row];
      entry.column = place_[entry.column];
    }
  }

  const BlockPattern& pattern_;
  const BlockGraph& graph_;
  Symbolic& symbolic_;
  std::vector<int> inverse_;
  std::vector<int> front_of_new_;
  std::vector<int> mark_;   // last front that listed the block as a row
  std::vector<int> place_;  // padded row of the block in the front at hand
};

}  // namespace

void find_structure(const BlockPattern& pattern, const BlockGraph& graph, Symbolic& symbolic) {
  StructureBuilder(pattern, graph, symbolic).run();
}

}  // namespace lapwing::cholesky
