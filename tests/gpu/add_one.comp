#version 450
#extension GL_GOOGLE_include_directive : require

#include "invocation.glsl"

layout(std430, binding = 0) readonly buffer Source { uint source[]; };
layout(std430, binding = 1) writeonly buffer Target { uint target[]; };

layout(push_constant) uniform Push { uint count; };

void main() {
  const uint i = invocation();
  if (i < count) target[i] = source[i] + 1;
}
