#version 450
#extension GL_GOOGLE_include_directive : require

// Unit area-weighted normals (twin: kernels/vertex_normals.cpp) of the vertices `which`; zero where
// no triangle around has area. One invocation per vertex.

#include "invocation.glsl"

layout(binding = 0) uniform usamplerBuffer which;
// The triangles around vertex i as fans (vulkan/vertex_normals.h): entries
// [fan_starts[i], fan_starts[i + 1]) of fan_corners.
layout(binding = 1) uniform usamplerBuffer fan_starts;
layout(binding = 2) uniform usamplerBuffer fan_corners;
layout(binding = 3) uniform samplerBuffer positions;
// vec4 per vertex; w stays.
layout(std430, binding = 4) writeonly buffer Normals { float normals[]; };

layout(push_constant) uniform Push { uint vertex_count; };

const uint kFanBegins = 0x80000000u;

void main() {
  const uint m = invocation();
  if (m >= vertex_count) return;
  const int i = int(texelFetch(which, int(m)).x);
  const vec3 here = texelFetch(positions, i).xyz;
  const int end = int(texelFetch(fan_starts, i + 1).x);
  vec3 sum = vec3(0);
  vec3 previous = vec3(0);
  for (int e = int(texelFetch(fan_starts, i).x); e < end; ++e) {
    const uint corner = texelFetch(fan_corners, e).x;
    const vec3 next = texelFetch(positions, int(corner & ~kFanBegins)).xyz - here;
    if ((corner & kFanBegins) == 0) sum += cross(previous, next);
    previous = next;
  }
  const float size = length(sum);
  const vec3 normal = size > 0 ? sum / size : vec3(0);
  normals[4 * i] = normal.x;
  normals[4 * i + 1] = normal.y;
  normals[4 * i + 2] = normal.z;
}
