#include "lapwing/elastic/coarse_surfaces.h"

#include <algorithm>
#include <utility>

namespace lapwing {
namespace {

// Decimation removes no vertices of handles that have at most this many.
constexpr std::size_t kSmallHandle = 16;

enum Group : Index { kFree, kBelt, kFirstHandle };

// Returns the group of each vertex of the mesh; only vertices of the same group may be merged.
// Vertices outside the region, of small handles, and of targets are never merged.
std::vector<Index> groups_of(const EditRegion& region, std::size_t vertices) {
  std::vector<Index> groups(vertices, kKeptGroup);
  for (const Index v : region.roi) groups[v] = kFree;
  for (const Index v : region.belt) groups[v] = kBelt;
  for (std::size_t h = 0; h < region.handles.size(); ++h) {
    const VertexSet& handle = region.handles[h];
    const bool is_small = handle.size() <= kSmallHandle;
    for (const Index v : handle) {
      groups[v] = is_small ? kKeptGroup : kFirstHandle + static_cast<Index>(h);
    }
  }
  for (const Target& target : region.targets) {
    for (const Index v : target.corners) groups[v] = kKeptGroup;
  }
  return groups;
}

std::vector<Triangle> triangles_of(const VertexSet& roi, const Topology& topology) {
  const std::vector<char> in_roi = vertex_mask(topology.vertex_count(), roi);
  std::vector<Triangle> triangles;
  std::copy_if(topology.triangles.begin(), topology.triangles.end(), std::back_inserter(triangles),
               [&](const Triangle& t) {
                 return std::any_of(t.begin(), t.end(), [&](Index v) { return in_roi[v] != 0; });
               });
  return triangles;
}

// A region and its border with local indices, so that the cost of decimation does not depend on the
// size of the mesh.
struct Near {
  NumberedTriangles surface;
  Positions rest;
  std::vector<Index> groups;
  std::size_t outside = 0;
};

Near near_of(const VertexSet& roi, const Topology& topology, const Positions& rest,
             std::span<const Index> groups) {
  Near near{numbered(triangles_of(roi, topology)), {}, {}, 0};
  for (const Index v : near.surface.vertices) {
    near.rest.push_back(rest[v]);
    near.groups.push_back(groups[v]);
    if (!std::binary_search(roi.begin(), roi.end(), v)) ++near.outside;
  }
  return near;
}

std::shared_ptr<CoarseLevel> level_of(const Near& near, Decimated left, const VertexSet& roi,
                                      const std::shared_ptr<const Positions>& rest) {
  if (left.kept.size() > near.outside + roi.size() / 2) return nullptr;
  const std::vector<Index>& vertices = near.surface.vertices;
  CoarseSurface surface;
  surface.owners.assign(rest->size(), kNoIndex);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    surface.owners[vertices[k]] = left.owners[k];
  }
  for (const Index k : left.kept) surface.kept.push_back(vertices[k]);
  for (const Index v : surface.kept) surface.rest.push_back((*rest)[v]);
  Topology& own = surface.topology;
  own.triangles = std::move(left.triangles);
  own.vertex_triangles = triangles_around_vertices(surface.kept.size(), own.triangles);
  own.rings = rings_by_triangles(own.vertex_triangles, own.triangles);
  return std::make_shared<CoarseLevel>(std::move(surface), rest, roi);
}

}  // namespace

EditRegion coarse_region_of(const EditRegion& region, std::span<const Index> coarse_of) {
  const auto kept = [&](const VertexSet& set) {
    VertexSet left;
    for (const Index v : set) {
      if (coarse_of[v] != kNoIndex) left.push_back(coarse_of[v]);
    }
    return left;
  };
  EditRegion coarse;
  coarse.roi = kept(region.roi);
  coarse.belt = kept(region.belt);
  for (const VertexSet& handle : region.handles) coarse.handles.push_back(kept(handle));
  coarse.handle_weights = region.handle_weights;
  for (FalloffVertex graded : region.graded) {
    graded.vertex = coarse_of[graded.vertex];
    if (graded.vertex != kNoIndex) coarse.graded.push_back(graded);
  }
  for (const auto& [vertex, factor] : region.stiffness) {
    if (coarse_of[vertex] != kNoIndex) coarse.stiffness.push_back({coarse_of[vertex], factor});
  }
  for (Target target : region.targets) {
    for (Index& corner : target.corners) corner = coarse_of[corner];
    coarse.targets.push_back(target);
  }
  coarse.hard_targets = region.hard_targets;
  coarse.turns_freely = region.turns_freely;
  return coarse;
}

std::shared_ptr<CoarseLevel> CoarseSurfaces::of(const EditRegion& region, const Topology& topology,
                                                const std::shared_ptr<const Positions>& rest,
                                                std::size_t count) {
  std::vector<Index> groups = groups_of(region, rest->size());
  {
    const std::scoped_lock lock(mutex_);
    if (last_.rest == rest && last_.count == count && last_.groups == groups) return last_.level;
  }
  const Near near = near_of(region.roi, topology, *rest, groups);
  Decimated left = decimate(near.rest, near.surface.triangles, near.groups, count + near.outside);
  const auto level = level_of(near, std::move(left), region.roi, rest);
  const std::scoped_lock lock(mutex_);
  last_ = {rest, count, std::move(groups), level};
  return level;
}

}  // namespace lapwing
