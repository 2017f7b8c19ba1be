#version 450
#extension GL_GOOGLE_include_directive : require

// positions = rest + sum_k parameters[k] basis[k] (twin: kernels/blend_response.cpp) for a range of
// the moving vertices. One invocation per vertex. The host lists only parameters other than 0.

#include "invocation.glsl"

struct Term {
  uint column;
  float parameter;
};
layout(std430, binding = 0) readonly buffer Terms {
  uint term_count;
  Term terms[];
};
// The rest position and the number of each moving vertex of the range.
struct Rest {
  float x, y, z;
  uint vertex;
};
layout(std430, binding = 1) readonly buffer Rests { Rest rests[]; };
// Per column all x, then all y, then all z of the range: neighbours in a work group read neighbours
// in memory.
layout(std430, binding = 2) readonly buffer Basis { float basis[]; };
layout(std430, binding = 3) writeonly buffer Positions { vec4 positions[]; };

layout(push_constant) uniform Push { uint vertex_count; };

void main() {
  const uint m = invocation();
  if (m >= vertex_count) return;
  vec3 displacement = vec3(0);
  for (uint t = 0; t < term_count; ++t) {
    const uint at = 3 * terms[t].column * vertex_count + m;
    displacement += terms[t].parameter *
                    vec3(basis[at], basis[at + vertex_count], basis[at + 2 * vertex_count]);
  }
  const Rest rest = rests[m];
  positions[rest.vertex] = vec4(vec3(rest.x, rest.y, rest.z) + displacement, 1);
}
