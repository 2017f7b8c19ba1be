#pragma once

#include <string>

#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Returns a surface element (surfel) for each point of a cloud with normals: an equilateral
/// triangle across the normal, made of three triangles around the point. Its inscribed circle
/// reaches about as far as the sixth-nearest neighbour, so neighbouring surfels overlap. Vertex k
/// of the result is point k. The other vertices follow. O(n log n). Throws InputError if the cloud
/// has no normals or too few points; the message begins with `where`. Also throws Cancelled.
Mesh surfels_of(const Mesh& cloud, const std::string& where);

/// Returns the point of the cloud to which a point on a surfel belongs, or "nowhere" if the given
/// point is nowhere.
SurfacePoint point_of_surfel(const SurfacePoint& place);

}  // namespace lapwing
