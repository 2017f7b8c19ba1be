#version 450
#extension GL_GOOGLE_include_directive : require

// Copies `source` to `target`. The benchmark measures the memory bandwidth with this kernel.

#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Source { vec4 source[]; };
layout(std430, binding = 1) writeonly buffer Target { vec4 target[]; };

layout(push_constant) uniform Push { uint count; };

void main() {
  const uint i = invocation();
  if (i < count) target[i] = source[i];
}
