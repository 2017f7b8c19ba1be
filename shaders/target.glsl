// Defines how fragment shaders write colours to an image (TargetFormat,
// render/graphics_pipeline.h).

#include "srgb.glsl"

// Colour of attachments (meshes and points that follow an edited surface), in sRGB.
const vec3 kCarried = vec3(0.36, 0.68, 0.58);

// If true, the shader encodes colours in sRGB. Otherwise, it writes linear light, which the device
// encodes; a software device then encodes every sample of a pixel.
layout(constant_id = 0) const bool shaders_encode = false;

vec3 of_linear(vec3 light) {
  if (shaders_encode) return encoded_of(light);
  return light;
}

vec3 of_encoded(vec3 color) {
  if (shaders_encode) return color;
  return linear_of(color);
}
