#include "lapwing/coating/patch_fades.h"

#include "lapwing/region/geodesic.h"

namespace lapwing {

std::vector<double> fades(const Transition& transition, const Patch& patch,
                          const Topology& topology, std::span<const Eigen::Vector3d> positions) {
  std::vector<double> shares(patch.vertices.size(), 1.0);
  if (transition.width <= 0.0) return shares;
  const VertexSet border = border_of(patch);
  const auto distances = geodesic_distances(topology, positions, border, transition.width,
                                            vertex_mask(positions.size(), patch.vertices));
  for (std::size_t own = 0; own < shares.size(); ++own) {
    shares[own] = fade(transition, distances[patch.vertices[own]]);
  }
  return shares;
}

}  // namespace lapwing
