#include <algorithm>

#include <Eigen/Geometry>

#include "lapwing/base/errors.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/region/submesh.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Anchors that are closer to a line than this fraction of their extent do not prevent a rotation
// about it. The stiffness of this rotation is proportional to the square of the fraction, here
// 1e-12 of the system's.
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
         (component.size() == 1 ? " vertex, vertex " : " vertices that contains vertex ") +
         std::to_string(component.front());
}

// A component of the ROI. `fault` describes why the component cannot be solved for, or is empty.
struct CheckedComponent {
  VertexSet vertices;
  std::string fault;
  bool has_anchor;
};

std::vector<CheckedComponent> checked_components(const EditRegion& region,
                                                 std::span<const Vector3d> positions,
                                                 const Topology& topology) {
  std::vector<char> is_held = vertex_mask(topology.vertex_count(), region.belt);
  for (const VertexSet& handle : region.handles) {
    for (const Index v : handle) is_held[v] = 1;
  }
  for (const Index v : corners_of(region.targets)) is_held[v] = 1;
  const std::vector<char> in_roi = vertex_mask(topology.vertex_count(), region.roi);
  std::vector<CheckedComponent> components;
  for (VertexSet& component : region_components(region.roi, topology)) {
    const VertexSet anchors = anchors_of(component, in_roi, is_held, topology);
    std::string fault;
    if (anchors.empty()) {
      fault = describe(component) +
              " has no anchor: no handle, belt or vertex outside the ROI holds it. Add a belt "
              "there, or remove the component from the ROI";
    } else if (are_collinear(anchors, positions)) {
      fault = describe(component) + " can turn freely: its anchors (" + name_vertices(anchors) +
              ") lie on one line. Add a belt vertex off that line, or remove the component from "
              "the ROI";
    }
    components.push_back({std::move(component), std::move(fault), !anchors.empty()});
  }
  return components;
}

LoosePart loose_part(VertexSet vertices, const EditRegion& region,
                     std::span<const Vector3d> positions, const Topology& topology) {
  LoosePart part{std::move(vertices), {}};
  const std::size_t stays = region.handles.size();
  for (std::size_t h = 0; h < stays; ++h) {
    for (const Index v : intersect(part.vertices, region.handles[h])) {
      part.anchors.push_back({v, h, Vector3d::Zero()});
    }
  }
  for (const Index v : intersect(part.vertices, region.belt))
    part.anchors.push_back({v, stays, Vector3d::Zero()});
  for (const Target& target : region.targets) {
    if (!std::binary_search(part.vertices.begin(), part.vertices.end(), target.corners[0]))
      continue;
    part.anchors.push_back(
        {target.corners[0], stays, target.position - point_of(target, positions)});
  }
  // Neighbours outside the ROI are also fixed.
  VertexSet outside =
      subtract(make_vertex_set(with_ring_neighbours(part.vertices, topology.rings)), part.vertices);
  for (const Index v : outside) part.anchors.push_back({v, stays, Vector3d::Zero()});
  return part;
}

}  // namespace

void check_anchors(const EditRegion& region, std::span<const Vector3d> positions,
                   const Topology& topology, const std::string& where) {
  for (const CheckedComponent& component : checked_components(region, positions, topology)) {
    if (component.fault.empty() || (region.turns_freely && component.has_anchor)) continue;
    throw InputError(where + ": " + component.fault, component.vertices);
  }
}

void separate_loose_parts(EditRegion& region, std::span<const Vector3d> positions,
                          const Topology& topology, LoosePolicy policy, const std::string& where) {
  std::vector<CheckedComponent> components = checked_components(region, positions, topology);
  const auto first_fault = std::find_if(components.begin(), components.end(),
                                        [](const auto& c) { return !c.fault.empty(); });
  if (first_fault == components.end()) return;
  if (policy == LoosePolicy::refuse) {
    throw InputError(where + ": " + first_fault->fault, first_fault->vertices);
  }
  EditRegion held = region;
  held.turns_freely = std::none_of(components.begin(), components.end(),
                                   [](const auto& c) { return c.fault.empty(); });
  std::vector<Index> aside;
  for (CheckedComponent& component : components) {
    if (component.fault.empty() || (held.turns_freely && component.has_anchor)) continue;
    aside.insert(aside.end(), component.vertices.begin(), component.vertices.end());
    if (policy == LoosePolicy::carry) {
      held.loose.push_back(loose_part(std::move(component.vertices), region, positions, topology));
    } else {
      held.left_out.push_back(std::move(component.vertices));
    }
  }
  const VertexSet loose = make_vertex_set(std::move(aside));
  std::erase_if(held.graded, [&](const FalloffVertex& graded) {
    return std::binary_search(loose.begin(), loose.end(), graded.vertex);
  });
  std::erase_if(held.targets, [&](const Target& target) {
    return std::binary_search(loose.begin(), loose.end(), target.corners[0]);
  });
  held.roi = subtract(held.roi, loose);
  held.belt = subtract(held.belt, loose);
  for (VertexSet& handle : held.handles) {
    handle = subtract(handle, loose);
    if (handle.empty()) throw InputError(where + ": " + first_fault->fault);
  }
  region = std::move(held);
}

}  // namespace lapwing
