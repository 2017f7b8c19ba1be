#include "lapwing/region/falloff.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/geodesic.h"

namespace lapwing {
namespace {

// Weights that differ by at most this are considered equal; the difference is a rounding error.
constexpr double kSameWeight = 1e-9;
constexpr double kNearlyAll = 1.0 - 0x1p-53;

// Returns the falloff around `handle` without the vertices of the handle. Its paths use only
// vertices that `allowed` marks.
std::vector<FalloffVertex> falloff_of(const VertexSet& handle, const Transition& falloff,
                                      std::size_t number, std::span<const char> allowed,
                                      const Mesh& mesh) {
  std::vector<FalloffVertex> graded;
  if (!(falloff.width > 0.0)) return graded;
  const std::vector<double> distances =
      geodesic_distances(mesh.topology(), mesh.positions, handle, falloff.width, allowed);
  for (std::size_t v = 0; v < distances.size(); ++v) {
    if (!(distances[v] > 0.0)) continue;
    // In a very wide falloff, the weight could be rounded to 1, which only handle vertices may
    // have.
    const double weight = std::min(1.0 - fade(falloff, distances[v]), kNearlyAll);
    if (weight > 0.0) graded.push_back({static_cast<Index>(v), number, weight});
  }
  return graded;
}

// Returns, for each vertex, the entry with the largest weight, or none if the two largest weights
// are equal. Ascending.
std::vector<FalloffVertex> without_shared(std::vector<FalloffVertex> graded) {
  std::sort(graded.begin(), graded.end(), [](const FalloffVertex& a, const FalloffVertex& b) {
    return std::tuple(a.vertex, -a.weight, a.handle) < std::tuple(b.vertex, -b.weight, b.handle);
  });
  std::vector<FalloffVertex> alone;
  for (std::size_t k = 0; k < graded.size();) {
    std::size_t next = k + 1;
    while (next < graded.size() && graded[next].vertex == graded[k].vertex) ++next;
    const bool tied = next > k + 1 && graded[k].weight - graded[k + 1].weight <= kSameWeight;
    if (!tied) alone.push_back(graded[k]);
    k = next;
  }
  return alone;
}

}  // namespace

void split_by_field(const VertexSet& region, std::span<const double> field, std::size_t handle,
                    const std::string& where, VertexSet& full, std::vector<FalloffVertex>& graded) {
  full.clear();
  double largest = 0.0;
  for (const Index v : region) {
    const double weight = field[v];
    largest = std::max(largest, weight);
    if (weight == 1.0) {
      full.push_back(v);
    } else if (weight > 0.0) {
      graded.push_back({v, handle, weight});
    }
  }
  if (!full.empty()) return;
  if (largest == 0.0) {
    throw InputError(where +
                     ": all vertices of the handle have weight 0. Paint some with weight 1");
  }
  std::ostringstream text;
  text << where << ": no vertex of the handle has weight 1; the largest weight is " << largest
       << ". Divide the field by it";
  throw InputError(text.str());
}

void require_falloff(const Falloff& falloff, const std::string& where) {
  if (falloff.weight && !is_weight(*falloff.weight)) {
    std::ostringstream text;
    text << where << ": expected " << kWeightWords << ", got " << *falloff.weight;
    throw InputError(text.str());
  }
  if (!falloff.transition) return;
  const double width = falloff.transition->width;
  if (!(width >= 0.0) || !std::isfinite(width)) {
    throw InputError(where + ": expected a falloff width of 0 or more, got " +
                     std::to_string(width));
  }
  if (!falloff.field.empty()) {
    throw InputError(where +
                     ": the handle has both painted weights and a falloff. Remove one of the two");
  }
}

std::vector<FalloffVertex> falloff_around(std::span<const FadingHandle> handles,
                                          std::vector<FalloffVertex> painted, const VertexSet& roi,
                                          std::span<const Index> held, const Mesh& mesh) {
  const bool any_fades = std::any_of(handles.begin(), handles.end(),
                                     [](const auto& handle) { return handle.falloff.has_value(); });
  if (painted.empty() && !any_fades) return {};
  std::vector<char> allowed = vertex_mask(mesh.vertex_count(), roi);
  const auto allow = [&](std::span<const Index> vertices, char allows) {
    for (const Index v : vertices) allowed[v] = allows;
  };
  allow(held, 0);
  for (const FadingHandle& handle : handles) allow(handle.full, 0);
  std::vector<FalloffVertex> graded = std::move(painted);
  for (std::size_t h = 0; h < handles.size(); ++h) {
    const auto& [full, falloff] = handles[h];
    if (!falloff) continue;
    allow(full, 1);
    const std::vector<FalloffVertex> around = falloff_of(full, *falloff, h, allowed, mesh);
    graded.insert(graded.end(), around.begin(), around.end());
    allow(full, 0);
  }
  std::erase_if(graded, [&](const FalloffVertex& g) { return allowed[g.vertex] == 0; });
  return without_shared(std::move(graded));
}

}  // namespace lapwing
