#include "lapwing/solve/dissection/mesh_dissection.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <span>
#include <thread>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/worker_pool.h"
#include "lapwing/solve/dissection/bisection.h"
#include "lapwing/solve/dissection/leaf_order.h"
#include "lapwing/solve/dissection/part.h"
#include "lapwing/solve/dissection/separator.h"
#include "lapwing/solve/dissection/shared_loops.h"

namespace lapwing {
namespace {

using namespace dissection;

constexpr int kLeaf = 90;
// Sets of at least this many unknowns are offered to other threads.
constexpr int kSmallestShared = 500;
// Number of attempts at a cut that are refined to the nodes.
constexpr std::size_t kFinalists = 3;
// Number of smoothing passes for each of these attempts, and then for the best one.
constexpr int kFirstPasses = 1;
constexpr int kPasses = 3;

// Returns how many cuts to try: more for larger sets, because few separators cause the largest
// fronts.
std::size_t attempts(int unknowns) {
  return static_cast<std::size_t>(std::clamp(unknowns / 200, 1, 8));
}

class Dissection final {
 public:
  explicit Dissection(const CouplingGraph& graph)
      : graph_(graph), order_(static_cast<std::size_t>(graph.unknowns)) {
    waiting_.push_back(whole_part(graph));
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
  // Orders sets until none is left on any thread.
  void work() {
    LeafOrder leaf(graph_);
    while (!stopped_ && unfinished_ > 0) {
      Part part;
      if (!take(part)) {
        if (loops_.help()) continue;
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

  // Orders `part`, and offers its large sides to other threads.
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

  // Returns the best of several separators. Idle threads help with the search.
  ThickSeparator best_separator(const Part& part) {
    const WeightedGraph coarse = contract_nodes(part.graph, part.groups);
    const Bisection bisection(coarse);
    std::vector<EdgeCut> cuts(attempts(part.unknowns));
    loops_.run(cuts.size(), [&](std::size_t k) { cuts[k] = bisection.attempt(k); });
    std::stable_sort(cuts.begin(), cuts.end(),
                     [](const EdgeCut& a, const EdgeCut& b) { return a.score < b.score; });
    cuts.resize(std::min(cuts.size(), kFinalists));
    const bool is_chosen = cuts.size() > 1;
    std::vector<ThickSeparator> separators(cuts.size());
    std::vector<CutScore> scores(cuts.size());
    loops_.run(cuts.size(), [&](std::size_t k) {
      const Sides of_groups = bisection.refine(cuts[k]);
      Sides sides(part.nodes.size());
      for (std::size_t v = 0; v < sides.size(); ++v) sides[v] = of_groups[part.groups.of_node[v]];
      separators[k] = ThickSeparator(part.graph, std::move(sides));
      scores[k] = separators[k].smooth(is_chosen ? kFirstPasses : kPasses);
    });
    ThickSeparator& best =
        separators[std::min_element(scores.begin(), scores.end()) - scores.begin()];
    if (is_chosen) best.smooth(kPasses);
    return std::move(best);
  }

  // Writes the separator to the end of the part's range in the order, and returns both sides with
  // their ranges. If the best separator has half of the unknowns or more, orders the part as a leaf
  // and returns no sides.
  std::vector<Part> cut(const Part& part, LeafOrder& leaf) {
    const ThickSeparator separator = best_separator(part);
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
  SharedLoops loops_;
  std::vector<int> order_;
  std::mutex mutex_;
  std::vector<Part> waiting_;
  std::atomic<int> unfinished_ = 0;  // number of parts that are waiting or being ordered
  std::atomic<bool> stopped_ = false;
  std::exception_ptr error_;
};

}  // namespace

std::vector<int> dissection_order(const CouplingGraph& graph) {
  return graph.unknowns == 0 ? std::vector<int>() : Dissection(graph).run();
}

}  // namespace lapwing
