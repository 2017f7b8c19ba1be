#include "lapwing/solve/block_cholesky/symbolic.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <string>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/solve/block_cholesky/supernodes.h"

namespace lapwing::cholesky {
namespace {

// The most expensive subtrees are split until each costs at most this fraction of the whole
// factorization. Sixteen threads can then share the subtrees, and a local change affects few of
// them. With smaller subtrees, the fronts above the cut, whose update matrices are cached, would be
// too many.
constexpr double kLargestTaskShare = 1.0 / 48;
// Subtrees with at most this cost, in ns, are never split.
constexpr double kSmallestTask = 100'000;

// The supernodes above the cut, and the roots of the subtrees below it, most expensive first.
struct Cut {
  std::vector<char> is_top;
  std::vector<int> roots;
  std::vector<double> weight;  // estimated time of each supernode's subtree
  double limit = 0;            // largest weight of a subtree that is not split
};

Cut cut_forest(const Supernodes& nodes) {
  const int count = static_cast<int>(nodes.cost.size());
  Cut cut;
  cut.is_top.assign(count, 0);
  cut.weight = nodes.cost;
  double total = 0;
  using Weighted = std::pair<double, int>;
  const auto lighter = [](const Weighted& a, const Weighted& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  };
  std::priority_queue<Weighted, std::vector<Weighted>, decltype(lighter)> queue(lighter);
  for (int q = 0; q < count; ++q) {
    for (const int c : nodes.children[q]) cut.weight[q] += cut.weight[c];
    if (nodes.parent[q] >= 0) continue;
    queue.emplace(cut.weight[q], q);
    total += cut.weight[q];
  }
  cut.limit = std::max(total * kLargestTaskShare, kSmallestTask);
  while (!queue.empty() && queue.top().first > cut.limit) {
    const int q = queue.top().second;
    queue.pop();
    cut.is_top[q] = 1;
    for (const int c : nodes.children[q]) queue.emplace(cut.weight[c], c);
  }
  for (; !queue.empty(); queue.pop()) cut.roots.push_back(queue.top().second);
  return cut;
}

// Creates a front for each supernode and numbers the fronts in the order of computation.
class FrontNumbering {
 public:
  FrontNumbering(const Supernodes& nodes, const Cut& cut, Symbolic& symbolic)
      : nodes_(nodes), cut_(cut), symbolic_(symbolic), parity_(nodes.cost.size(), 0) {
    sequence_.reserve(nodes.cost.size());
  }

  void run(const EliminationTree& tree, std::span<const int> order) {
    double task_weight = 0;
    for (const int root : cut_.roots) {
      visit_subtree(root, false);
      kept_.push_back(root);
      // Cheap subtrees share a task; otherwise ten thousand isolated vertices would be ten thousand
      // tasks.
      task_weight += cut_.weight[root];
      if (task_weight > cut_.limit / 8) {
        symbolic_.task_starts.push_back(static_cast<int>(sequence_.size()));
        task_weight = 0;
      }
    }
    if (static_cast<int>(sequence_.size()) != symbolic_.task_starts.back()) {
      symbolic_.task_starts.push_back(static_cast<int>(sequence_.size()));
    }
    for (std::size_t q = 0; q < nodes_.cost.size(); ++q) {
      if (nodes_.parent[q] < 0 && cut_.is_top[q]) visit_subtree(static_cast<int>(q), true);
    }
    make_fronts(tree, order);
  }

 private:
  // Appends the subtree of `root` in postorder. If `top` is true, omits the part below the cut.
  void visit_subtree(int root, bool top) {
    std::vector<std::pair<int, std::size_t>> path{{root, 0}};
    while (!path.empty()) {
      auto& [node, next] = path.back();
      const auto& children = nodes_.children[node];
      if (next == children.size()) {
        sequence_.push_back(node);
        path.pop_back();
        continue;
      }
      const int child = children[next++];
      if (top && !cut_.is_top[child]) continue;
      parity_[child] = static_cast<char>(!parity_[node]);
      path.emplace_back(child, 0);
    }
  }

  void make_fronts(const EliminationTree& tree, std::span<const int> order) {
    std::vector<int> number(sequence_.size());
    for (std::size_t f = 0; f < sequence_.size(); ++f) number[sequence_[f]] = static_cast<int>(f);
    const double b = symbolic_.block_size;
    symbolic_.fronts.resize(sequence_.size());
    symbolic_.order.clear();
    for (std::size_t f = 0; f < sequence_.size(); ++f) {
      const int q = sequence_[f];
      Front& front = symbolic_.fronts[f];
      front.first_block = static_cast<int>(symbolic_.order.size());
      front.pivot_blocks = static_cast<int>(nodes_.columns[q].size());
      front.update_blocks = nodes_.update_counts[q];
      front.parent = nodes_.parent[q] < 0 ? -1 : number[nodes_.parent[q]];
      front.depth_parity = parity_[q];
      front.keeps_update = cut_.is_top[q] != 0;
      front.children_begin = static_cast<int>(symbolic_.children.size());
      for (const int c : nodes_.children[q]) symbolic_.children.push_back(number[c]);
      front.children_end = static_cast<int>(symbolic_.children.size());
      for (const int j : nodes_.columns[q]) {
        symbolic_.order.push_back(order[tree.columns[j]]);
        const double entries = b * tree.counts[j];
        for (double k = 0; k < b; ++k) {
          front.flops += (entries - k) * (entries - k);
        }
      }
      symbolic_.flops += front.flops;
    }
    for (const int q : kept_) symbolic_.fronts[number[q]].keeps_update = true;
  }

