#include "lapwing/region/region_components.h"

#include <algorithm>

#include "lapwing/base/cancellation.h"

namespace lapwing {

std::vector<VertexSet> region_components(const VertexSet& region, const Topology& topology) {
  // A vertex's mark is cleared when it is added to a component.
  std::vector<char> unvisited = vertex_mask(topology.vertex_count(), region);
  std::vector<VertexSet> components;
  CancelCheck cancel_check;
  for (const Index seed : region) {
    cancel_check();
    if (!unvisited[seed] || topology.rings.size(seed) == 0) continue;
    VertexSet component{seed};
    unvisited[seed] = 0;
    for (std::size_t next = 0; next < component.size(); ++next) {
      for (const Index w : topology.rings[component[next]]) {
        if (!unvisited[w]) continue;
        unvisited[w] = 0;
        component.push_back(w);
      }
    }
    std::sort(component.begin(), component.end());
    components.push_back(std::move(component));
  }
  return components;
}

}  // namespace lapwing
