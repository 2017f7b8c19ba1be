#include "lapwing/transplant/bridge_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/limits.h"

namespace lapwing::bridging {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Larger grids are searched only near a coarser path. A grid of this many rungs takes milliseconds.
constexpr std::size_t kFullGrid = 100'000;
// The coarser path uses every kStride-th vertex. Rungs within kPad coarse vertices of it are
// searched.
constexpr std::size_t kStride = 4;
constexpr std::size_t kPad = 5;
// Shorter chains are not coarsened.
constexpr std::size_t kShortChain = 64;

// Cost of a fold between two triangles of the strip, relative to their cost, so that the path
// prefers detours. It does not apply between strip and meshes, where a fold is inevitable if the
// part is larger than its hole.
constexpr double kFold = 50.0;
// Lower bound of a triangle's height as a fraction of its rungs, so that the cost is finite.
constexpr double kLeastHeight = 1e-3;

// Returns the cost of the angle between two unit normals, relative to the cost of the triangle: 0.1
// at 45 degrees, 1 at 90 degrees, 4 + `fold` at 180 degrees. Returns 0 if a normal is zero, which
// means unknown.
double bending(const Vector3d& a, const Vector3d& b, double fold) {
  const double cosine = a.dot(b);
  if (cosine == 0.0 && (a.isZero() || b.isZero())) return 0.0;
  const double flat = 1.0 - cosine;
  const double folded = std::max(0.0, -cosine);
  return flat * flat + fold * folded * folded * folded;
}

// The last step of a path to a rung, with the triangle that it adds.
struct Arrival {
  double cost = kInfinity;
  double size = 0.0;  // the triangle's cost without bending; 0 if there is no triangle
  Vector3d normal = Vector3d::Zero();
};

// Returns the triangle on the edge from `from` to `to` with this apex. It is on the left of the
// edge.
Arrival triangle(const Vector3d& from, const Vector3d& to, const Vector3d& apex,
                 const Vector3d& behind) {
  const Vector3d edge = to - from;
  const Vector3d normal = edge.cross(apex - from);
  const double rungs = (apex - from).squaredNorm() + (apex - to).squaredNorm();
  const double length = edge.norm();
  const double twice_area = normal.norm();
  Arrival arrival;
  const double least = kLeastHeight * length * std::sqrt(rungs);
  if (least > 0.0) {
    arrival.size = 0.5 * length * length * rungs / std::max(twice_area, least);
  }
  if (twice_area > 0.0) arrival.normal = normal / twice_area;
  arrival.cost = arrival.size * (1.0 + bending(arrival.normal, behind, 0.0));
  return arrival;
}

// The rungs to search: for each host vertex, a range of part vertices.
struct Band {
  std::vector<std::size_t> low, high;   // both inclusive and ascending
  std::vector<std::size_t> row_starts;  // prefix sums of the ranges' lengths
};

Band finish(Band band) {
  band.row_starts.assign(1, 0);
  for (std::size_t i = 0; i < band.low.size(); ++i) {
    band.row_starts.push_back(band.row_starts.back() + band.high[i] - band.low[i] + 1);
  }
  return band;
}

Band full_band(std::size_t host_edges, std::size_t part_edges) {
  return finish({std::vector<std::size_t>(host_edges + 1, 0),
                 std::vector<std::size_t>(host_edges + 1, part_edges),
                 {}});
}

class Search {
 public:
  Search(const Gap& gap, const Band& band)
      : gap_(gap),
        band_(band),
        a_(gap.host.edge_count()),
        b_(gap.part.edge_count()),
        from_(band.row_starts.back()),
        row_(b_ + 1),
        row_above_(b_ + 1) {}

