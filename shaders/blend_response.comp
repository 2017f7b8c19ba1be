#version 450
#extension GL_GOOGLE_include_directive : require

// positions = rest + sum_k parameters[k] basis[k] (twin: kernels/blend_response.cpp) for a range of
// the moving vertices. One invocation per vertex. Columns come in groups of four; the host lists
// only groups with a parameter other than 0.

#include "invocation.glsl"

struct Group {
  vec4 parameters;
  uint number;
};
layout(std430, binding = 0) readonly buffer Groups {
  uint group_count;
  Group groups[];
};
layout(std430, binding = 1) readonly buffer Moving { uint moving[]; };
layout(std430, binding = 2) readonly buffer Rests { vec4 rests[]; };
// Per group and axis, one entry for each vertex of the range: four columns of that axis. Neighbours
// in a work group read neighbours in memory.
layout(std430, binding = 3) readonly buffer Basis { vec4 basis[]; };
// A vec4 per vertex, whose w stays unchanged.
layout(std430, binding = 4) writeonly buffer Positions { float positions[]; };

layout(push_constant) uniform Push { uint vertex_count; };

void main() {
  const uint m = invocation();
  if (m >= vertex_count) return;
  vec3 displacement = vec3(0);
  for (uint g = 0; g < group_count; ++g) {
    const vec4 parameters = groups[g].parameters;
    const uint at = 3 * groups[g].number * vertex_count + m;
    displacement += vec3(dot(basis[at], parameters), dot(basis[at + vertex_count], parameters),
                         dot(basis[at + 2 * vertex_count], parameters));
  }
  const vec3 position = rests[m].xyz + displacement;
  const uint out_at = 4 * moving[m];
  positions[out_at] = position.x;
  positions[out_at + 1] = position.y;
  positions[out_at + 2] = position.z;
}
