// Push constants of the panels' pipeline, shared with viewer/window/ui_renderer.cpp.
layout(push_constant) uniform Push {
  vec2 clip_per_unit;
  vec2 origin;      // point that is shown in the upper left corner
  uvec2 atlas_size;
};
