#include "lapwing/transplant/seam_zone.h"

#include "lapwing/region/geodesic.h"
#include "lapwing/transplant/seam_collars.h"

namespace lapwing {

double free_on_part(const TransplantOptions& options) {
  return options.transition.width + options.padding;
}

double shape_size(const TransplantOptions& options) {
  return 2.0 * (free_on_part(options) + options.padding);
}
double detail_size(const TransplantOptions& options) {
  return 0.25 * shape_size(options);
}

SeamZone seam_zone(const TransplantHost& host, const TransplantJoined& joined,
                   const TransplantOptions& options) {
  SeamZone zone;
  const std::size_t count = joined.positions.size();
  std::vector<char> allowed(count, 0);
  for (Index v = 0; v < count; ++v) allowed[v] = joined.host_vertices[v] != kNoIndex ? 1 : 0;
  zone.seam = seam_of(host, joined);
  zone.distances = geodesic_distances(joined.topology, joined.positions, zone.seam,
                                      options.padding + options.belt, allowed);
  for (Index v = 0; v < count; ++v) {
    const bool is_host = allowed[v] != 0;
    if (!is_host) zone.distances[v] = joined.depths[v];
    const double free = is_host ? options.padding : free_on_part(options);
    const double distance = zone.distances[v];
    if (joined.topology.rings[v].empty() || !(distance <= free + options.belt)) continue;
    zone.region.roi.push_back(v);
    if (distance > free) zone.region.belt.push_back(v);
  }
  return zone;
}

}  // namespace lapwing
