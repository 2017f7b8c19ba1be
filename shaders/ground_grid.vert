#version 450
#extension GL_GOOGLE_include_directive : require

// A square on the ground, drawn as two triangles.

#include "ground_grid.glsl"

layout(location = 0) out vec2 cell;  // position from the centre, in cells of the grid

// Corner of the square for each of its six vertices; bit 0 is right, bit 1 is bottom.
const uint kCorners[6] = uint[](0, 1, 2, 2, 1, 3);

void main() {
  const uint corner = kCorners[gl_VertexIndex];
  cell = radius * vec2((corner & 1) == 0 ? -1 : 1, (corner & 2) == 0 ? -1 : 1);
  gl_Position = clip_from_cells * vec4(cell, 0, 1);
}
