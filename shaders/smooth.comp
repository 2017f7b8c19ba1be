#version 450
#extension GL_GOOGLE_include_directive : require

// One step of Chebyshev's iteration from the energy's gradient. CPU twin: CpuDragFrame
// (elastic/drag_frame.cpp). Each invocation computes one vertex.

#include "invocation.glsl"
#include "place.glsl"
#include "moved.glsl"

// Displacements before the last step, in the format of place.glsl.
layout(std430, binding = 2) readonly buffer Last { real last[]; };
// Computed by energy_gradient: x of all unknowns, then y, then z.
layout(std430, binding = 3) readonly buffer Gradient { real gradient[]; };
// Unknown of each vertex, or kNone.
layout(std430, binding = 4) readonly buffer Unknowns { uint unknowns[]; };
// Per unknown; 0 if the unknown only follows the coarse vertices.
layout(std430, binding = 5) readonly buffer InverseDiagonal { real inverse_diagonal[]; };
// Entry of each vertex in Prescribed and Stiffness, or kNone.
layout(std430, binding = 6) readonly buffer Entries { uint entries[]; };
layout(std430, binding = 7) readonly buffer Prescribed { real prescribed[]; };
layout(std430, binding = 8) readonly buffer Stiffness { real stiffness[]; };

layout(push_constant) uniform Push {
  uint vertex_count;
  uint unknown_count;
  float step;
  float momentum;
};

const uint kNone = 0xffffffffu;

// Returns the high part, which is the whole displacement after the first step.
real3 last_of(uint v) {
#ifdef LAPWING_FLOAT64
  const uint at = 3 * v;
#else
  const uint at = 6 * v;
#endif
  return real3(last[at], last[at + 1], last[at + 2]);
}

void main() {
  const uint v = invocation();
  if (v >= vertex_count) return;
  const real3 own = value_of(place_of(v));
  const uint unknown = unknowns[v];
  const real inverse = unknown == kNone ? real(0) : inverse_diagonal[unknown];
  if (inverse == 0) {
    set_moved(v, own);
    return;
  }
  real3 g = real3(gradient[unknown], gradient[unknown_count + unknown],
                  gradient[2 * unknown_count + unknown]);
  const uint entry = entries[v];
  if (entry != kNone) {
    g += stiffness[entry] * (own - real3(prescribed[3 * entry], prescribed[3 * entry + 1],
                                         prescribed[3 * entry + 2]));
  }
  set_moved(v, own + real(momentum) * (own - last_of(v)) - real(step) * inverse * g);
}
