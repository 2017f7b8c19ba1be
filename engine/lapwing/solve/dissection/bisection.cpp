#include "lapwing/solve/dissection/bisection.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "lapwing/solve/dissection/sweeps.h"

namespace lapwing::dissection {
namespace {

// Size of the graph on which several cuts are tried, in nodes.
constexpr int kSearched = 4000;
// Size of the graph that is swept, in nodes.
constexpr int kCoarsest = 60;

}  // namespace

Bisection::Bisection(const WeightedGraph& graph)
    : graph_(graph),
      most_weight_(std::max(
          1, std::accumulate(graph.weights.begin(), graph.weights.end(), 0) / (2 * kCoarsest / 3))),
      levels_(coarsen(graph, kSearched, 0)) {}

EdgeCut Bisection::attempt(std::size_t number) const {
  const WeightedGraph& searched = levels_.empty() ? graph_ : levels_.back().graph;
  const std::vector<Level> levels = coarsen(searched, kCoarsest, number);
  return refine(best_sweep(levels.empty() ? searched : levels.back().graph), levels, searched);
}

Sides Bisection::refine(const EdgeCut& cut) const {
  return refine(cut, levels_, graph_).sides;
}

std::vector<Bisection::Level> Bisection::coarsen(const WeightedGraph& finest, int size,
                                                 std::size_t variant) const {
  constexpr std::size_t kMostLevels = 40;
  std::vector<Level> levels;
  levels.reserve(kMostLevels);
  while (levels.size() < kMostLevels) {
    const WeightedGraph& graph = levels.empty() ? finest : levels.back().graph;
    if (graph.size() <= size) break;
    Groups groups = group_neighbours(graph, most_weight_, variant);
    if (10 * groups.size() > 9 * graph.size()) break;
    WeightedGraph coarser = contract(graph, groups);
    levels.push_back({std::move(groups.of_node), std::move(coarser)});
  }
  return levels;
}

EdgeCut Bisection::refine(EdgeCut cut, const std::vector<Level>& levels,
                          const WeightedGraph& finest) {
  for (std::size_t level = levels.size(); level-- > 0;) {
    const std::vector<int>& group_of = levels[level].group_of;
    Sides finer(group_of.size());
    for (std::size_t v = 0; v < finer.size(); ++v) finer[v] = cut.sides[group_of[v]];
    cut = improved_cut(level == 0 ? finest : levels[level - 1].graph, std::move(finer));
  }
  return cut;
}

}  // namespace lapwing::dissection
