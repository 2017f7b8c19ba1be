#version 450
#extension GL_GOOGLE_include_directive : require

// Computes corner or vertex gl_VertexIndex of a triangle list, which it reads from storage buffers.

#include "srgb.glsl"
#include "surface.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Normals { vec4 normals[]; };
layout(std430, binding = 2) readonly buffer Triangles { uint corners[]; };
layout(std430, binding = 3) readonly buffer Classes { uint classes[]; };
layout(std430, binding = 4) readonly buffer Scalars { float scalars[]; };
layout(std430, binding = 5) readonly buffer Edges { uint edges[]; };
// Per corner. The fragment shader uses binding 6.
layout(std430, binding = 7) readonly buffer CornerSources { uint corner_sources[]; };
layout(std430, binding = 8) readonly buffer CornerPlaces { vec2 corner_places[]; };
layout(std430, binding = 10) readonly buffer CornerNormals { uint corner_normals[]; };

// A software device always writes and reads whole locations, so the outputs are packed into few
// locations.
layout(location = 0) out vec3 view_position;
layout(location = 0, component = 3) out float scalar;  // in [0, 1] over the colour map's range
layout(location = 1) out vec3 view_normal;
layout(location = 1, component = 3) out float held;  // handle weight of a graded vertex
layout(location = 2) out vec3 barycentric;
layout(location = 3) out vec4 class_weights;  // outside, ROI, belt, handle
layout(location = 4) flat out uint shown_edges;
// The source of the file's colour, and its value: the colour in linear light, or the texture
// coordinates in an image. All corners of a triangle have the same source, except if it is a
// colour.
layout(location = 4, component = 1) flat out uint file_source;
layout(location = 5) out vec3 file_value;

vec3 rotate_to_view(vec3 v) {
  return vec3(dot(view_from_surface[0].xyz, v), dot(view_from_surface[1].xyz, v),
              dot(view_from_surface[2].xyz, v));
}

// Returns the normal of corner gl_VertexIndex. If the style is flat or the corner has no normal,
// returns the normal of its triangle, whose first corner is `first`.
vec3 corner_normal(uint first) {
  const vec3 normal = normals[corner_normals[gl_VertexIndex]].xyz;
  if (!has(kFlat) && normal != vec3(0)) return normal;
  const vec3 a = positions[corners[first]].xyz;
  const vec3 across = cross(positions[corners[first + 1]].xyz - a,
                            positions[corners[first + 2]].xyz - a);
  const float size = length(across);
  return size > 0 ? across / size : normal;
}

void main() {
  const uint corner = gl_VertexIndex % 3;
  uint vertex = gl_VertexIndex;
  if (!by_vertex) vertex = corners[gl_VertexIndex];
  const vec3 position = positions[vertex].xyz;
  view_position = rotate_to_view(position) +
                  vec3(view_from_surface[0].w, view_from_surface[1].w, view_from_surface[2].w);
  vec3 normal;
  if (by_vertex) {
    normal = normals[vertex].xyz;
  } else {
    normal = corner_normal(gl_VertexIndex - corner);
  }
  view_normal = rotate_to_view(normal);
  barycentric = vec3(corner == 0, corner == 1, corner == 2);
  const uint class_word = has(kRegions) ? classes[vertex] : 0;
  class_weights = vec4(equal(uvec4(0, 1, 2, 3), uvec4(class_word & 255u)));
  held = float(class_word >> 8) / 255.0;
  scalar = has(kScalar) ? (scalars[vertex] - scalar_low) * scalar_scale : 0.0;
  shown_edges = has(kWireframe) ? edges[gl_VertexIndex / 3] : 0;
  file_source = has(kFileColor) ? corner_sources[gl_VertexIndex] : 0;
  file_value = vec3(0);
  if (file_source >> 24 == kSourceColor) file_value = linear_of(unpackUnorm4x8(file_source).rgb);
  if (file_source >> 24 == kSourceImage) file_value.xy = corner_places[gl_VertexIndex];
  gl_Position = clip_from_surface * vec4(position, 1);
}
