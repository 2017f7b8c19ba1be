#include "studies/real/held_region.h"

#include <numeric>

#include "lapwing/base/errors.h"
#include "lapwing/region/region_components.h"

namespace lapwing::bench {
namespace {

bool is_held(const EditRegion& component, std::span<const Eigen::Vector3d> positions,
             const Topology& topology) {
  try {
    check_anchors(component, positions, topology, "component");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

HeldRegion held_region(const MovedEnds& ends, std::span<const Eigen::Vector3d> positions,
                       const Topology& topology) {
  VertexSet all(topology.vertex_count());
  std::iota(all.begin(), all.end(), Index{0});
  std::vector<Index> held;
  for (const VertexSet& component : region_components(all, topology)) {
    const EditRegion alone{
        component, intersect(component, ends.belt), {intersect(component, ends.handle)}};
    if (!is_held(alone, positions, topology)) continue;
    held.insert(held.end(), component.begin(), component.end());
  }
  HeldRegion result;
  EditRegion& region = result.region;
  region.roi = make_vertex_set(std::move(held));
  region.belt = intersect(region.roi, ends.belt);
  region.handles.push_back(intersect(region.roi, ends.handle));
  result.left_out = all.size() - region.roi.size();
  if (region.belt.empty()) throw InputError("no component is held by the belt");
  if (region.handles[0].empty()) throw InputError("no component is held by the handle");
  return result;
}

}  // namespace lapwing::bench
