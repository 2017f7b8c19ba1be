#version 450

// Computes corner gl_VertexIndex of a triangle list, and the index of its triangle.

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Triangles { uint corners[]; };

layout(push_constant) uniform Push { mat4 clip_from_surface; };

layout(location = 0) flat out uint triangle;

void main() {
  triangle = gl_VertexIndex / 3;
  gl_Position = clip_from_surface * vec4(positions[corners[gl_VertexIndex]].xyz, 1);
}
