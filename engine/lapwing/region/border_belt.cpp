#include "lapwing/region/border_belt.h"

#include <algorithm>
#include <sstream>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/region/region_components.h"

namespace lapwing {
namespace {

bool touches_outside(Index v, const std::vector<char>& in_roi, const Topology& topology) {
  const auto ring = topology.rings[v];
  return std::any_of(ring.begin(), ring.end(), [&](Index w) { return !in_roi[w]; });
}

void append_border(const VertexSet& component, const std::vector<char>& in_roi,
                   const Topology& topology, std::vector<Index>& border) {
  const std::size_t before = border.size();
  std::copy_if(component.begin(), component.end(), std::back_inserter(border),
               [&](Index v) { return touches_outside(v, in_roi, topology); });
  if (border.size() > before) return;
  std::copy_if(component.begin(), component.end(), std::back_inserter(border),
               [&](Index v) { return on_mesh_boundary(v, topology); });
}

}  // namespace

bool on_mesh_boundary(Index v, const Topology& topology) {
  const auto ring = topology.rings[v];
  return std::any_of(ring.begin(), ring.end(), [&](Index w) {
    int sides = 0;
    for (const Index t : topology.vertex_triangles[v]) {
      const Triangle& triangle = topology.triangles[t];
      if (std::find(triangle.begin(), triangle.end(), w) != triangle.end()) ++sides;
    }
    return sides == 1;
  });
}

VertexSet roi_border(const VertexSet& roi, const Topology& topology) {
  const std::vector<char> in_roi = vertex_mask(topology.vertex_count(), roi);
  std::vector<Index> border;
  for (const VertexSet& component : region_components(roi, topology)) {
    append_border(component, in_roi, topology, border);
  }
  return make_vertex_set(std::move(border));
}

VertexSet resolve_border_belt(const BoundaryAnchors& belt, const VertexSet& roi, const Mesh& mesh) {
  const Topology& topology = mesh.topology();
  if (!(belt.fraction >= 0.0 && belt.fraction <= 1.0)) {
    std::ostringstream text;
    text << belt.where << "/fraction: expected a number from 0 to 1, got " << belt.fraction;
    throw InputError(text.str());
  }
  const std::vector<double> depths =
      geodesic_distances(topology, mesh.positions, roi_border(roi, topology), kNoLimit,
                         vertex_mask(topology.vertex_count(), roi));
  VertexSet vertices;
  for (const VertexSet& component : region_components(roi, topology)) {
    double radius = 0.0;
    CancelCheck cancel_check;
    for (const Index v : component) {
      cancel_check();
      if (depths[v] < kNoLimit) radius = std::max(radius, depths[v]);
    }
    std::copy_if(component.begin(), component.end(), std::back_inserter(vertices),
                 [&](Index v) { return depths[v] <= belt.fraction * radius; });
  }
  return make_vertex_set(std::move(vertices));
}

}  // namespace lapwing
