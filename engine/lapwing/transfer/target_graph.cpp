#include "lapwing/transfer/target_graph.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/deform/modifiers/loose_parts.h"
#include "lapwing/laplacian/weights.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kTrianglesPerTask = 512;

// The weight of a tie; the mean weight of the edges is 1. It is small enough not to deform the
// surface, and large enough to keep the pivots of the factor positive.
constexpr double kTieWeight = 1e-5;

// The weight of a held vertex, relative to the diagonal of the matrix.
constexpr double kHeldWeight = 1e6;

// Each entry of R and S is a column of the harmonic system.
constexpr std::size_t kEntries = 18;

std::size_t entry_of(const Adjacency& rings, Index i, Index j) {
  const auto ring = rings[i];
  return rings.starts[i] +
         static_cast<std::size_t>(std::ranges::lower_bound(ring, j) - ring.begin());
}

}  // namespace

TargetGraph::TargetGraph(const Topology& topology, std::span<const Vector3d> rest,
                         std::vector<double> areas, const VertexSet& held)
    : topology_(topology),
      rest_(rest),
      areas_(std::move(areas)),
      weights_(edge_weights(topology, rest)) {
  std::vector<int> counts(weights_.size(), 0);  // triangles of each edge
  const auto for_edges = [&](const auto& visit) {
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
      const Triangle& corners = topology.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(corners[k], corners[(k + 1) % 3]);
        visit(t, k, entry_of(topology.rings, low, high));
      }
    }
  };
  for_edges([&](std::size_t, std::size_t, std::size_t entry) { ++counts[entry]; });
  shares_.resize(topology.triangles.size());
  for_edges([&](std::size_t t, std::size_t k, std::size_t entry) {
    shares_[t][k] = weights_[entry] / counts[entry];
  });
  split_components();
  factorize(held);
  factorize_unmapped();
}

void TargetGraph::split_components() {
  const Components components = connected_components(topology_.rings);
  std::vector<double> areas(components.count, 0.0);
  for (std::size_t t = 0; t < areas_.size(); ++t) {
    areas[components.of_vertex[topology_.triangles[t][0]]] += areas_[t];
  }
  const auto main = static_cast<Index>(std::ranges::max_element(areas) - areas.begin());
  Adjacency group;
  for (Index t = 0; t < areas_.size(); ++t) {
    if (components.of_vertex[topology_.triangles[t][0]] == main) group.values.push_back(t);
  }
  group.starts.push_back(static_cast<Index>(group.values.size()));
  std::optional<ClosestPoint> surface;  // of the largest component, if there are others
  const Adjacency vertices_of = inverse_lists(components.of_vertex, components.count);
  std::vector<Index> solved;
  for (Index c = 0; c < components.count; ++c) {
    const auto vertices = vertices_of[c];
    if (topology_.rings.size(vertices[0]) == 0) continue;
    const VertexSet part = make_vertex_set({vertices.begin(), vertices.end()});
    if (areas[c] > 0.0) {
      solved.insert(solved.end(), part.begin(), part.end());
      if (c == main) continue;
      if (!surface) surface.emplace(topology_.triangles, rest_, group);
      add_ties(part, *surface);
    } else {
      loose_.push_back(part);
    }
  }
  std::ranges::sort(solved);
  unknowns_ = Unknowns(std::move(solved), topology_.vertex_count());
}

// Adds ties from the vertices of `part` that are close to the main component to its nearest
// vertices.
void TargetGraph::add_ties(const VertexSet& part, const ClosestPoint& main) {
  std::vector<TrianglePoint> nearest;
  std::vector<double> distances;
  Bounds bounds{rest_[part.front()], rest_[part.front()]};
  Index hint = kNoIndex;
  for (const Index v : part) {
    nearest.push_back(main.find(0, rest_[v], Vector3d::Zero(), hint));
    hint = nearest.back().hint;
    distances.push_back((nearest.back().position - rest_[v]).norm());
    bounds.min = bounds.min.cwiseMin(rest_[v]);
    bounds.max = bounds.max.cwiseMax(rest_[v]);
  }
  const double farthest = std::ranges::min(distances) + kContactBand * bounds.diagonal();
  for (std::size_t k = 0; k < part.size(); ++k) {
    if (distances[k] > farthest) continue;
    const auto corner = std::ranges::max_element(nearest[k].weights) - nearest[k].weights.begin();
    ties_.push_back(
        {part[k], topology_.triangles[nearest[k].triangle][static_cast<std::size_t>(corner)]});
  }
}

void TargetGraph::factorize(const VertexSet& held) {
  std::vector<WeightedEdge> edges;
  std::vector<double> diagonal(unknowns_.size(), 0.0);
  const auto add = [&](Index i, Index j, double weight) {
    const auto [low, high] = std::minmax(unknowns_.of_vertex[i], unknowns_.of_vertex[j]);
    edges.push_back({low, high, weight});
    diagonal[low] += weight;
    diagonal[high] += weight;
  };
  for (const Index i : solved()) {
    for (std::size_t e = topology_.rings.starts[i]; e < topology_.rings.starts[i + 1]; ++e) {
      if (const Index j = topology_.rings.values[e]; j > i) add(i, j, weights_[e]);
    }
  }
  for (const auto& [i, j] : ties_) add(i, j, kTieWeight);
  std::vector<double> weights(unknowns_.size(), 0.0);
  if (held.empty()) weights[0] = diagonal[0];  // the result is translated afterwards
  for (const Index v : held) {
    const Index unknown = unknowns_.of_vertex[v];
    if (unknown != kNoIndex) weights[unknown] = kHeldWeight * diagonal[unknown];
  }
  if (!held.empty() && std::ranges::none_of(held, [&](Index v) { return is_solved(v); })) {
    throw InputError(
        "held: no vertex is in a component with counterparts on the source. Choose other "
        "vertices.");
  }
  laplacian_.emplace(std::move(edges), weights);
}

