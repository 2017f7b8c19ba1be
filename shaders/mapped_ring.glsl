// A batch of rows, their one-rings, and the points on a source surface to which the vertices are
// mapped (vulkan/mapped_batch.h). Row r is vertex first_row + r; its neighbours are the entries
// [starts[r], starts[r + 1]).

#include "place.glsl"

// For each vertex of the target, three corners and their weights. If all weights are 0, the vertex
// is mapped nowhere.
layout(std430, binding = 1) readonly buffer Corners { uint corners[]; };
layout(std430, binding = 2) readonly buffer PointWeights { real point_weights[]; };
layout(std430, binding = 3) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 4) readonly buffer Neighbours { uint neighbours[]; };

layout(push_constant) uniform Push {
  uint row_count;
  uint first_row;
  uint flag;  // meaning depends on the kernel; 0 if unused
};

bool is_nowhere(uint v) {
  return point_weights[3 * v] == 0 && point_weights[3 * v + 1] == 0 && point_weights[3 * v + 2] == 0;
}

// Returns a position near the point to which v is mapped.
Place anchor_of(uint v) { return place_of(corners[3 * v]); }

// Returns the interpolated position of the point to which v is mapped, minus `anchor`. CPU twin:
// kernels/kernels.h.
real3 offset_from(Place anchor, uint v) {
  real3 offset = real3(0);
  for (uint c = 3 * v; c < 3 * v + 3; ++c) {
    offset += point_weights[c] * difference(anchor, place_of(corners[c]));
  }
  return offset;
}