  // `first` is the step by which a closed strip reaches its first rung, which is also its last
  // rung.
  BridgePath run(std::optional<Step> first) {
    for (std::size_t i = 0; i <= a_; ++i) {
      check_cancelled();
      std::swap(row_, row_above_);
      for (std::size_t j = band_.low[i]; j <= band_.high[i]; ++j) {
        if (i == 0 && j == 0) {
          row_[0] = start(first);
        } else {
          visit(i, j);
        }
      }
    }
    const Rung& last = row_[b_];
    Step step = last[0].cost <= last[1].cost ? Step::host : Step::part;
    if (first) step = *first;
    const double cost = last[static_cast<std::size_t>(step)].cost;
    return {cost < kInfinity ? trace(step) : std::vector<Step>{}, cost};
  }

 private:
  using Rung = std::array<Arrival, 2>;  // indexed by the last step

  Rung start(std::optional<Step> first) const {
    Rung rung;
    if (!first) {
      rung[0].cost = 0.0;
      return rung;
    }
    Arrival& arrival = rung[static_cast<std::size_t>(*first)];
    arrival = *first == Step::host ? host_triangle(a_ - 1, b_) : part_triangle(a_, b_ - 1);
    arrival.cost = 0.0;
    return rung;
  }

  // At a welded end there is no triangle. The adjacent triangle of the mesh is used instead.
  Arrival host_triangle(std::size_t i, std::size_t j) const {
    if ((gap_.starts_welded && i == 0 && j == 0) || (gap_.ends_welded && i + 1 == a_ && j == b_)) {
      return {0.0, 0.0, gap_.host.normals[i]};
    }
    const Positions& p = gap_.host.points;
    return triangle(p[i + 1], p[i], gap_.part.points[j], gap_.host.normals[i]);
  }
  Arrival part_triangle(std::size_t i, std::size_t j) const {
    if ((gap_.starts_welded && i == 0 && j == 0) || (gap_.ends_welded && i == a_ && j + 1 == b_)) {
      return {0.0, 0.0, gap_.part.normals[j]};
    }
    const Positions& p = gap_.part.points;
    return triangle(p[j], p[j + 1], gap_.host.points[i], gap_.part.normals[j]);
  }

  bool is_forbidden(std::size_t i, std::size_t j) const {
    const auto listed = [](const std::vector<char>& list, std::size_t k) {
      return !list.empty() && list[k];
    };
    return (j == 0 && listed(gap_.no_rung_to_part_start, i)) ||
           (j == b_ && listed(gap_.no_rung_to_part_end, i)) ||
           (i == 0 && listed(gap_.no_rung_to_host_start, j)) ||
           (i == a_ && listed(gap_.no_rung_to_host_end, j));
  }

  void visit(std::size_t i, std::size_t j) {
    Rung& rung = row_[j];
    rung = Rung{};
    if (is_forbidden(i, j)) return;
    unsigned char from = 0;
    if (i > 0 && j >= band_.low[i - 1] && j <= band_.high[i - 1]) {
      rung[0] = host_triangle(i - 1, j);
      if (arrive(rung[0], row_above_[j])) from |= 1U;
    }
    if (j > band_.low[i]) {
      rung[1] = part_triangle(i, j - 1);
      if (arrive(rung[1], row_[j - 1])) from |= 2U;
    }
    from_[band_.row_starts[i] + j - band_.low[i]] = from;
  }

  // Adds the cost of the cheaper path to the rung `before`. Returns whether the last step of that
  // path is a part step.
  static bool arrive(Arrival& arrival, const Rung& before) {
    std::array<double, 2> costs{};
    for (std::size_t k = 0; k < 2; ++k) {
      costs[k] = before[k].cost;
      if (costs[k] == kInfinity) continue;
      costs[k] +=
          0.5 * (before[k].size + arrival.size) * bending(before[k].normal, arrival.normal, kFold);
    }
    arrival.cost += std::min(costs[0], costs[1]);
    return costs[1] < costs[0];
  }

  std::vector<Step> trace(Step step) const {
    std::vector<Step> steps;
    for (std::size_t i = a_, j = b_; i > 0 || j > 0;) {
      steps.push_back(step);
      const unsigned char from = from_[band_.row_starts[i] + j - band_.low[i]];
      if (step == Step::host) {
        --i;
        step = (from & 1U) != 0 ? Step::part : Step::host;
      } else {
        --j;
        step = (from & 2U) != 0 ? Step::part : Step::host;
      }
    }
    std::ranges::reverse(steps);
    return steps;
  }

