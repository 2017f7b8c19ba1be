#include "lapwing/elastic/coarse_surfaces.h"

#include <algorithm>
#include <utility>

namespace lapwing {
namespace {

// Of a handle of fewer vertices each counts.
constexpr std::size_t kSmallHandle = 16;

enum Group : Index { kFree, kBelt, kFirstHandle };

// Per vertex of the mesh: what it may be merged with. Vertices outside the region stay, as do those
// that something asks of by number.
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
  std::vector<char> in_roi(topology.vertex_count(), 0);
  for (const Index v : roi) in_roi[v] = 1;
  std::vector<Triangle> triangles;
  std::copy_if(topology.triangles.begin(), topology.triangles.end(), std::back_inserter(triangles),
               [&](const Triangle& t) {
                 return std::any_of(t.begin(), t.end(), [&](Index v) { return in_roi[v] != 0; });
               });
  return triangles;
}

// A region and what borders it, in numbers of their own, so that decimating a part of a mesh costs
// no more than that part.
struct Near {
  NumberedTriangles surface;
  Positions rest;
  std::vector<Index> groups;
  std::size_t outside = 0;  // vertices that are not of the region
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

// Whether a surface made for `before` has many vertices that nothing asks for any more.
bool are_many_released(std::span<const Index> before, std::span<const Index> now,
                       std::size_t count) {
  constexpr std::size_t kMany = 20;  // one in
  std::size_t released = 0;
  for (std::size_t v = 0; v < now.size(); ++v) {
    if (before[v] == kKeptGroup && now[v] != kKeptGroup) ++released;
  }
  return kMany * released > count;
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

struct CoarseSurfaces::Begun {
  Begun(std::shared_ptr<const Positions> positions, std::vector<Index> group_of_vertex, Near of)
      : rest(std::move(positions)),
        groups(std::move(group_of_vertex)),
        near(std::move(of)),
        decimator(near.rest, near.surface.triangles, near.groups) {}

  std::shared_ptr<const Positions> rest;
  std::vector<Index> groups;
  Near near;
  Decimator decimator;
};

CoarseSurfaces::CoarseSurfaces() = default;
CoarseSurfaces::~CoarseSurfaces() = default;

void CoarseSurfaces::begin(const EditRegion& region, const Topology& topology,
                           const std::shared_ptr<const Positions>& rest) {
  {
    const std::scoped_lock lock(mutex_);
    if (first_.rest != nullptr || begun_ != nullptr) return;
  }
  std::vector<Index> groups = groups_of(region, rest->size());
  Near near = near_of(region.roi, topology, *rest, groups);
  auto begun = std::make_unique<Begun>(rest, std::move(groups), std::move(near));
  const std::scoped_lock lock(mutex_);
  begun_ = std::move(begun);
}

// Null unless it is for those. What is for others is of no use to anyone then.
std::unique_ptr<CoarseSurfaces::Begun> CoarseSurfaces::take_begun(
    const std::shared_ptr<const Positions>& rest, const std::vector<Index>& groups) {
  std::unique_ptr<Begun> begun;
  {
    const std::scoped_lock lock(mutex_);
    begun = std::move(begun_);
  }
  if (begun != nullptr && (begun->rest != rest || begun->groups != groups)) begun.reset();
  return begun;
}

std::shared_ptr<CoarseLevel> CoarseSurfaces::of(const EditRegion& region, const Topology& topology,
                                                const std::shared_ptr<const Positions>& rest,
                                                std::size_t count) {
  std::vector<Index> groups = groups_of(region, rest->size());
  First first;
  {
    const std::scoped_lock lock(mutex_);
    if (last_.rest == rest && last_.count == count && last_.groups == groups) return last_.level;
    first = first_;
  }
  const std::unique_ptr<Begun> begun = take_begun(rest, groups);
  const Near near =
      begun != nullptr ? std::move(begun->near) : near_of(region.roi, topology, *rest, groups);
  const std::size_t vertices = count + near.outside;
  std::optional<Decimated> left;
  if (begun == nullptr && first.rest == rest && !are_many_released(first.groups, groups, count)) {
    left = decimate_again(*first.merges, near.rest, near.surface.triangles, near.groups, vertices);
  }
  if (!left) {
    left = begun != nullptr ? begun->decimator.decimate(vertices)
                            : decimate(near.rest, near.surface.triangles, near.groups, vertices);
    first = {rest, groups, std::make_shared<const MergeHistory>(std::move(left->history))};
  }
  const auto level = level_of(near, *std::move(left), region.roi, rest);
  const std::scoped_lock lock(mutex_);
  first_ = std::move(first);
  last_ = {rest, count, std::move(groups), level};
  return level;
}

}  // namespace lapwing
