#version 450
#extension GL_GOOGLE_include_directive : require

// Computes the drawn positions, rest + displacement, of some vertices of a mesh. Each invocation
// computes one vertex.

#include "invocation.glsl"
#include "place.glsl"

layout(std430, binding = 1) readonly buffer Rest { real rest[]; };  // relative to `origin`
layout(std430, binding = 2) readonly buffer Vertices { uint vertices[]; };
// One vec4 per vertex of the mesh, whose component w is not written.
layout(std430, binding = 3) writeonly buffer Positions { float positions[]; };

layout(push_constant) uniform Push {
  uint vertex_count;
  float origin_x;  // of Rest, relative to that of Positions
  float origin_y;
  float origin_z;
};

void main() {
  const uint v = invocation();
  if (v >= vertex_count) return;
  const real3 at = real3(rest[3 * v], rest[3 * v + 1], rest[3 * v + 2]) + value_of(place_of(v));
  const uint to = 4 * vertices[v];
  positions[to] = float(at.x + origin_x);
  positions[to + 1] = float(at.y + origin_y);
  positions[to + 2] = float(at.z + origin_z);
}
