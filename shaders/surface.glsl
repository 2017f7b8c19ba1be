// Shared by the stages of the surface pipeline and render/renderer.cpp.
layout(push_constant) uniform Push {
  mat4 clip_from_surface;
  vec4 view_from_surface[3];  // rows
  uint flags;
  float scalar_low;
  float scalar_scale;  // 1 / (high - low)
  float pixels_per_point;
};

const uint kRegions = 1;
const uint kScalar = 2;
const uint kWireframe = 4;
const uint kFlat = 8;
const uint kDiverging = 16;
const uint kOrthographic = 32;
const uint kCarriedColor = 64;
const uint kFileColor = 128;
const uint kXray = 256;
const uint kClayMatcap = 512;
const uint kMetalMatcap = 1024;
const uint kPearlMatcap = 2048;

// Values of the highest byte of a corner's colour source (render/corner_colors.h).
const uint kSourceColor = 1;
const uint kSourceImage = 2;

// Pipelines with fixed flags read them from these constants, so that the compiler removes the code
// for other flags. On a software device, a branch on a push constant would not remove it.
layout(constant_id = 1) const uint fixed_flags = 0;
layout(constant_id = 2) const bool flags_are_fixed = false;

// If true, gl_VertexIndex is the index of a vertex, which has one normal for all its corners.
// Otherwise, it is the index of a corner.
layout(constant_id = 3) const bool by_vertex = false;

bool has(uint flag) { return ((flags_are_fixed ? fixed_flags : flags) & flag) != 0; }
