#include "lapwing/transplant/seam_zone.h"

#include <algorithm>
#include <cmath>

#include "lapwing/base/errors.h"
#include "lapwing/region/geodesic.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {
namespace {

// Largest fraction of a hole's depth that its collar covers. With a larger fraction, the centre of
// a small hole would be mapped to a whole side of the square.
constexpr double kDeepest = 0.8;

// Factor between successive widths, and number of tries. The smallest tried width is about a tenth
// of the first.
constexpr double kNarrower = 0.85;
constexpr int kMostTries = 15;

bool is_host(Index v, const TransplantJoined& joined) {
  return joined.host_vertices[v] != kNoIndex;
}

Collar collar_of_part(const TransplantJoined& joined, const BoundaryLoop& seam, double width,
                      const std::string& where) {
  std::vector<Triangle> piece;
  std::vector<double> depths(joined.positions.size(), 0.0);
  for (Index v = 0; v < depths.size(); ++v) {
    if (!is_host(v, joined)) depths[v] = joined.depths[v];
  }
  for (std::size_t t = 0; t < joined.topology.triangles.size(); ++t) {
    if (joined.topology.triangle_faces[t] >= joined.host_faces) {
      piece.push_back(joined.topology.triangles[t]);
    }
  }
  // The collar always contains the triangles between the loops, even if the width is 0.
  const double reach = std::max(width, 1e-9 * bounds_of(joined.positions).diagonal());
  return make_collar(piece, seam, depths, reach, where);
}

}  // namespace

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

std::vector<double> distances_in_cut(const TransplantHost& host) {
  std::vector<char> allowed(host.positions.size(), 0);
  for (const Triangle& corners : host.cut) {
    for (const Index v : corners) allowed[v] = 1;
  }
  return geodesic_distances(host.topology, host.positions, host.hole, kNoLimit, allowed);
}

BoundaryLoop seam_of(const TransplantHost& host, const TransplantJoined& joined) {
  const std::vector<Index> of_host = inverse_index(joined.host_vertices, host.positions.size());
  BoundaryLoop seam;
  for (const Index v : host.hole) seam.push_back(of_host[v]);
  return seam;
}

SeamCollars seam_collars(const TransplantHost& host, const TransplantJoined& joined,
                         const BoundaryLoop& seam, std::span<const double> cut_distances,
                         double width, const std::string& where) {
  double depth = 0.0;
  for (const Triangle& corners : host.cut) {
    for (const Index v : corners) {
      if (std::isfinite(cut_distances[v])) depth = std::max(depth, cut_distances[v]);
    }
  }
  return {make_collar(host.cut, host.hole, cut_distances,
                      std::min(width + joined.gap, kDeepest * depth), where),
          collar_of_part(joined, seam, width, where)};
}

double width_that_fits(const TransplantHost& host, const TransplantJoined& joined, double width) {
  const BoundaryLoop seam = seam_of(host, joined);
  const std::vector<double> cut_distances = distances_in_cut(host);
  double narrower = width;
  for (int k = 0; k < kMostTries; ++k) {
    try {
      static_cast<void>(seam_collars(host, joined, seam, cut_distances, narrower, ""));
      return narrower;
    } catch (const InputError&) {
      narrower *= kNarrower;
    }
  }
  return width;
}

}  // namespace lapwing
