#include "lapwing/solve/dissection/mesh_dissection.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <numeric>
#include <span>
#include <thread>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/worker_pool.h"
#include "lapwing/solve/dissection/bisection.h"
#include "lapwing/solve/dissection/leaf_order.h"
#include "lapwing/solve/dissection/separator.h"

namespace lapwing {
namespace {

using namespace dissection;

constexpr int kLeaf = 90;
// Nodes that are cut as one at first.
constexpr int kGroup = 6;
// A set of so many unknowns is worth a thread's attention.
constexpr int kSmallestShared = 1500;

// How many cuts to choose from, on the coarse graph of a set and on its nodes. The first separators
// make the largest fronts, and are few.
struct Effort {
  unsigned attempts = 1;
  unsigned variants = 1;

  explicit Effort(int unknowns)
      : attempts(static_cast<unsigned>(std::clamp(unknowns / 3000, 1, 12))),
        variants(unknowns >= 60'000 ? 2 : 1) {}
};

// A set of nodes that is to be ordered. Unknowns weigh 1; nodes that only couple, 0; edges have no
// weights.
struct Part {
  WeightedGraph graph;
  Groups groups;           // its nodes stand group by group
  std::vector<int> nodes;  // in the whole graph
  int first = 0;           // of its unknowns' places in the order
  int unknowns = 0;

  // `group` is any number that its neighbours in the group have, too.
  void add(int node, int weight, int group) {
    if (group != last_group_) {
      last_group_ = group;
      groups.starts.push_back(groups.starts.back());
    }
    groups.of_node.push_back(groups.size() - 1);
    groups.nodes.push_back(groups.starts.back()++);
    nodes.push_back(node);
    graph.weights.push_back(weight);
    unknowns += weight;
  }

  // For node after node of this one: the edges of `node` in the graph it comes from, where they
  // lead to nodes with a number here.
  void connect(const std::vector<int>& starts, const std::vector<int>& neighbours, int node,
               const std::vector<int>& number) {
    for (int e = starts[node]; e < starts[node + 1]; ++e) {
      if (const int u = number[neighbours[e]]; u >= 0) graph.neighbours.push_back(u);
    }
    graph.starts.push_back(static_cast<int>(graph.neighbours.size()));
  }

 private:
  int last_group_ = -1;
};

Part whole(const CouplingGraph& graph) {
  WeightedGraph even;
  even.starts = graph.starts;
  even.neighbours = graph.neighbours;
  even.edge_weights.assign(graph.neighbours.size(), 1);
  even.weights.assign(static_cast<std::size_t>(graph.size()), 1);
  const Groups groups = group_neighbours(even, kGroup, 0);
  Part part;
  std::vector<int> number(even.weights.size());
  for (const int v : groups.nodes) {
    number[v] = part.graph.size();
    part.add(v, v < graph.unknowns ? 1 : 0, groups.of_node[v]);
  }
  for (const int v : part.nodes) part.connect(graph.starts, graph.neighbours, v, number);
  return part;
}

// What is left on `side` without the separator, and whatever couples it.
Part side_of(const Part& part, const ThickSeparator& separator, int side) {
  const WeightedGraph& graph = part.graph;
  const auto is_left = [&](int v) {
    return graph.weights[v] > 0 && separator.side(v) == side && !separator.contains(v);
  };
  Part result;
  std::vector<int> number(graph.weights.size(), -1);
  for (int v = 0; v < graph.size(); ++v) {
    if (separator.side(v) != side) continue;
    const bool left = is_left(v);
    bool wanted = left;
    for (int e = graph.starts[v]; !wanted && e < graph.starts[v + 1]; ++e) {
      wanted = is_left(graph.neighbours[e]);
    }
    if (!wanted) continue;
    number[v] = result.graph.size();
    result.add(v, left ? 1 : 0, part.groups.of_node[v]);
  }
  for (int& node : result.nodes) {
    result.connect(graph.starts, graph.neighbours, node, number);
    node = part.nodes[node];
  }
  return result;
}

Sides best_sides(const Part& part) {
  const WeightedGraph coarse = contract_nodes(part.graph, part.groups);
  const Effort effort(part.unknowns);
  Sides best;
  int least = 0;
  for (unsigned variant = 0; variant < effort.variants; ++variant) {
    const Sides of_groups = bisect(coarse, effort.attempts, variant);
    Sides sides(part.nodes.size());
    for (std::size_t v = 0; v < sides.size(); ++v) sides[v] = of_groups[part.groups.of_node[v]];
    ThickSeparator separator(part.graph, sides);
    separator.smooth();
    if (!best.empty() && separator.value() >= least) continue;
    least = separator.value();
    best = std::move(sides);
  }
  return best;
}

class Dissection final {
 public:
  explicit Dissection(const CouplingGraph& graph)
      : graph_(graph), order_(static_cast<std::size_t>(graph.unknowns)) {
    waiting_.push_back(whole(graph));
    unfinished_ = 1;
  }

