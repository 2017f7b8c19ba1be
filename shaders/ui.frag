#version 450
#extension GL_GOOGLE_include_directive : require

#include "srgb.glsl"
#include "ui.glsl"

// The font atlas, with four opacities per word, or an image in colours, with one pixel per word
// (red in the lowest byte, in sRGB; opacity in the highest). Rows from the top.
layout(std430, binding = 2) readonly buffer Atlas { uint atlas[]; };

// Whether the atlas is an image in colours. Each kind has a separate pipeline: on a software
// device, a branch that is not taken costs as much as the other.
layout(constant_id = 0) const bool colored = false;

// Exponent for the coverage of black letters, chosen by eye to match white letters on black.
const float kDarkTextExponent = 0.6;

layout(location = 0) in vec2 atlas_place;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 written;

// Returns a colour in linear light, multiplied by its opacity, so that clear pixels do not bleed
// in.
vec4 color_of(ivec2 texel) {
  const ivec2 inside = clamp(texel, ivec2(0), ivec2(atlas_size) - 1);
  const uint at = uint(inside.y) * atlas_size.x + uint(inside.x);
  if (!colored) {
    return vec4(float(bitfieldExtract(atlas[at / 4], int(8 * (at % 4)), 8)) / 255.0);
  }
  const vec4 encoded = unpackUnorm4x8(atlas[at]);
  return vec4(linear_of(encoded.rgb) * encoded.a, encoded.a);
}

void main() {
  const vec2 texel = atlas_place * vec2(atlas_size) - 0.5;
  const ivec2 first = ivec2(floor(texel));
  const vec2 part = texel - vec2(first);
  const vec4 top = mix(color_of(first), color_of(first + ivec2(1, 0)), part.x);
  const vec4 bottom = mix(color_of(first + ivec2(0, 1)), color_of(first + ivec2(1, 1)), part.x);
  const vec4 there = mix(top, bottom, part.y);
  if (!colored && there.a < 1.0) {
    // In linear light, dark letters on a bright ground look thin, so they get more coverage.
    const float brightness = dot(color.rgb, vec3(0.2126, 0.7152, 0.0722));
    const float coverage = pow(there.a, mix(kDarkTextExponent, 1.0, sqrt(brightness)));
    written = vec4(color.rgb, color.a * coverage);
    return;
  }
  written = there.a > 0.0 ? vec4(color.rgb * there.rgb / there.a, color.a * there.a) : vec4(0.0);
}
