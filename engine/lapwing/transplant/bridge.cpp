#include "lapwing/transplant/bridge.h"

#include <algorithm>
#include <unordered_map>

#include <Eigen/Geometry>

#include "lapwing/base/errors.h"
#include "lapwing/transplant/bridge_solver.h"
#include "lapwing/transplant/weld_loops.h"

namespace lapwing {
namespace {

using bridging::BridgeSolver;
using bridging::Node;
using bridging::Pair;
using bridging::RimLoop;
using bridging::Step;
using Eigen::Vector3d;

// Largest size of a loop; the areas and costs of larger loops would overflow.
constexpr double kLargest = 1e50;

void require_usable(const BridgeLoop& loop, const std::string& where, const std::string& whose) {
  const std::string name = where + ": the " + whose + " loop";
  if (loop.points.size() < 3) {
    throw InputError(name + " has " + std::to_string(loop.points.size()) +
                     " vertices; it needs at least 3");
  }
  for (std::size_t k = 0; k < loop.points.size(); ++k) {
    if (loop.points[k].allFinite()) continue;
    throw InputError(name + " has a non-finite position at index " + std::to_string(k) +
                     "; find and repair it with `lapwing check`");
  }
  const Bounds bounds = bounds_of(loop.points);
  if (!(bounds.diagonal() > 0.0)) {
    throw InputError(name + " has zero length, because all its vertices coincide; choose another");
  }
  if (!(bounds.diagonal() < kLargest)) {
    throw InputError(name + " is too large to compute with; scale the mesh down");
  }
  if (!loop.across.empty() && loop.across.size() != loop.points.size()) {
    throw InputError(name + " has " + std::to_string(loop.across.size()) +
                     " opposite corners for " + std::to_string(loop.points.size()) +
                     " edges; give one per edge or none");
  }
  for (const auto& [a, b] : loop.chords) {
    if (std::max(a, b) < loop.points.size()) continue;
    throw InputError(name + " has a chord from index " + std::to_string(a) + " to " +
                     std::to_string(b) + ", but only " + std::to_string(loop.points.size()) +
                     " vertices");
  }
}

// Marks pairs that must not be welded. If both meshes have an edge between the same two pairs,
// welding both would duplicate this edge, so the pair farther apart is marked. Only two loop edges
// may be merged.
std::vector<char> crowded_welds(const RimLoop& host, const RimLoop& part,
                                const std::vector<Pair>& welds) {
  std::vector<Index> weld_of_host(host.size(), kNoIndex);
  for (Index w = 0; w < welds.size(); ++w) weld_of_host[welds[w][0]] = w;
  std::vector<char> crowded(welds.size(), 0);
  for (const auto& [a, b] : host.edges()) {
    const Index wa = weld_of_host[a];
    const Index wb = weld_of_host[b];
    if (wa == kNoIndex || wb == kNoIndex || crowded[wa] || crowded[wb]) continue;
    const Index ja = welds[wa][1];
    const Index jb = welds[wb][1];
    if (!part.has_edge(ja, jb)) continue;
    const bool forward = host.leads(a, b) && part.leads(ja, jb);
    const bool backward = host.leads(b, a) && part.leads(jb, ja);
    if (forward || backward) continue;
    const auto distance = [&](Index w) {
      return (host.points()[welds[w][0]] - part.points()[welds[w][1]]).norm();
    };
    crowded[distance(wa) > distance(wb) ? wa : wb] = 1;
  }
  return crowded;
}

// Returns whether one vertex is the apex of all triangles on the other loop. The strip would then
// contain an edge twice.
bool is_full_fan(const std::vector<Node>& nodes, std::span<const Step> steps, std::size_t host_size,
                 std::size_t part_size) {
  if (nodes.size() > 1) return false;
  std::size_t run = 0;
  for (std::size_t k = 0; k < 2 * steps.size(); ++k) {
    const Step step = steps[k % steps.size()];
    run = k > 0 && step == steps[(k - 1) % steps.size()] ? run + 1 : 1;
    if (run >= (step == Step::host ? host_size : part_size)) return true;
  }
  return false;
}

// Returns the rung after half of the steps.
Node half_way(const Node& start, std::span<const Step> steps, std::size_t host_size,
              std::size_t part_size) {
  std::size_t i = start.host;
  std::size_t j = start.part;
  for (const Step step : steps.first(steps.size() / 2)) ++(step == Step::host ? i : j);
  return {static_cast<Index>(i % host_size), static_cast<Index>(j % part_size), false};
}

// Smallest relative gain for which a strip counts as better; larger than rounding errors.
constexpr double kGain = 1e-9;

// Returns a strip without welds. The first search passes through the two closest vertices, which a
// Delaunay triangulation would join. The second passes through the opposite edge of that strip.
// Returns the cheaper strip.
bridging::BridgeStrip zip_apart(const BridgeSolver& solver) {
  const auto& host = solver.host();
  const auto& part = solver.part();
  const Pair closest = bridging::closest_pair(host.points(), part.points());
  bridging::BridgeStrip strip = solver.solve({{closest[0], closest[1], false}});
  const Node opposite = half_way(strip.nodes[0], strip.steps, host.size(), part.size());
  bridging::BridgeStrip again = solver.solve({opposite});
  return again.cost < (1.0 - kGain) * strip.cost ? again : strip;
}

bridging::BridgeStrip zip_welded(const BridgeSolver& solver, std::vector<Pair>& welds) {
  while (!welds.empty()) {
    std::vector<Node> nodes;
    for (const Pair& pair : welds) nodes.push_back({pair[0], pair[1], true});
    std::vector<char> blocked = crowded_welds(solver.host(), solver.part(), welds);
    if (std::ranges::find(blocked, 1) == blocked.end()) {
      bridging::BridgeStrip strip = solver.solve(nodes);
      if (strip.blocked.empty()) return strip;
      for (const std::size_t node : strip.blocked) blocked[node] = 1;
    }
    std::size_t w = 0;
    std::erase_if(welds, [&](const Pair&) { return blocked[w++] != 0; });
  }
  return zip_apart(solver);
}

}  // namespace

BridgeLoop bridge_loop(std::span<const Triangle> triangles, std::span<const Vector3d> positions,
                       const BoundaryLoop& loop) {
  BridgeLoop result;
  std::unordered_map<Index, Index> place_of;
  for (Index k = 0; k < loop.size(); ++k) {
    place_of.emplace(loop[k], k);
    result.points.push_back(positions[loop[k]]);
  }
  result.across = result.points;
  const auto count = static_cast<Index>(loop.size());
  for (const Triangle& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto from = place_of.find(triangle[k]);
      const auto to = place_of.find(triangle[(k + 1) % 3]);
      if (from == place_of.end() || to == place_of.end()) continue;
      const Index a = from->second;
      const Index b = to->second;
      if (b == (a + 1) % count) {
        result.across[a] = positions[triangle[(k + 2) % 3]];
      } else if (a != (b + 1) % count) {
        result.chords.push_back({std::min(a, b), std::max(a, b)});
      }
    }
  }
  std::ranges::sort(result.chords);
  result.chords.erase(std::unique(result.chords.begin(), result.chords.end()), result.chords.end());
  return result;
}

Bridge bridge_loops(const BridgeLoop& host, const BridgeLoop& part, const std::string& where,
                    double weld) {
  require_usable(host, where, "host's");
  require_usable(part, where, "part's");
  // Reverse the part's loop, so that both loops have the same direction.
  const RimLoop host_rim(host, false);
  const RimLoop part_rim(part, true);
  const BridgeSolver solver(host_rim, part_rim);
  std::vector<Pair> welds = bridging::weld_loops(host_rim.points(), part_rim.points(), weld);
  bridging::BridgeStrip strip = zip_welded(solver, welds);
  if (is_full_fan(strip.nodes, strip.steps, host_rim.size(), part_rim.size())) {
    strip = solver.solve_with_second_rung(strip.nodes[0]);
  }

  Bridge bridge;
  for (const Pair& pair : welds) bridge.welded.push_back({pair[0], part_rim.original(pair[1])});
  bridge.triangles = solver.triangles(strip);
  return bridge;
}

}  // namespace lapwing
