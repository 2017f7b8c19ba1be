#pragma once

#include <span>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing {

/// The region that moves when a user pulls at one place of a surface.
struct GrabRegion {
  double radius = 0.0;   ///< geodesic radius of its disk around the grabbed vertex
  VertexSet vertices;    ///< the disk and `cut_off`
  VertexSet cut_off;     ///< parts that the disk cuts off from the rest, such as a limb's tip
  bool is_limb = false;  ///< whether the shape bounds the region, not the brush
};

/// Chooses a region around `center` for a brush of the geodesic radius `brush`.
///
/// The length of the geodesic circles around `center` tells where a limb ends. On a limb it is
/// nearly constant, and where the limb joins the body it increases. The region ends there: after
/// the longest interval of radii in which the length differs from its median by at most a third.
/// The interval must be at least two brush radii long, begin within three brush radii and end
/// within ten. Its end must be more than 2.5 times as far as its start, which excludes planes and
/// cones. Without such an interval, the region's radius is three brush radii. `factor` scales the
/// radius. The disk never covers more than half of the component's area.
///
/// The disk may separate parts from the component's largest remaining part. Each part with less
/// than half of that area belongs to the region.
///
/// Takes O(n log n) time for the n vertices that it visits: those up to the end of the limb or up
/// to five brush radii, and about as many of the others. If the disk cuts off parts, it visits all
/// vertices of the component. Throws InputError if `center` is not a vertex of a triangle, or
/// unless `brush` and `factor` are finite and positive.
GrabRegion grab_region(const Topology& topology, std::span<const Eigen::Vector3d> positions,
                       Index center, double brush, double factor = 1.0);

}  // namespace lapwing
