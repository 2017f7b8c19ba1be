#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"

namespace lapwing::bench {

/// All of a mesh as ROI. Belt: the lowest 5% of the vertices in y; handle: the highest 5%.
inline EditRegion whole_mesh_region(const Mesh& mesh) {
  std::vector<Index> by_height(mesh.vertex_count());
  std::iota(by_height.begin(), by_height.end(), 0U);
  EditRegion region;
  region.roi = by_height;
  std::stable_sort(by_height.begin(), by_height.end(),
                   [&](Index a, Index b) { return mesh.positions[a].y() < mesh.positions[b].y(); });
  const auto share = static_cast<std::ptrdiff_t>(mesh.vertex_count() / 20);
  region.belt.assign(by_height.begin(), by_height.begin() + share);
  region.handles.emplace_back(by_height.end() - share, by_height.end());
  std::sort(region.belt.begin(), region.belt.end());
  std::sort(region.handles[0].begin(), region.handles[0].end());
  return region;
}

}  // namespace lapwing::bench
