#version 450

// Rectangles of one colour (render/overlay.h), drawn as two triangles each.

struct Rectangle {
  vec4 corners;  // left, top, right, bottom in pixels
  vec4 color;
};
layout(std430, binding = 0) readonly buffer Rectangles { Rectangle rectangles[]; };

layout(push_constant) uniform Push { vec2 clip_per_pixel; };

layout(location = 0) flat out vec4 color;

// Corner of the rectangle for each of its six vertices; bit 0 is right, bit 1 is bottom.
const uint kCorners[6] = uint[](0, 1, 2, 2, 1, 3);

void main() {
  const Rectangle rectangle = rectangles[gl_VertexIndex / 6];
  const uint corner = kCorners[gl_VertexIndex % 6];
  const vec2 pixel = vec2((corner & 1) == 0 ? rectangle.corners.x : rectangle.corners.z,
                          (corner & 2) == 0 ? rectangle.corners.y : rectangle.corners.w);
  color = rectangle.color;
  gl_Position = vec4(pixel * clip_per_pixel - 1, 0, 1);
}
