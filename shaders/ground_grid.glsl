// Shared by the stages of the ground grid's pipeline and render/renderer.cpp.
layout(push_constant) uniform Push {
  mat4 clip_from_cells;
  vec4 second_axis_color;  // in sRGB; the first axis is always the x axis
  vec2 origin;             // the world's origin, in cells from the centre
  float radius;            // in cells
  float line_width;        // in pixels
};
