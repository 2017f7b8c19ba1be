#include "lapwing/region/border_belt.h"

#include <algorithm>
#include <numbers>
#include <sstream>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/region/submesh.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// The largest rim is the border of an open surface if a disk of its radius has at least this
// fraction of the surface's area. Otherwise it surrounds a hole. In the meshes of libcgal-demo, the
// fraction exceeds 0.3 for sheets and masks. It is at most 0.11 for the holes of
// `elephant-with-holes` and the neck of `head`.
constexpr double kLeastBorder = 0.2;

// A rim surrounds a hole if its radius is less than this fraction of the largest rim's radius.
constexpr double kSmallRim = 0.5;

bool touches_outside(Index v, const std::vector<char>& in_roi, const Topology& topology) {
  const auto ring = topology.rings[v];
  return std::any_of(ring.begin(), ring.end(), [&](Index w) { return !in_roi[w]; });
}

bool is_boundary_edge(Index v, Index w, const Topology& topology) {
  int sides = 0;
  for (const Index t : topology.vertex_triangles[v]) {
    const Triangle& triangle = topology.triangles[t];
    if (std::find(triangle.begin(), triangle.end(), w) != triangle.end()) ++sides;
  }
  return sides == 1;
}

// A connected component of the mesh boundary.
struct Rim {
  VertexSet vertices;
  double radius = 0.0;  // largest distance of a vertex from the mean of the vertices
};

double radius_of(const VertexSet& vertices, std::span<const Vector3d> positions) {
  Vector3d mean = Vector3d::Zero();
  for (const Index v : vertices) mean += positions[v] / static_cast<double>(vertices.size());
  double radius = 0.0;
  for (const Index v : vertices) radius = std::max(radius, (positions[v] - mean).norm());
  return radius;
}

// Finds the border of an ROI, component by component.
class BorderFinder {
 public:
  BorderFinder(const VertexSet& roi, std::span<const VertexSet> handles, const Mesh& mesh)
      : mesh_(mesh),
        topology_(mesh.topology()),
        handles_(handles),
        in_roi_(vertex_mask(mesh.vertex_count(), roi)),
        in_rim_(mesh.vertex_count(), 0),
        in_handle_(mesh.vertex_count(), 0) {
    for (const VertexSet& handle : handles) {
      for (const Index v : handle) in_handle_[v] = 1;
    }
  }

  void add(const VertexSet& component) {
    const std::size_t before = border_.size();
    std::copy_if(component.begin(), component.end(), std::back_inserter(border_),
                 [&](Index v) { return touches_outside(v, in_roi_, topology_); });
    if (border_.size() == before) add_rims(component);
  }

  VertexSet take_border() { return make_vertex_set(std::move(border_)); }
  std::vector<Index> take_held_holes() { return std::move(held_holes_); }

 private:
  void add_rims(const VertexSet& component) {
    std::vector<Rim> rims = rims_of(component);
    // A rim inside a handle moves with the handle, so it cannot be a fixed border.
    std::erase_if(rims, [&](const Rim& rim) {
      return std::ranges::all_of(rim.vertices, [&](Index v) { return in_handle_[v] != 0; });
    });
    if (rims.empty()) return;
    const double largest = std::ranges::max(rims, {}, &Rim::radius).radius;
    const bool are_holes = std::numbers::pi * largest * largest < kLeastBorder * area_of(component);
    if (are_holes && is_held_by_handles(component)) return;
    for (const Rim& rim : rims) {
      if (rim.radius < kSmallRim * largest) continue;
      border_.insert(border_.end(), rim.vertices.begin(), rim.vertices.end());
      if (are_holes) held_holes_.push_back(rim.vertices.front());
    }
  }

  std::vector<Rim> rims_of(const VertexSet& component) {
    std::vector<Rim> rims;
    for (const Index first : component) {
      if (in_rim_[first] != 0 || !on_mesh_boundary(first, topology_)) continue;
      std::vector<Index> found{first};
      in_rim_[first] = 1;
      for (std::size_t at = 0; at < found.size(); ++at) {
        const Index v = found[at];
        for (const Index w : topology_.rings[v]) {
          if (in_rim_[w] != 0 || !is_boundary_edge(v, w, topology_)) continue;
          in_rim_[w] = 1;
          found.push_back(w);
        }
      }
      rims.push_back({make_vertex_set(std::move(found)), 0.0});
      rims.back().radius = radius_of(rims.back().vertices, mesh_.positions);
    }
    return rims;
  }

  double area_of(const VertexSet& component) const {
    double area = 0.0;
    for (const Index v : component) {
      for (const Index t : topology_.vertex_triangles[v]) {
        const auto& [a, b, c] = topology_.triangles[t];
        if (a != v) continue;
        const Vector3d& p = mesh_.positions[a];
        area += 0.5 * (mesh_.positions[b] - p).cross(mesh_.positions[c] - p).norm();
      }
    }
    return area;
  }

  bool is_held_by_handles(const VertexSet& component) const {
    return std::ranges::count_if(handles_, [&](const VertexSet& handle) {
             return !intersect(component, handle).empty();
           }) >= 2;
  }

  const Mesh& mesh_;
  const Topology& topology_;
  std::span<const VertexSet> handles_;
  std::vector<char> in_roi_;
  std::vector<char> in_rim_;
  std::vector<char> in_handle_;
  std::vector<Index> border_;
  std::vector<Index> held_holes_;
};

}  // namespace

bool on_mesh_boundary(Index v, const Topology& topology) {
  const auto ring = topology.rings[v];
  return std::any_of(ring.begin(), ring.end(),
                     [&](Index w) { return is_boundary_edge(v, w, topology); });
}

BorderBelt resolve_border_belt(const BoundaryAnchors& belt, const VertexSet& roi,
                               std::span<const VertexSet> handles, const Mesh& mesh) {
  const Topology& topology = mesh.topology();
  if (!(belt.fraction >= 0.0 && belt.fraction <= 1.0)) {
    std::ostringstream text;
    text << belt.where << "/fraction: expected a number from 0 to 1, got " << belt.fraction;
    throw InputError(text.str());
  }
  const std::vector<VertexSet> components = region_components(roi, topology);
  BorderFinder finder(roi, handles, mesh);
  for (const VertexSet& component : components) finder.add(component);
  const std::vector<double> depths =
      geodesic_distances(topology, mesh.positions, finder.take_border(), kNoLimit,
                         vertex_mask(topology.vertex_count(), roi));
  VertexSet vertices;
  for (const VertexSet& component : components) {
    double radius = 0.0;
    CancelCheck cancel_check;
    for (const Index v : component) {
      cancel_check();
      if (depths[v] < kNoLimit) radius = std::max(radius, depths[v]);
    }
    std::copy_if(component.begin(), component.end(), std::back_inserter(vertices),
                 [&](Index v) { return depths[v] <= belt.fraction * radius; });
  }
  vertices = make_vertex_set(std::move(vertices));
  for (const VertexSet& handle : handles) vertices = subtract(vertices, handle);
  return {std::move(vertices), finder.take_held_holes()};
}

}  // namespace lapwing
