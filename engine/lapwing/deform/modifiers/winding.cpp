#include "lapwing/deform/modifiers/winding.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "lapwing/deform/turn_tracker.h"
#include "lapwing/laplacian/ring_fit.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Above this detail length, a smaller detail length preserves more winding and loses little detail.
constexpr double kSmallDetailLength = 0.045;

// Returns the suggested size of substeps in whole degrees. Substeps are equal, smaller than
// kLargestSettledTurnDegrees, and at most half as large as the current ones.
double suggested_commit_every(const DeformRequest& request, double degrees) {
  const double below_limit = degrees / (std::floor(degrees / kLargestSettledTurnDegrees) + 1.0);
  const double half_part = 0.5 * degrees / static_cast<double>(commit_count(request));
  return std::ceil(std::min(below_limit, half_part));
}

// Returns a shortest edge path through the region from a vertex that does not move to `vertex`.
// Returns an empty path if there is none.
std::vector<Index> path_from_still(const EditRegion& region, const Topology& topology,
                                   Index vertex) {
  std::vector<char> moves = vertex_mask(topology.vertex_count(), region.roi);
  for (const Index v : region.belt) moves[v] = 0;
  std::vector<Index> towards(topology.vertex_count(), kNoIndex);
  std::vector<Index> queue{vertex};
  towards[vertex] = vertex;
  for (std::size_t at = 0; at < queue.size(); ++at) {
    if (moves[queue[at]] == 0) {
      std::vector<Index> path{queue[at]};
      while (path.back() != vertex) path.push_back(towards[path.back()]);
      return path;
    }
    for (const Index w : topology.rings[queue[at]]) {
      if (towards[w] != kNoIndex) continue;
      towards[w] = queue[at];
      queue.push_back(w);
    }
  }
  return {};
}

std::string advice(const DeformRequest& request, double degrees) {
  std::ostringstream text;
  if (!request.parameters.settle) text << "turn \"settle\" on";
  if (!request.parameters.commit_every) {
    const double every = suggested_commit_every(request, degrees);
    text << (request.parameters.settle ? "" : ", and ") << "add \"commit_every\": " << every
         << " (or --commit-every " << every << ")";
  } else if (request.parameters.settle && request.parameters.detail_length > kSmallDetailLength) {
    const double less = std::max(kSmallDetailLength, 0.5 * request.parameters.detail_length);
    text << "set \"detail_length\" to " << less << " (or --detail-length " << less << ")";
  } else if (request.parameters.settle) {
    text << "turn less, or choose a longer region";
  }
  return text.str();
}

}  // namespace

std::optional<double> winding_degrees(const ResolvedRequest& bound, const LargestTurn& largest,
                                      std::span<const Vector3d> start,
                                      std::span<const Vector3d> end) {
  if (largest.turn.degrees <= kFarTurnDegrees) return std::nullopt;
  const Index on_handle = bound.region.handles[largest.handle].front();
  const auto path = path_from_still(bound.region, bound.topology, on_handle);
  if (path.empty()) return std::nullopt;
  double wound = 0.0;
  for (const Index v : path) {
    const Eigen::Quaterniond q(fit_rotation(v, bound.topology.rings[v], start, end));
    // Measures only the turn about the given axis: near a whole turn, a small tilt can change the
    // axis arbitrarily.
    const double turn = 2.0 * std::atan2(q.vec().dot(largest.turn.axis), q.w());
    wound += std::remainder(turn - wound, 2.0 * std::numbers::pi);
  }
  return wound * 180.0 / std::numbers::pi;
}

std::string winding_warning(const DeformRequest& request, const std::optional<double>& wound) {
  const LargestTurn largest = largest_turn(request);
  const double degrees = largest.turn.degrees;
  if (!wound || std::abs(*wound - degrees) <= 180.0) return {};
  std::ostringstream text;
  text << "handle " << largest.handle + 1 << " turns by " << degrees
       << " degrees, but the surface is wound by " << std::lround(*wound)
       << " degrees. To correct this, " << advice(request, degrees);
  return text.str();
}

}  // namespace lapwing
