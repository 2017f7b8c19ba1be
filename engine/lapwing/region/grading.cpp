#include "lapwing/region/grading.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/geodesic.h"

namespace lapwing {
namespace {

// Weights that differ by no more than this differ by rounding alone.
constexpr double kSameWeight = 1e-9;
constexpr double kNearlyAll = 1.0 - 0x1p-53;

// Returns the falloff around `handle` without the handle's own vertices. It passes only vertices
// that `allowed` marks.
std::vector<GradedVertex> falloff_of(const VertexSet& handle, const Transition& falloff,
                                     std::size_t number, std::span<const char> allowed,
                                     const Mesh& mesh) {
  std::vector<GradedVertex> graded;
  if (!(falloff.width > 0.0)) return graded;
  const std::vector<double> distances =
      geodesic_distances(mesh.topology(), mesh.positions, handle, falloff.width, allowed);
  for (std::size_t v = 0; v < distances.size(); ++v) {
    if (!(distances[v] > 0.0)) continue;
    // In a very wide falloff the weight would round to 1, which is reserved for the handle.
    const double weight = std::min(1.0 - fade(falloff, distances[v]), kNearlyAll);
    if (weight > 0.0) graded.push_back({static_cast<Index>(v), number, weight});
  }
  return graded;
}

// Keeps the entry with the largest weight for each vertex, and none on a tie. Ascending.
std::vector<GradedVertex> without_shared(std::vector<GradedVertex> graded) {
  std::sort(graded.begin(), graded.end(), [](const GradedVertex& a, const GradedVertex& b) {
    return std::tuple(a.vertex, -a.weight, a.handle) < std::tuple(b.vertex, -b.weight, b.handle);
  });
  std::vector<GradedVertex> alone;
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
                    const std::string& where, VertexSet& full, std::vector<GradedVertex>& graded) {
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
    throw InputError(where + ": no vertex of the handle has weight 1, all have 0; paint some");
  }
  std::ostringstream text;
  text << where << ": no vertex of the handle has weight 1, the largest is " << largest
       << "; divide the field by that";
  throw InputError(text.str());
}

void require_grading(const Grading& grading, const std::string& where) {
  if (!is_weight(grading.weight)) {
    std::ostringstream text;
    text << where << ": expected " << kWeightWords << ", got " << grading.weight;
    throw InputError(text.str());
  }
  if (!grading.falloff) return;
  const double width = grading.falloff->width;
  if (!(width >= 0.0) || !std::isfinite(width)) {
    throw InputError(where + ": expected a width of the falloff of 0 or more, got " +
                     std::to_string(width));
  }
  if (!grading.field.empty()) {
    throw InputError(where +
                     ": painted weights stand in place of a falloff; leave out one of the two");
  }
}

std::vector<GradedVertex> graded_around(std::span<const FadingHandle> handles,
                                        std::vector<GradedVertex> painted, const VertexSet& roi,
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
  std::vector<GradedVertex> graded = std::move(painted);
  for (std::size_t h = 0; h < handles.size(); ++h) {
    const auto& [full, falloff] = handles[h];
    if (!falloff) continue;
    allow(full, 1);
    const std::vector<GradedVertex> around = falloff_of(full, *falloff, h, allowed, mesh);
    graded.insert(graded.end(), around.begin(), around.end());
    allow(full, 0);
  }
  std::erase_if(graded, [&](const GradedVertex& g) { return allowed[g.vertex] == 0; });
  return without_shared(std::move(graded));
}

}  // namespace lapwing
