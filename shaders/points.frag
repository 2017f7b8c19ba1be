#version 450
#extension GL_GOOGLE_include_directive : require

#include "target.glsl"

layout(location = 0) in vec2 from_middle;
layout(location = 0) out vec4 written;

// A dark rim separates overlapping points.
const vec3 kRim = vec3(0.12, 0.28, 0.24);
const float kRimFrom = 0.65;

void main() {
  const float distance = length(from_middle);
  if (distance > 1) discard;
  written = vec4(of_encoded(distance < kRimFrom ? kCarried : kRim), 1);
}
