#version 450

// Points of a cloud as small squares that face the camera, drawn as two triangles each.

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };

layout(push_constant) uniform Push {
  mat4 clip_from_points;
  vec2 clip_radius;  // half the size of a square, in clip space
};

// Position in the square; length 1 at the rim of its disk.
layout(location = 0) out vec2 from_middle;

// Corner of the square for each of its six vertices; bit 0 is right, bit 1 is bottom.
const uint kCorners[6] = uint[](0, 1, 2, 2, 1, 3);

// Depth offset, so that a point on the surface is drawn in front of the surface.
const float kNearer = 0.002;

void main() {
  const uint corner = kCorners[gl_VertexIndex % 6];
  from_middle = vec2((corner & 1) == 0 ? -1 : 1, (corner & 2) == 0 ? -1 : 1);
  vec4 place = clip_from_points * vec4(positions[gl_VertexIndex / 6].xyz, 1);
  place.xy += from_middle * clip_radius * place.w;
  place.z += kNearer * place.w;
  gl_Position = place;
}
