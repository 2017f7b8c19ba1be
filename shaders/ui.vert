#version 450
#extension GL_GOOGLE_include_directive : require

// Computes corner gl_VertexIndex of ImGui's triangles (viewer/window/ui_renderer.cpp).

#include "srgb.glsl"
#include "ui.glsl"

layout(std430, binding = 0) readonly buffer Corners { uint corners[]; };
// Five words per vertex: position in pixels, texture coordinates in the atlas, colour in sRGB.
layout(std430, binding = 1) readonly buffer Vertices { uint words[]; };

layout(location = 0) out vec2 atlas_place;
layout(location = 1) out vec4 color;

void main() {
  const uint at = 5 * corners[gl_VertexIndex];
  const vec2 place = vec2(uintBitsToFloat(words[at]), uintBitsToFloat(words[at + 1]));
  atlas_place = vec2(uintBitsToFloat(words[at + 2]), uintBitsToFloat(words[at + 3]));
  const vec4 encoded = unpackUnorm4x8(words[at + 4]);
  color = vec4(linear_of(encoded.rgb), encoded.a);
  gl_Position = vec4((place - origin) * clip_per_unit - 1, 0, 1);
}
