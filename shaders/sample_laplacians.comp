#version 450
#extension GL_GOOGLE_include_directive : require

// Computes delta_i = sum_j w_ij (v_i - v_j) (eq. 1; CPU twin: kernels/sample_laplacians.cpp). Each
// invocation computes one row.

#include "invocation.glsl"
#include "ring.glsl"

layout(std430, binding = 5) writeonly buffer Laplacians { real laplacians[]; };

void main() {
  const uint r = invocation();
  if (r >= row_count) return;
  const Place here = place_of(rows[r]);
  real3 delta = real3(0);
  for (uint e = starts[r]; e < starts[r + 1]; ++e) {
    delta -= weights[e] * difference(here, place_of(neighbours[e]));
  }
  laplacians[3 * r] = delta.x;
  laplacians[3 * r + 1] = delta.y;
  laplacians[3 * r + 2] = delta.z;
}
