#version 450
#extension GL_GOOGLE_include_directive : require

// Computes f(p_i) - sum_j w_ij f(p_j), or only f(p_i) if the flag is set. CPU twin:
// kernels/sample_mapped_laplacians.cpp. Each invocation computes one row.

#include "invocation.glsl"
#include "mapped_ring.glsl"

layout(std430, binding = 5) readonly buffer Weights { real weights[]; };
layout(std430, binding = 6) writeonly buffer Laplacians { real laplacians[]; };

void write_row(uint r, real3 delta) {
  laplacians[3 * r] = delta.x;
  laplacians[3 * r + 1] = delta.y;
  laplacians[3 * r + 2] = delta.z;
}

void main() {
  const uint r = invocation();
  if (r >= row_count) return;
  const uint i = first_row + r;
  if (is_nowhere(i)) {
    write_row(r, real3(0));
    return;
  }
  const Place anchor = anchor_of(i);
  const real3 own = offset_from(anchor, i);
  const real3 value = value_of(anchor) + own;
  if (flag != 0) {
    write_row(r, value);
    return;
  }
  real3 delta = real3(0);
  for (uint e = starts[r]; e < starts[r + 1]; ++e) {
    const uint j = neighbours[e];
    delta += weights[e] * (is_nowhere(j) ? value : own - offset_from(anchor, j));
  }
  write_row(r, delta);
}
