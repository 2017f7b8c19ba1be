#version 450
#extension GL_GOOGLE_include_directive : require

#include "invocation.glsl"

layout(binding = 0) uniform usamplerBuffer source;
layout(std430, binding = 1) writeonly buffer Target { uint target[]; };

layout(push_constant) uniform Push { uint count; };

void main() {
  if (invocation() != 0) return;
  uint sum = 0;
  for (uint i = 0; i < count; ++i) sum += texelFetch(source, int(i)).x;
  target[0] = sum;
}
