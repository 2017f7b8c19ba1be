// A batch of rows and their one-rings (vulkan/ring_batch.h). Row r is vertex rows[r]; its
// neighbours and weights are the entries [starts[r], starts[r + 1]).

#include "place.glsl"

layout(std430, binding = 1) readonly buffer Rows { uint rows[]; };
layout(std430, binding = 2) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 3) readonly buffer Neighbours { uint neighbours[]; };
layout(std430, binding = 4) readonly buffer Weights { real weights[]; };

layout(push_constant) uniform Push { uint row_count; };