  std::vector<int> run() {
    LentScope lent;
    shared_workers().run([&](int thread) {
      try {
        if (thread == 0) {
          work();
          return;
        }
        const LentScope::Borrowed borrowed(lent);
        work();
      } catch (...) {
        const std::scoped_lock lock(mutex_);
        if (!error_) error_ = std::current_exception();
        stopped_ = true;
        lent.give_up();
      }
    });
    if (error_) std::rethrow_exception(error_);
    return std::move(order_);
  }

 private:
  // Until nothing is left, here or with another thread.
  void work() {
    LeafOrder leaf(graph_);
    while (!stopped_ && unfinished_ > 0) {
      Part part;
      if (!take(part)) {
        check_cancelled();
        std::this_thread::yield();
        continue;
      }
      order(std::move(part), leaf);
      --unfinished_;
    }
  }

  bool take(Part& part) {
    const std::scoped_lock lock(mutex_);
    if (waiting_.empty()) return false;
    part = std::move(waiting_.back());
    waiting_.pop_back();
    return true;
  }

  void give(Part part) {
    ++unfinished_;
    const std::scoped_lock lock(mutex_);
    waiting_.push_back(std::move(part));
  }

  // Gives away what is large enough for others, and orders the rest.
  void order(Part part, LeafOrder& leaf) {
    std::vector<Part> mine;
    mine.push_back(std::move(part));
    while (!mine.empty() && !stopped_) {
      const Part next = std::move(mine.back());
      mine.pop_back();
      if (next.unknowns == 0) continue;
      check_cancelled();
      if (next.unknowns <= kLeaf) {
        order_leaf(next, leaf);
        continue;
      }
      for (Part& side : cut(next, leaf)) {
        if (side.unknowns >= kSmallestShared && !mine.empty()) {
          give(std::move(side));
        } else {
          mine.push_back(std::move(side));
        }
      }
    }
  }

  // Both sides, whose places and whose separator's in the order are settled; none for a set that
  // no separator cuts well, which is ordered as it is.
  std::vector<Part> cut(const Part& part, LeafOrder& leaf) {
    Sides of_nodes = best_sides(part);
    const ThickSeparator separator(part.graph, of_nodes);
    std::vector<Part> sides;
    if (2 * separator.value() >= part.unknowns) {
      order_leaf(part, leaf);
      return sides;
    }
    int place = part.first;
    for (const int side : {0, 1}) {
      sides.push_back(side_of(part, separator, side));
      sides.back().first = place;
      place += sides.back().unknowns;
    }
    for (int v = 0; v < part.graph.size(); ++v) {
      if (separator.contains(v) && part.graph.weights[v] > 0) order_[place++] = part.nodes[v];
    }
    return sides;
  }

  void order_leaf(const Part& part, LeafOrder& leaf) {
    int place = part.first;
    for (std::size_t v = 0; v < part.nodes.size(); ++v) {
      if (part.graph.weights[v] > 0) order_[place++] = part.nodes[v];
    }
    leaf.sort(std::span(order_).subspan(static_cast<std::size_t>(part.first),
                                        static_cast<std::size_t>(part.unknowns)));
  }

  const CouplingGraph& graph_;
  std::vector<int> order_;
  std::mutex mutex_;
  std::vector<Part> waiting_;
  std::atomic<int> unfinished_ = 0;  // taken or waiting
  std::atomic<bool> stopped_ = false;
  std::exception_ptr error_;
};

}  // namespace

std::vector<int> dissection_order(const CouplingGraph& graph) {
  return graph.unknowns == 0 ? std::vector<int>() : Dissection(graph).run();
}

}  // namespace lapwing