void TargetGraph::factorize_unmapped() {
  std::vector<Index> unmapped;
  std::ranges::copy_if(solved(), std::back_inserter(unmapped), [&](Index v) {
    const auto triangles = topology_.vertex_triangles[v];
    return std::ranges::all_of(triangles, [&](Index t) { return !(areas_[t] > 0.0); });
  });
  unmapped_ = Unknowns(std::move(unmapped), topology_.vertex_count());
  if (unmapped_.size() == 0) return;
  std::vector<WeightedEdge> edges;
  std::vector<double> mapped_neighbours(unmapped_.size(), 0.0);
  for (Index u = 0; u < unmapped_.size(); ++u) {
    const Index i = unmapped_.vertices[u];
    for (std::size_t e = topology_.rings.starts[i]; e < topology_.rings.starts[i + 1]; ++e) {
      const Index other = unmapped_.of_vertex[topology_.rings.values[e]];
      if (other == kNoIndex) mapped_neighbours[u] += weights_[e];
      if (other != kNoIndex && other > u) edges.push_back({u, other, weights_[e]});
    }
  }
  harmonic_.emplace(std::move(edges), mapped_neighbours);
}

std::vector<LinearMap> TargetGraph::complete(std::span<LinearMap> of_triangle) const {
  std::vector<LinearMap> of_vertex = maps_of_vertices(topology_, areas_, of_triangle);
  if (harmonic_) {
    const std::size_t n = unmapped_.size();
    std::vector<double> X(kEntries * n, 0.0);
    for (std::size_t u = 0; u < n; ++u) {
      const Index i = unmapped_.vertices[u];
      LinearMap sum;
      for (std::size_t e = topology_.rings.starts[i]; e < topology_.rings.starts[i + 1]; ++e) {
        const Index j = topology_.rings.values[e];
        if (unmapped_.of_vertex[j] == kNoIndex) sum.add(weights_[e], of_vertex[j]);
      }
      for (std::size_t k = 0; k < 9; ++k) {
        X[k * n + u] = sum.R.data()[k];
        X[(9 + k) * n + u] = sum.S.data()[k];
      }
    }
    harmonic_->solve(X, kEntries);
    for (std::size_t u = 0; u < n; ++u) {
      LinearMap& map = of_vertex[unmapped_.vertices[u]];
      for (std::size_t k = 0; k < 9; ++k) {
        map.R.data()[k] = X[k * n + u];
        map.S.data()[k] = X[(9 + k) * n + u];
      }
    }
  }
  parallel_for(of_triangle.size(), kTrianglesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      if (areas_[t] > 0.0) continue;
      LinearMap sum;
      for (const Index v : topology_.triangles[t]) sum.add(1.0 / 3.0, of_vertex[v]);
      of_triangle[t] = mean_map(sum);
    }
  });
  return of_vertex;
}

// Returns w (T - I) (r_a - r_b) for the edge from each corner a to the next corner b.
std::array<Vector3d, 3> TargetGraph::pulls_of(Index triangle, const LinearMap& map) const {
  const Matrix3d change = map.R * map.S - Matrix3d::Identity();
  const Triangle& corners = topology_.triangles[triangle];
  std::array<Vector3d, 3> pulls;
  for (std::size_t k = 0; k < 3; ++k) {
    pulls[k] = shares_[triangle][k] * (change * (rest_[corners[k]] - rest_[corners[(k + 1) % 3]]));
  }
  return pulls;
}

std::vector<Vector3d> TargetGraph::solve(std::span<const LinearMap> of_triangle,
                                         std::span<const LinearMap> of_vertex,
                                         const CounterpartMotion& counterparts) const {
  std::vector<std::array<Vector3d, 3>> pulls(of_triangle.size());
  parallel_for(pulls.size(), kTrianglesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      pulls[t] = pulls_of(static_cast<Index>(t), of_triangle[t]);
    }
  });
  std::vector<Vector3d> u(rest_.size(), Vector3d::Zero());
  for (std::size_t t = 0; t < pulls.size(); ++t) {
    const Triangle& corners = topology_.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      u[corners[k]] += pulls[t][k];
      u[corners[(k + 1) % 3]] -= pulls[t][k];
    }
  }
  for (const auto& [i, j] : ties_) {
    const Vector3d edge = rest_[i] - rest_[j];
    LinearMap sum;
    sum.add(0.5, of_vertex[i]);
    sum.add(0.5, of_vertex[j]);
    const LinearMap map = mean_map(sum);
    Vector3d was = Vector3d::Zero();
    Vector3d is = Vector3d::Zero();
    if (counterparts.exists[i] != 0 && counterparts.exists[j] != 0) {
      was = counterparts.rest[i] - counterparts.rest[j];
      is = counterparts.posed[i] - counterparts.posed[j];
    }
    const Vector3d pull = kTieWeight * (map.R * (map.S * (edge - was)) + is - edge);
    u[i] += pull;
    u[j] -= pull;
  }
  const std::size_t n = unknowns_.size();
  std::vector<double> X(3 * n);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      X[axis * n + k] = u[solved()[k]][static_cast<Eigen::Index>(axis)];
    }
  }
  laplacian_->solve(X, 3);
  std::ranges::fill(u, Vector3d::Zero());
  for (std::size_t k = 0; k < n; ++k) u[solved()[k]] = {X[k], X[n + k], X[2 * n + k]};
  return u;
}

}  // namespace lapwing
