#version 450
#extension GL_GOOGLE_include_directive : require

#include "srgb.glsl"
#include "ui.glsl"

// The font atlas with four opacities per word, or a colour image with one pixel per word (sRGB with
// red in the lowest byte; opacity in the highest byte). The first row is the top row.
layout(std430, binding = 2) readonly buffer Atlas { uint atlas[]; };

// If true, the atlas is a colour image. Each kind of atlas has a separate pipeline, because a
// software device executes both sides of a branch.
layout(constant_id = 0) const bool colored = false;

// Exponent for the coverage of black text, chosen such that black text looks as bold as white text.
const float kDarkTextExponent = 0.6;

layout(location = 0) in vec2 atlas_place;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 written;

// Returns a colour in linear light, multiplied by its opacity, so that transparent pixels do not
// affect interpolated colours.
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
    // With linear blending, dark text on a bright background looks thin, so its coverage is
    // increased.
    const float brightness = dot(color.rgb, vec3(0.2126, 0.7152, 0.0722));
    const float coverage = pow(there.a, mix(kDarkTextExponent, 1.0, sqrt(brightness)));
    written = vec4(color.rgb, color.a * coverage);
    return;
  }
  written = there.a > 0.0 ? vec4(color.rgb * there.rgb / there.a, color.a * there.a) : vec4(0.0);
}