  const Supernodes& nodes_;
  const Cut& cut_;
  Symbolic& symbolic_;
  std::vector<int> sequence_;  // supernode of each front
  std::vector<char> parity_;
  std::vector<int> kept_;
};

// Assigns memory for the data that each front passes to its parent. Cached data are stored one
// after the other; all other data are on two stacks, selected by the parity of the front's depth.
// When a front is done, the data of its children are on top of the other stack.
template <typename SizeOf>
FrontMemoryPlan plan_hand_over(Symbolic& symbolic, std::size_t Front::*place, SizeOf size_of) {
  FrontMemoryPlan plan;
  for (int task = 0; task < symbolic.task_count(); ++task) {
    std::size_t used[2] = {0, 0};
    for (int f = symbolic.task_starts[task]; f < symbolic.task_starts[task + 1]; ++f) {
      Front& front = symbolic.fronts[f];
      if (!front.keeps_update) {
        std::size_t& top = used[front.depth_parity];
        front.*place = top;
        top += size_of(front);
        plan.stacks[front.depth_parity] = std::max(plan.stacks[front.depth_parity], top);
      }
      for (int c = front.children_begin; c < front.children_end; ++c) {
        used[1 - front.depth_parity] -= size_of(symbolic.fronts[symbolic.children[c]]);
      }
    }
  }
  for (Front& front : symbolic.fronts) {
    if (!front.keeps_update) continue;
    front.*place = plan.kept;
    plan.kept += size_of(front);
  }
  return plan;
}

// The nodes are the tasks, followed by the top fronts.
void build_work_graphs(Symbolic& symbolic) {
  const int nodes = symbolic.task_count() + symbolic.front_count() - symbolic.first_top();
  symbolic.upward.predecessor_counts.assign(nodes, 0);
  symbolic.downward.predecessor_counts.assign(nodes, 0);
  std::vector<std::vector<int>> parents(nodes);
  std::vector<std::vector<int>> children(nodes);
  const int tasks = symbolic.task_count();
  for (int f = 0; f < symbolic.front_count(); ++f) {
    const int parent = symbolic.fronts[f].parent;
    if (parent < symbolic.first_top()) continue;
    const int node = symbolic.node_of_front(f);
    const int above = tasks + parent - symbolic.first_top();
    if (!parents[node].empty() && parents[node].back() == above) continue;
    parents[node].push_back(above);
    children[above].push_back(node);
    ++symbolic.upward.predecessor_counts[above];
    ++symbolic.downward.predecessor_counts[node];
  }
  const auto flatten = [](const std::vector<std::vector<int>>& lists, WorkGraph& graph) {
    for (const auto& list : lists) {
      graph.successors.insert(graph.successors.end(), list.begin(), list.end());
      graph.successor_starts.push_back(static_cast<int>(graph.successors.size()));
    }
  };
  flatten(parents, symbolic.upward);
  flatten(children, symbolic.downward);
}

}  // namespace

int Symbolic::node_of_front(int front) const {
  if (front >= first_top()) return task_count() + front - first_top();
  const auto after = std::upper_bound(task_starts.begin(), task_starts.end(), front);
  return static_cast<int>(after - task_starts.begin()) - 1;
}

Symbolic analyze_pattern(const BlockPattern& pattern, int block_size, std::span<const int> order) {
  const std::size_t limit = std::numeric_limits<int>::max() / 8;
  if (pattern.size() * static_cast<std::size_t>(block_size) > limit) {
    throw SolverError("the system has " + std::to_string(pattern.size()) +
                      " blocks, more than the factorization can index; choose a smaller region");
  }
  const EliminationGraph graph = elimination_graph(pattern, order);
  const EliminationTree tree = build_elimination_tree(graph);
  const Supernodes nodes = find_supernodes(tree, block_size);
  const Cut cut = cut_forest(nodes);
  Symbolic symbolic;
  symbolic.block_size = block_size;
  symbolic.blocks = static_cast<int>(pattern.size());
  FrontNumbering(nodes, cut, symbolic).run(tree, order);
  find_structure(pattern, graph, symbolic);
  symbolic.updates = plan_hand_over(symbolic, &Front::update_at, [](const Front& front) {
    return triangle_offset(front.update_strips) + kUpdateSlack;
  });
  symbolic.vectors = plan_hand_over(symbolic, &Front::vector_at, [](const Front& front) {
    return static_cast<std::size_t>(front.update_strips) * kStrip;
  });
  build_work_graphs(symbolic);
  return symbolic;
}

}  // namespace lapwing::cholesky
