#version 450
#extension GL_GOOGLE_include_directive : require

// The lines of a grid that fades out towards its rim and where its cells are only a few pixels
// wide.

#include "ground_grid.glsl"
#include "target.glsl"

layout(location = 0) in vec2 cell;
layout(location = 0) out vec4 written;

// In sRGB.
const vec3 kLine = vec3(0.48, 0.50, 0.53);
const vec3 kFirstAxis = vec3(0.85, 0.25, 0.25);
const float kLineOpacity = 0.6;
const float kAxisOpacity = 0.9;

// Returns the fraction of the pixel that a line covers. The distance to it is in cells.
vec2 coverage(vec2 distance, vec2 cells_per_pixel) {
  return clamp(0.5 * line_width + 0.5 - distance / cells_per_pixel, 0.0, 1.0);
}

void main() {
  const vec2 across = dFdx(cell);
  const vec2 down = dFdy(cell);
  const vec2 cells_per_pixel = max(sqrt(across * across + down * down), vec2(1e-6));
  const vec2 lines = coverage(abs(cell - round(cell)), cells_per_pixel) *
                     (1.0 - smoothstep(0.1, 0.4, cells_per_pixel));
  // The first axis is the line on which the second coordinate is 0.
  const vec2 axes = coverage(abs(cell - origin), cells_per_pixel).yx;
  const float fade = 1.0 - smoothstep(0.4, 1.0, length(cell) / radius);
  vec4 color = vec4(kLine, kLineOpacity * max(lines.x, lines.y));
  if (axes.x > 0) color = vec4(kFirstAxis, max(color.a, kAxisOpacity * axes.x));
  if (axes.y > axes.x) color = vec4(second_axis_color.rgb, max(color.a, kAxisOpacity * axes.y));
  written = vec4(of_encoded(color.rgb), fade * color.a);
}
