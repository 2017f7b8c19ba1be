#version 450
#extension GL_GOOGLE_include_directive : require

#include "ui.glsl"

// The font's picture: four opacities a word, rows from the top.
layout(std430, binding = 2) readonly buffer Atlas { uint atlas[]; };

layout(location = 0) in vec2 atlas_place;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 written;

float opacity(ivec2 texel) {
  const ivec2 inside = clamp(texel, ivec2(0), ivec2(atlas_size) - 1);
  const uint at = uint(inside.y) * atlas_size.x + uint(inside.x);
  return float(bitfieldExtract(atlas[at / 4], int(8 * (at % 4)), 8)) / 255.0;
}

void main() {
  const vec2 texel = atlas_place * vec2(atlas_size) - 0.5;
  const ivec2 first = ivec2(floor(texel));
  const vec2 part = texel - vec2(first);
  const float top = mix(opacity(first), opacity(first + ivec2(1, 0)), part.x);
  const float bottom = mix(opacity(first + ivec2(0, 1)), opacity(first + ivec2(1, 1)), part.x);
  written = vec4(color.rgb, color.a * mix(top, bottom, part.y));
}