  const Gap& gap_;
  const Band& band_;
  std::size_t a_, b_;
  std::vector<unsigned char> from_;  // bit k: whether a part step precedes the step k
  std::vector<Rung> row_, row_above_;
};

BridgePath search(const Gap& gap, const Band& band) {
  Search search(gap, band);
  if (!gap.closed) return search.run(std::nullopt);
  BridgePath by_host = search.run(Step::host);
  BridgePath by_part = search.run(Step::part);
  return by_part.cost < by_host.cost ? by_part : by_host;
}

// Returns every kStride-th vertex of a chain and its last vertex.
std::vector<std::size_t> thinned(const Chain& chain) {
  const std::size_t stride = chain.points.size() > kShortChain ? kStride : 1;
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < chain.edge_count(); k += stride) kept.push_back(k);
  kept.push_back(chain.edge_count());
  return kept;
}

Chain coarse(const Chain& chain, const std::vector<std::size_t>& kept) {
  Chain result;
  result.points.push_back(chain.points[0]);
  for (std::size_t k = 1; k < kept.size(); ++k) {
    Vector3d normal = Vector3d::Zero();
    for (std::size_t edge = kept[k - 1]; edge < kept[k]; ++edge) normal += chain.normals[edge];
    result.normals.push_back(normal.normalized());
    result.points.push_back(chain.points[kept[k]]);
  }
  return result;
}

// Returns the rungs near a path of the coarse chains.
Band band_around(const std::vector<Step>& steps, const std::vector<std::size_t>& host_kept,
                 const std::vector<std::size_t>& part_kept) {
  const std::size_t rows = host_kept.size();
  std::vector<std::size_t> least(rows, part_kept.size()), most(rows, 0);
  std::size_t i = 0, j = 0;
  const auto note = [&] {
    least[i] = std::min(least[i], j);
    most[i] = std::max(most[i], j);
  };
  note();
  for (const Step step : steps) {
    ++(step == Step::host ? i : j);
    note();
  }
  Band band;
  for (std::size_t row = 0; row + 1 < rows; ++row) {
    const std::size_t low = least[row > kPad ? row - kPad : 0];
    const std::size_t high = most[std::min(row + 1 + kPad, rows - 1)] + kPad;
    const std::size_t first = part_kept[low > kPad ? low - kPad : 0];
    const std::size_t last = part_kept[std::min(high, part_kept.size() - 1)];
    const std::size_t fine = host_kept[row + 1] - host_kept[row] + (row + 2 == rows ? 1 : 0);
    band.low.insert(band.low.end(), fine, first);
    band.high.insert(band.high.end(), fine, last);
  }
  return finish(std::move(band));
}

}  // namespace

BridgePath shortest_bridge(const Gap& gap) {
  const std::size_t a = gap.host.edge_count();
  const std::size_t b = gap.part.edge_count();
  if ((a + 1) * (b + 1) <= kFullGrid) return search(gap, full_band(a, b));
  const std::vector<std::size_t> host_kept = thinned(gap.host);
  const std::vector<std::size_t> part_kept = thinned(gap.part);
  Gap thin;
  thin.host = coarse(gap.host, host_kept);
  thin.part = coarse(gap.part, part_kept);
  thin.starts_welded = gap.starts_welded;
  thin.ends_welded = gap.ends_welded;
  thin.closed = gap.closed;
  BridgePath path = search(gap, band_around(shortest_bridge(thin).steps, host_kept, part_kept));
  if (!path.steps.empty()) return path;
  // If forbidden rungs block the band, search the whole grid.
  require_memory(
      (a + 1) * (b + 1),
      "bridging boundary loops of " + std::to_string(a) + " and " + std::to_string(b) + " edges",
      "remesh around one of them");
  return search(gap, full_band(a, b));
}

}  // namespace lapwing::bridging
