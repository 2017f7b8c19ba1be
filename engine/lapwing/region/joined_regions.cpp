#include "lapwing/region/joined_regions.h"

#include <algorithm>

namespace lapwing {
namespace {

// Invalid vertex indices are not changed; `resolve` reports them.
Index led_vertex(Index v, const JoinedSurface& joined) {
  return v < joined.leaders.size() ? joined.leaders[v] : v;
}

RegionSpec led_spec(const RegionSpec& spec, const JoinedSurface& joined);

// Replaces the vertices of a region form by their leaders; one overload per form.
struct Leading {
  const JoinedSurface& joined;

  AllVertices operator()(const AllVertices& all) const { return all; }
  Box operator()(const Box& box) const { return box; }
  ListedVertices operator()(const ListedVertices& list) const { return {led(list.vertices)}; }
  GeodesicDisk operator()(GeodesicDisk disk) const {
    if (auto* center = std::get_if<Index>(&disk.center)) *center = led_vertex(*center, joined);
    return disk;
  }
  LoopRegion operator()(const LoopRegion& region) const {
    return {led(region.loop), led_vertex(region.inside, joined)};
  }
  UnionRegion operator()(const UnionRegion& region) const { return {led(region.parts)}; }
  DifferenceRegion operator()(const DifferenceRegion& region) const { return {led(region.parts)}; }
  DiskInRegion operator()(const DiskInRegion& region) const { return {led(region.parts)}; }

 private:
  std::vector<Index> led(std::vector<Index> vertices) const {
    for (Index& v : vertices) v = led_vertex(v, joined);
    return vertices;
  }
  std::vector<RegionSpec> led(const std::vector<RegionSpec>& parts) const {
    std::vector<RegionSpec> leading;
    for (const RegionSpec& part : parts) leading.push_back(led_spec(part, joined));
    return leading;
  }
};

// Sets the value of each leader to the largest one among itself and its followers.
void lead_by_largest(std::vector<double>& field, const JoinedSurface& joined) {
  if (field.size() != joined.leaders.size()) return;  // empty or invalid
  for (const Index v : joined.followers) {
    double& of_leader = field[joined.leaders[v]];
    of_leader = std::max(of_leader, field[v]);
  }
}

// Adds an entry for each follower of a vertex in `entries`, which are ascending.
template <typename Entry>
void expand_entries(std::vector<Entry>& entries, const JoinedSurface& joined) {
  std::vector<Entry> all = entries;
  for (const Index v : joined.followers) {
    const Index leader = joined.leaders[v];
    const auto found = std::ranges::lower_bound(entries, leader, {}, &Entry::vertex);
    if (found == entries.end() || found->vertex != leader) continue;
    all.push_back(*found);
    all.back().vertex = v;
  }
  std::ranges::sort(all, {}, &Entry::vertex);
  entries = std::move(all);
}

RegionSpec led_spec(const RegionSpec& spec, const JoinedSurface& joined) {
  RegionSpec leading;
  leading.where = spec.where;
  std::visit([&](const auto& form) { leading.form = Leading{joined}(form); }, spec.form);
  return leading;
}

}  // namespace

VertexSet resolve_leaders(const RegionSpec& spec, const JoinedSurface& joined) {
  VertexSet vertices = resolve(led_spec(spec, joined), joined.surface);
  // A box or "all" contains followers besides their leaders.
  std::erase_if(vertices, [&](Index v) { return joined.is_follower(v); });
  return vertices;
}

RegionSpec led(const RegionSpec& spec, const JoinedSurface& joined) {
  return {ListedVertices{resolve_leaders(spec, joined)}, spec.where};
}

BeltSpec led(const BeltSpec& belt, const JoinedSurface& joined) {
  const auto* region = std::get_if<RegionSpec>(&belt);
  if (region == nullptr) return belt;
  return led(*region, joined);
}

TargetSpec led(TargetSpec targets, const JoinedSurface& joined) {
  for (TargetRow& row : targets.rows) {
    if (auto* vertex = std::get_if<Index>(&row.point)) *vertex = led_vertex(*vertex, joined);
  }
  return targets;
}

Falloff led(Falloff falloff, const JoinedSurface& joined) {
  lead_by_largest(falloff.field, joined);
  return falloff;
}

StiffnessSpec led(StiffnessSpec spec, const JoinedSurface& joined) {
  spec.region = led(spec.region, joined);
  lead_by_largest(spec.field, joined);
  return spec;
}

VertexSet with_followers(const VertexSet& leaders, const JoinedSurface& joined) {
  const std::vector<char> leads = vertex_mask(joined.leaders.size(), leaders);
  VertexSet all = leaders;
  for (const Index v : joined.followers) {
    if (leads[joined.leaders[v]]) all.push_back(v);
  }
  return make_vertex_set(std::move(all));
}

EditRegion with_followers(EditRegion region, const JoinedSurface& joined) {
  const auto expand = [&](VertexSet& set) { set = with_followers(set, joined); };
  expand(region.roi);
  expand(region.belt);
  for (VertexSet& handle : region.handles) expand(handle);
  expand_entries(region.graded, joined);
  expand_entries(region.stiffness, joined);
  for (LoosePart& part : region.loose) expand(part.vertices);
  for (VertexSet& part : region.left_out) expand(part);
  return region;
}

}  // namespace lapwing
