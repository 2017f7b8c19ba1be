#include <algorithm>

#include <Eigen/Geometry>

#include "lapwing/base/errors.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/region/region_components.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Anchors nearer to one line than this share of their extent do not count as holding a turn about
// it: the turn's stiffness falls with the square of the share, to 1e-12 of the system here.
constexpr double kCollinearity = 1e-6;

VertexSet anchors_of(const VertexSet& component, const std::vector<char>& in_roi,
                     const std::vector<char>& is_held, const Topology& topology) {
  std::vector<Index> anchors;
  for (const Index v : component) {
    if (is_held[v]) anchors.push_back(v);
    const auto ring = topology.rings[v];
    std::copy_if(ring.begin(), ring.end(), std::back_inserter(anchors),
                 [&](Index w) { return !in_roi[w]; });
  }
  return make_vertex_set(std::move(anchors));
}

bool are_collinear(const VertexSet& vertices, std::span<const Vector3d> positions) {
  const Vector3d& origin = positions[vertices.front()];
  Vector3d axis = Vector3d::Zero();
  for (const Index v : vertices) {
    const Vector3d offset = positions[v] - origin;
    if (offset.squaredNorm() > axis.squaredNorm()) axis = offset;
  }
  const double extent_squared = axis.squaredNorm();
  // |axis x offset| is the extent times the distance from the line.
  return std::none_of(vertices.begin(), vertices.end(), [&](Index v) {
    return axis.cross(positions[v] - origin).norm() > kCollinearity * extent_squared;
  });
}

std::string describe(const VertexSet& component) {
  return "the component of " + std::to_string(component.size()) +
         (component.size() == 1 ? " vertex, vertex " : " vertices from vertex ") +
         std::to_string(component.front()) + " on";
}

}  // namespace

void check_anchors(const EditRegion& region, std::span<const Vector3d> positions,
                   const Topology& topology, const std::string& where) {
  VertexSet held = region.belt;
  for (const VertexSet& handle : region.handles) held = unite(held, handle);
  const std::vector<char> is_held = vertex_mask(topology.vertex_count(), held);
  const std::vector<char> in_roi = vertex_mask(topology.vertex_count(), region.roi);
  for (const VertexSet& component : region_components(region.roi, topology)) {
    const VertexSet anchors = anchors_of(component, in_roi, is_held, topology);
    if (anchors.empty()) {
      throw InputError(where + ": " + describe(component) +
                       " has no anchor: no handle, belt or vertex outside the roi holds it; add a "
                       "belt there, or leave it out of the roi");
    }
    if (are_collinear(anchors, positions)) {
      throw InputError(where + ": " + describe(component) + " can turn freely: its anchors (" +
                       name_vertices(anchors) +
                       ") lie on one line; add a belt vertex off that line, or leave the "
                       "component out of the roi");
    }
  }
}

}  // namespace lapwing
