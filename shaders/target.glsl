// How fragment shaders write colours into a picture (TargetFormat, render/graphics_pipeline.h).

#include "srgb.glsl"

// Colour of attachments, the meshes and points that follow an edited surface, in sRGB.
const vec3 kCarried = vec3(0.36, 0.68, 0.58);

// Whether the shader encodes colours for the target. Otherwise, the target encodes linear light
// itself, which a software device does for every sample of a pixel.
layout(constant_id = 0) const bool shaders_encode = false;

vec3 of_linear(vec3 light) {
  if (shaders_encode) return encoded_of(light);
  return light;
}

vec3 of_encoded(vec3 color) {
  if (shaders_encode) return color;
  return linear_of(color);
}
