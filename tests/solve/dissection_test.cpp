#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <string_view>

#include <gtest/gtest.h>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/worker_pool.h"
#include "lapwing/laplacian/system_pattern.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/solve/block_solver.h"
#include "lapwing/solve/dissection/bisection.h"
#include "lapwing/solve/dissection/cut_score.h"
#include "lapwing/solve/dissection/leaf_order.h"
#include "lapwing/solve/dissection/mesh_dissection.h"
#include "lapwing/solve/dissection/part.h"
#include "lapwing/solve/dissection/separator.h"
#include "lapwing/solve/ordering.h"

namespace lapwing {
namespace {

using namespace dissection;

std::vector<Index> all_vertices(const Mesh& mesh) {
  std::vector<Index> all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

// The system of a whole mesh. Every `held`-th vertex is constrained and therefore not an unknown.
struct System {
  Unknowns unknowns;
  CouplingGraph graph;
  BlockPattern pattern;

  explicit System(const Mesh& mesh, std::size_t held = 0) {
    const std::vector<Index> all = all_vertices(mesh);
    std::vector<Index> free;
    for (const Index v : all) {
      if (held == 0 || v % held != 0) free.push_back(v);
    }
    unknowns = Unknowns(free, all.size());
    const Adjacency& rings = mesh.topology().rings;
    graph = coupling_graph(rings, all, unknowns);
    pattern = NormalPattern(ring_blocks(rings, all), unknowns).blocks();
  }

  double flops(std::span<const int> order) const {
    const auto solver = make_solver();
    solver->analyze(pattern, 1, order);
    return solver->statistics().flops;
  }
};

// A regular cone: everything meets at its tip.
Mesh fan(int triangles) {
  Mesh mesh;
  mesh.positions.emplace_back(0, 0, 1);
  Faces& faces = mesh.edit_faces();
  for (int k = 0; k < triangles; ++k) {
    const double angle = 2 * std::numbers::pi * k / triangles;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    faces.add(std::array<Index, 3>{0U, static_cast<Index>(1 + k),
                                   static_cast<Index>(1 + (k + 1) % triangles)});
  }
  return mesh;
}

Mesh two_spheres() {
  const Mesh one = icosphere(3);
  Mesh both = one;
  const auto shift = static_cast<Index>(one.vertex_count());
  for (const Eigen::Vector3d& p : one.positions)
    both.positions.emplace_back(p + Eigen::Vector3d(3, 0, 0));
  Faces& faces = both.edit_faces();
  for (std::size_t f = 0; f < one.face_count(); ++f) {
    const auto face = one.face(f);
    faces.add(std::array<Index, 3>{face[0] + shift, face[1] + shift, face[2] + shift});
  }
  return both;
}

void expect_permutation(const std::vector<int>& order, std::size_t size) {
  std::vector<int> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> expected(size);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(sorted, expected);
}

// Which unknowns M'M couples, from the definition.
std::vector<std::set<int>> coupled(const CouplingGraph& graph) {
  std::vector<std::set<int>> result(static_cast<std::size_t>(graph.unknowns));
  for (int row = 0; row < graph.size(); ++row) {
    std::vector<int> members{row};
    for (int e = graph.starts[row]; e < graph.starts[row + 1]; ++e) {
      members.push_back(graph.neighbours[e]);
    }
    for (const int a : members) {
      for (const int b : members) {
        if (a != b && a < graph.unknowns && b < graph.unknowns) result[a].insert(b);
      }
    }
  }
  return result;
}

WeightedGraph weighted(const CouplingGraph& graph) {
  WeightedGraph result;
  result.starts = graph.starts;
  result.neighbours = graph.neighbours;
  result.edge_weights.assign(graph.neighbours.size(), 1);
  result.weights.assign(static_cast<std::size_t>(graph.size()), 0);
  result.borders.assign(result.weights.size(), 0);
  std::fill_n(result.weights.begin(), graph.unknowns, 1);
  return result;
}

TEST(DissectionOrder, IsAPermutationWhateverTheMesh) {
  for (const Mesh& mesh : {icosphere(0), icosphere(4), grid(40, 70), cylinder(12, 90, 0.3, 6.0),
                           two_spheres(), fan(3000)}) {
    for (const std::size_t held : {0U, 3U, 2U, 1U}) {
      const System system(mesh, held);
      expect_permutation(dissection_order(system.graph), system.unknowns.size());
    }
  }
  expect_permutation(dissection_order(CouplingGraph()), 0);
}

TEST(CouplingGraph, CouplesWhatMeetsInTheNormalMatrix) {
  const System system(grid(12, 9), 4);
  const auto expected = coupled(system.graph);
  const BlockGraph actual = block_graph(system.pattern);
  for (std::size_t u = 0; u < expected.size(); ++u) {
    const std::set<int> row(actual.neighbours.begin() + actual.starts[u],
                            actual.neighbours.begin() + actual.starts[u + 1]);
    EXPECT_EQ(row, expected[u]) << "unknown " << u;
  }
}

// On a sheet minimum degree is far from the best, and METIS near it.
TEST(DissectionOrder, TakesAsFewOperationsAsMetis) {
  for (const Mesh& mesh : {grid(120, 120), grid(30, 300), icosphere(5), cylinder(40, 160, 1.0, 9.0),
                           cylinder(90, 70, 1.0, 0.6)}) {
    const System system(mesh);
    const double ours = system.flops(dissection_order(system.graph));
    EXPECT_LT(ours,
              1.05 * system.flops(fill_reducing_order(system.pattern, Ordering::nested_dissection)))
        << mesh.vertex_count();
  }
  const System sheet(grid(120, 120));
  EXPECT_LT(sheet.flops(dissection_order(sheet.graph)),
            0.7 * sheet.flops(fill_reducing_order(sheet.pattern, Ordering::minimum_degree)));
}

TEST(DissectionOrder, IsTheSameForAnyNumberOfThreads) {
  const System system(grid(90, 120));
  const std::vector<int> shared = dissection_order(system.graph);
  const SerialScope alone;
  EXPECT_EQ(dissection_order(system.graph), shared);
}

TEST(DissectionOrder, CanBeCancelledAtEachPoint) {
  const System system(grid(60, 60));
  const std::vector<int> expected = dissection_order(system.graph);
  const AskAtEveryCheck always;
  {
    const ProgressScope scope([](std::string_view, double) { return false; });
    EXPECT_THROW(dissection_order(system.graph), Cancelled);
  }
  const SerialScope alone;  // what others do is not asked about
  int asked = 0;
  {
    const ProgressScope scope([&](std::string_view, double) {
      ++asked;
      return true;
    });
    EXPECT_EQ(dissection_order(system.graph), expected);
  }
  ASSERT_GT(asked, 20);
  for (int stop = 1; stop < asked; stop += std::max(1, asked / 15)) {
    int left = stop;
    const ProgressScope scope([&](std::string_view, double) { return --left > 0; });
    EXPECT_THROW(dissection_order(system.graph), Cancelled) << "at check " << stop;
  }
}

TEST(Part, KnowsTheBorderThatItsSeparatorLeaves) {
  const int across = 20;
  const System system(grid(across - 1, across - 1), 7);
  const Part part = whole_part(system.graph);
  EXPECT_EQ(part.unknowns, system.graph.unknowns);
  Sides sides(part.nodes.size());
  std::vector<Index> vertices = system.unknowns.vertices;  // of the nodes: what is held comes last
  for (Index v = 0; v < across * across; v += 7) vertices.push_back(v);
  for (std::size_t v = 0; v < sides.size(); ++v) {
    sides[v] = vertices[part.nodes[v]] % across < across / 2 ? 0 : 1;
  }
  const ThickSeparator separator(part.graph, sides);
  const auto neighbours = coupled(system.graph);
  for (const int side : {0, 1}) {
    const Part half = side_of(part, separator, side);
    EXPECT_GT(half.unknowns, 0);
    int unknowns = 0;
    for (std::size_t v = 0; v < half.nodes.size(); ++v) {
      const int node = half.nodes[v];
      const bool is_unknown = half.graph.weights[v] > 0;
      unknowns += is_unknown ? 1 : 0;
      // The border contains the unknowns of the separator, but no constrained vertices.
      const bool is_later = !is_unknown && node < system.graph.unknowns;
      EXPECT_EQ(half.graph.borders[v], is_later ? 2 : 0);
    }
    EXPECT_EQ(half.unknowns, unknowns);
    // A further dissection of this part preserves its border.
    const ThickSeparator none(half.graph, Sides(half.nodes.size(), 0));
    EXPECT_EQ(side_of(half, none, 0).graph.borders, half.graph.borders);
  }
}

TEST(ThickSeparator, PartsWhatIsCoupled) {
  for (const std::size_t held : {0U, 5U}) {
    const System system(icosphere(4), held);
    const WeightedGraph graph = weighted(system.graph);
    const Bisection bisection(graph);
    ThickSeparator separator(graph, bisection.refine(bisection.attempt(1)));
    separator.smooth(2);
    const auto neighbours = coupled(system.graph);
    int weight = 0;
    for (int v = 0; v < system.graph.unknowns; ++v) {
      weight += separator.contains(v) ? 1 : 0;
      if (separator.contains(v)) continue;
      for (const int u : neighbours[v]) {
        EXPECT_TRUE(separator.contains(u) || separator.side(u) == separator.side(v));
      }
    }
    EXPECT_EQ(separator.value(), weight);
    EXPECT_GT(weight, 0);
  }
}

TEST(ThickSeparator, GainIsWhatAMoveSaves) {
  const System system(grid(14, 11), 6);
  const WeightedGraph graph = weighted(system.graph);
  std::mt19937 random(7);
  Sides sides(graph.weights.size());
  for (std::size_t v = 0; v < sides.size(); ++v) sides[v] = v % 14 < 7 ? 0 : 1;
  ThickSeparator separator(graph, sides);
  for (int k = 0; k < 300; ++k) {
    const int v = static_cast<int>(random() % sides.size());
    const int before = separator.value();
    const int gain = separator.gain(v);
    separator.move(v);
    sides[v] = static_cast<unsigned char>(1 - sides[v]);
    EXPECT_EQ(separator.side(v), sides[v]);
    EXPECT_EQ(separator.value(), before - gain) << "move " << k;
    EXPECT_EQ(ThickSeparator(graph, sides).value(), separator.value()) << "move " << k;
  }
}

TEST(WeightedGraph, ContractingCountsEdgesAndNodesAtBorders) {
  const System system(grid(17, 13), 7);
  WeightedGraph graph = weighted(system.graph);
  for (std::size_t v = 0; v < graph.borders.size(); ++v) graph.borders[v] = static_cast<int>(v % 3);
  const Groups groups = group_neighbours(graph, 6, 0);
  const WeightedGraph edges = contract(graph, groups);
  const WeightedGraph nodes = contract_nodes(graph, groups);
  ASSERT_EQ(edges.neighbours, nodes.neighbours);
  for (int g = 0; g < edges.size(); ++g) {
    int weight = 0;
    int border_weight = 0;
    for (int m = groups.starts[g]; m < groups.starts[g + 1]; ++m) {
      EXPECT_EQ(groups.of_node[groups.nodes[m]], g);
      weight += graph.weights[groups.nodes[m]];
      border_weight += graph.borders[groups.nodes[m]];
    }
    EXPECT_EQ(edges.weights[g], weight);
    EXPECT_EQ(edges.borders[g], border_weight);
    EXPECT_LE(weight, 6);
    for (int e = edges.starts[g]; e < edges.starts[g + 1]; ++e) {
      const int other = edges.neighbours[e];
      int count = 0;
      std::set<int> border;
      for (int v = 0; v < graph.size(); ++v) {
        for (int f = graph.starts[v]; f < graph.starts[v + 1]; ++f) {
          const int u = graph.neighbours[f];
          if (groups.of_node[v] != g || groups.of_node[u] != other) continue;
          ++count;
          border.insert({v, u});
        }
      }
      int weight_of_border = 0;
      for (const int v : border) weight_of_border += graph.weights[v];
      EXPECT_EQ(edges.edge_weights[e], count);
      EXPECT_EQ(nodes.edge_weights[e], weight_of_border);
    }
  }
}

// Checks by explicit elimination that each unknown has the minimum degree of the remaining ones.
TEST(LeafOrder, TakesTheLeastDegreeAndCountsWhatIsAround) {
  const System system(grid(20, 20), 9);
  std::vector<int> leaf;
  for (int u = 0; u < system.graph.unknowns; ++u) {
    const Index v = system.unknowns.vertices[u];
    if (v % 20 >= 5 && v % 20 < 13 && v / 20 >= 4 && v / 20 < 14) leaf.push_back(u);
  }
  std::vector<int> order = leaf;
  LeafOrder leaf_order(system.graph);
  leaf_order.sort(order);
  std::vector<int> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, leaf);
  auto graph = coupled(system.graph);
  std::set<int> left(leaf.begin(), leaf.end());
  for (const int v : order) {
    for (const int u : left) EXPECT_LE(graph[v].size(), graph[u].size());
    for (const int a : graph[v]) {
      graph[a].insert(graph[v].begin(), graph[v].end());
      graph[a].erase(a);
      graph[a].erase(v);
    }
    left.erase(v);
  }
}

TEST(LeafOrder, OrdersASetThatIsTooLargeForItsMethod) {
  const System system(fan(900));
  std::vector<int> order(static_cast<std::size_t>(system.graph.unknowns));
  std::iota(order.begin(), order.end(), 0);
  LeafOrder(system.graph).sort(order);
  expect_permutation(order, order.size());
}

// Computes the number of operations by its definition, a sum over the fronts.
double operations_of_halving(double separator, double border) {
  double sum = 0;
  double count = 1;
  for (int level = 0; level < 60; ++level, count *= 2) {
    sum += count * front_operations(separator, border);
    border = border / 2 + separator;
    separator /= std::numbers::sqrt2;
  }
  return sum;
}

TEST(CutScore, EstimatesTheSumOfAllFronts) {
  for (const double n : {100.0, 5'000.0}) {
    for (const double border : {0.0, 40.0, 300.0}) {
      const double expected = operations_of_halving(3.0 * std::sqrt(n), border);
      EXPECT_NEAR(patch_operations(n, border), expected, 1e-3 * expected);
    }
  }
  // Minus what is left without its first s pivots, by the definition of a dense factorization.
  double pivots = 0;
  for (int left = 2'000; left > 1'500; --left) pivots += double(left) * left;
  EXPECT_NEAR(front_operations(500, 1'500), pivots, 1e-3 * pivots);
}

}  // namespace
}  // namespace lapwing
