#version 450

// One triangle that covers the whole image.

layout(location = 0) out float height;  // 0 at the top, 1 at the bottom

void main() {
  const vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 4 - 1;
  height = corner.y * 0.5 + 0.5;
  gl_Position = vec4(corner, 0, 1);
}
