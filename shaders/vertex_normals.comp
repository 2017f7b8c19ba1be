#version 450
#extension GL_GOOGLE_include_directive : require

// Computes area-weighted unit normals at the vertices in `which`. CPU twin:
// kernels/vertex_normals.cpp. A normal is zero if all triangles around the vertex have zero area.
// Each invocation computes all normals of one vertex (mesh/split_normals.h).

#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Which { uint which[]; };
// The triangles around vertex i as fans (vulkan/vertex_normals.h): entries
// [fan_starts[i], fan_starts[i + 1]) of fan_corners.
layout(std430, binding = 1) readonly buffer FanStarts { uint fan_starts[]; };
layout(std430, binding = 2) readonly buffer FanCorners { uint fan_corners[]; };
layout(std430, binding = 3) readonly buffer Positions { vec4 positions[]; };
// Each normal is a vec4 whose component w is not written.
layout(std430, binding = 4) writeonly buffer Normals { float normals[]; };

layout(push_constant) uniform Push { uint vertex_count; };

const uint kFanBegins = 0x80000000u;
const uint kNormalBegins = 0x40000000u;

void write(uint number, vec3 sum) {
  const float size = length(sum);
  const vec3 normal = size > 0 ? sum / size : vec3(0);
  normals[4 * number] = normal.x;
  normals[4 * number + 1] = normal.y;
  normals[4 * number + 2] = normal.z;
}

void main() {
  const uint m = invocation();
  if (m >= vertex_count) return;
  const uint i = which[m];
  const vec3 here = positions[i].xyz;
  const uint end = fan_starts[i + 1];
  uint number = i;
  vec3 sum = vec3(0);
  vec3 previous = vec3(0);
  for (uint e = fan_starts[i]; e < end; ++e) {
    const uint corner = fan_corners[e];
    if ((corner & kNormalBegins) != 0) {
      write(number, sum);
      number = corner & ~kNormalBegins;
      sum = vec3(0);
      continue;
    }
    const vec3 next = positions[corner & ~kFanBegins].xyz - here;
    if ((corner & kFanBegins) == 0) sum += cross(previous, next);
    previous = next;
  }
  write(number, sum);
}
