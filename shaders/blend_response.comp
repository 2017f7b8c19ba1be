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
layout(binding = 1) uniform usamplerBuffer moving;
layout(binding = 2) uniform samplerBuffer rests;
// Per group and axis, one texel for each vertex of the range: four columns of that axis. Neighbours
// in a work group read neighbours in memory.
layout(binding = 3) uniform samplerBuffer basis;
// vec4 per vertex; w stays.
layout(std430, binding = 4) writeonly buffer Positions { float positions[]; };

layout(push_constant) uniform Push { uint vertex_count; };

void main() {
  const uint m = invocation();
  if (m >= vertex_count) return;
  vec3 displacement = vec3(0);
  for (uint g = 0; g < group_count; ++g) {
    const vec4 parameters = groups[g].parameters;
    const int at = int(3 * groups[g].number * vertex_count + m);
    const int next = int(vertex_count);
    displacement += vec3(dot(texelFetch(basis, at), parameters),
                         dot(texelFetch(basis, at + next), parameters),
                         dot(texelFetch(basis, at + 2 * next), parameters));
  }
  const vec3 position = texelFetch(rests, int(m)).xyz + displacement;
  const uint out_at = 4 * texelFetch(moving, int(m)).x;
  positions[out_at] = position.x;
  positions[out_at + 1] = position.y;
  positions[out_at + 2] = position.z;
}
