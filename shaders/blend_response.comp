#version 450
#extension GL_GOOGLE_include_directive : require

// Computes positions = rest + sum_k parameters[k] basis[k] for a range of the moving vertices. CPU
// twin: kernels/blend_response.cpp. Each invocation computes one vertex. Columns are stored in
// groups of four; the host lists only groups that have a parameter other than 0.

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
// For each group and axis, one entry per vertex of the range, with the four columns of that axis.
// Adjacent invocations read adjacent memory.
layout(std430, binding = 3) readonly buffer Basis { vec4 basis[]; };
// One vec4 per vertex, whose component w is not written.
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
