// A batch of rows and their one-rings (vulkan/ring_batch.h). Row r is vertex rows[r], with the
// neighbours and weights of entries [starts[r], starts[r + 1]).

#include "precision.glsl"

// Per vertex: x, y, z in float64, or x, y, z in float32 and what that rounded off.
layout(std430, binding = 0) readonly buffer Positions { real positions[]; };
layout(std430, binding = 1) readonly buffer Rows { uint rows[]; };
layout(std430, binding = 2) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 3) readonly buffer Neighbours { uint neighbours[]; };
layout(std430, binding = 4) readonly buffer Weights { real weights[]; };

layout(push_constant) uniform Push { uint row_count; };

#ifdef LAPWING_FLOAT64
struct Place {
  dvec3 value;
};
Place place_of(uint v) {
  return Place(dvec3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]));
}
dvec3 difference(Place from, Place to) { return to.value - from.value; }
#else
struct Place {
  vec3 high;
  vec3 low;
};
Place place_of(uint v) {
  return Place(vec3(positions[6 * v], positions[6 * v + 1], positions[6 * v + 2]),
               vec3(positions[6 * v + 3], positions[6 * v + 4], positions[6 * v + 5]));
}
// The high parts of neighbours are close, so their difference is exact: the result has float32's
// relative precision however far the mesh lies from the origin.
vec3 difference(Place from, Place to) {
  precise vec3 high = to.high - from.high;
  precise vec3 low = to.low - from.low;
  precise vec3 sum = high + low;
  return sum;
}
#endif
