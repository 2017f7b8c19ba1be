// Positions or displacements of vertices (binding 0). Kernels need their differences along edges.

#include "precision.glsl"

// For each vertex: x, y, z in float64, or x, y, z in float32 followed by their rounding errors.
layout(std430, binding = 0) readonly buffer Places { real places[]; };

#ifdef LAPWING_FLOAT64
struct Place {
  dvec3 value;
};
Place place_of(uint v) {
  return Place(dvec3(places[3 * v], places[3 * v + 1], places[3 * v + 2]));
}
dvec3 value_of(Place place) { return place.value; }
// `precise`, so that the compiler does not merge this with a subsequent subtraction.
dvec3 difference(Place from, Place to) {
  precise dvec3 edge = to.value - from.value;
  return edge;
}
#else
struct Place {
  vec3 high;
  vec3 low;
};
Place place_of(uint v) {
  return Place(vec3(places[6 * v], places[6 * v + 1], places[6 * v + 2]),
               vec3(places[6 * v + 3], places[6 * v + 4], places[6 * v + 5]));
}
vec3 value_of(Place place) { return place.high; }
// The high parts of neighbouring vertices are close, so their difference is exact. The result has
// the relative precision of float32, even if the mesh is far from the origin.
vec3 difference(Place from, Place to) {
  precise vec3 high = to.high - from.high;
  precise vec3 low = to.low - from.low;
  precise vec3 sum = high + low;
  return sum;
}
#endif
