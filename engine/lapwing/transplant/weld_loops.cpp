#include "lapwing/transplant/weld_loops.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "lapwing/base/cancellation.h"

namespace lapwing::bridging {
namespace {

using Eigen::Vector3d;
using Points = std::span<const Vector3d>;

// Points sorted along one axis, for fast nearest-point queries.
class Sweep {
 public:
  Sweep(Points points, Eigen::Index axis) : points_(points), axis_(axis), order_(points.size()) {
    std::iota(order_.begin(), order_.end(), Index{0});
    std::ranges::stable_sort(order_, {}, [&](Index i) { return points_[i][axis_]; });
  }

  // Returns the first of the points nearest to `p` within `reach`, or kNoIndex. Sets `reach` to its
  // distance.
  Index nearest(const Vector3d& p, double& reach) const {
    Index best = kNoIndex;
    const auto middle =
        std::ranges::lower_bound(order_, p[axis_], {}, [&](Index i) { return points_[i][axis_]; });
    const auto consider = [&](Index i) {
      const double distance = (points_[i] - p).norm();
      if (distance > reach || (distance == reach && i >= best)) return;
      reach = distance;
      best = i;
    };
    for (auto at = middle; at != order_.end() && points_[*at][axis_] - p[axis_] <= reach; ++at) {
      consider(*at);
    }
    for (auto at = middle; at != order_.begin() && p[axis_] - points_[*(at - 1)][axis_] <= reach;
         --at) {
      consider(*(at - 1));
    }
    return best;
  }

 private:
  Points points_;
  Eigen::Index axis_;
  std::vector<Index> order_;
};

// Returns the axis along which the bounding box of all points is largest.
Eigen::Index widest_axis(Points a, Points b) {
  Bounds bounds = bounds_of(a);
  const Bounds other = bounds_of(b);
  bounds.min = bounds.min.cwiseMin(other.min);
  bounds.max = bounds.max.cwiseMax(other.max);
  Eigen::Index axis = 0;
  (bounds.max - bounds.min).maxCoeff(&axis);
  return axis;
}

// Returns, per vertex, `share` times the length of its shorter edge.
std::vector<double> reaches(Points loop, double share) {
  std::vector<double> reach(loop.size());
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector3d& before = loop[i > 0 ? i - 1 : loop.size() - 1];
    const Vector3d& after = loop[i + 1 < loop.size() ? i + 1 : 0];
    reach[i] = share * std::min((loop[i] - before).norm(), (after - loop[i]).norm());
  }
  return reach;
}

// Returns the largest subset of `pairs` that contains pair `origin` and whose second entries ascend
// from there, modulo `part_size`. `pairs` must ascend by their first entry.
std::vector<Pair> longest_ascending(const std::vector<Pair>& pairs, std::size_t origin,
                                    std::size_t part_size) {
  const std::size_t count = pairs.size();
  const auto place = [&](std::size_t k) {
    const Index second = pairs[(origin + k) % count][1];
    return (second + part_size - pairs[origin][1]) % part_size;
  };
  // ends[l]: of all ascending sequences of l + 1 pairs, the last pair with the smallest position.
  std::vector<std::size_t> ends{0};
  std::vector<std::size_t> before(count, 0);
  for (std::size_t k = 1; k < count; ++k) {
    const auto at =
        std::lower_bound(ends.begin() + 1, ends.end(), place(k),
                         [&](std::size_t end, std::size_t p) { return place(end) < p; });
    before[k] = *(at - 1);
    if (at == ends.end()) {
      ends.push_back(k);
    } else {
      *at = k;
    }
  }
  std::vector<Pair> kept;
  for (std::size_t k = ends.back(); k != 0; k = before[k]) {
    kept.push_back(pairs[(origin + k) % count]);
  }
  kept.push_back(pairs[origin]);
  std::ranges::sort(kept);
  return kept;
}

// Number of origins that are tried for the largest subset. An unsuitable origin loses only pairs
// that are out of order, which are few.
constexpr std::size_t kOrigins = 16;

}  // namespace

std::vector<Pair> weld_loops(Points host, Points part, double share) {
  const Eigen::Index axis = widest_axis(host, part);
  const Sweep hosts(host, axis);
  const Sweep parts(part, axis);
  const std::vector<double> host_reach = reaches(host, share);
  const std::vector<double> part_reach = reaches(part, share);
  std::vector<Pair> pairs;
  for (Index i = 0; i < host.size(); ++i) {
    check_cancelled();
    double reach = host_reach[i];
    const Index j = parts.nearest(host[i], reach);
    if (j == kNoIndex || reach > part_reach[j]) continue;
    double back = reach;
    if (hosts.nearest(part[j], back) == i) pairs.push_back({i, j});
  }
  std::vector<Pair> best;
  const std::size_t step = std::max<std::size_t>(1, pairs.size() / kOrigins);
  for (std::size_t origin = 0; origin < pairs.size(); origin += step) {
    std::vector<Pair> kept = longest_ascending(pairs, origin, part.size());
    if (kept.size() > best.size()) best = std::move(kept);
    if (best.size() == pairs.size()) break;
  }
  return best;
}

Pair closest_pair(Points host, Points part) {
  const Sweep parts(part, widest_axis(host, part));
  double reach = std::numeric_limits<double>::infinity();
  Pair closest{0, 0};
  for (Index i = 0; i < host.size(); ++i) {
    check_cancelled();
    double distance = reach;
    const Index j = parts.nearest(host[i], distance);
    if (j == kNoIndex || distance >= reach) continue;
    reach = distance;
    closest = {i, j};
  }
  return closest;
}

}  // namespace lapwing::bridging
