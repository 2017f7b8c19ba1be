#version 450
#extension GL_GOOGLE_include_directive : require

// Computes half of the energy's gradient with respect to each unknown, gathered over its ring. CPU
// twin: kernels/ring_loops.inl. Each invocation computes one row of a range.

#include "invocation.glsl"
#include "place.glsl"
#include "rotation.glsl"

// For all rows, computed by fit_rotations.
layout(std430, binding = 1) readonly buffer Residuals { real residuals[]; };
layout(std430, binding = 2) readonly buffer Turns { real turns[]; };
// For the rows of the range.
// Unknown of each row, or kNone.
layout(std430, binding = 3) readonly buffer Unknowns { uint unknowns[]; };
layout(std430, binding = 4) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 5) readonly buffer Neighbours { uint neighbours[]; };
layout(std430, binding = 6) readonly buffer Edges { real edges[]; };
layout(std430, binding = 7) readonly buffer ReverseWeights { real reverse_weights[]; };
layout(std430, binding = 8) readonly buffer Stiffness { real stiffness[]; };
// For all rows: S_i - I as xx, yy, zz, yz, xz, xy.
layout(std430, binding = 10) readonly buffer Stretch {
  real stretch[];
};
// x of all unknowns, then y, then z.
layout(std430, binding = 9) writeonly buffer Result { real result[]; };

#include "rotations.glsl"

const uint kNone = 0xffffffffu;

real3 residual_of(uint row) {
  return real3(residuals[3 * row], residuals[3 * row + 1], residuals[3 * row + 2]);
}
real4 turn_of(uint row) {
  return real4(turns[4 * row], turns[4 * row + 1], turns[4 * row + 2], turns[4 * row + 3]);
}

void main() {
  const uint r = invocation();
  if (r >= row_count) return;
  const uint unknown = unknowns[r];
  if (unknown == kNone) return;
  const uint row = first_row + r;
  real3 sum = residual_of(row);
  for (uint k = starts[r]; k < starts[r + 1]; ++k) {
    const uint j = neighbours[k];
    if (j < all_rows) sum -= reverse_weights[k] * residual_of(j);
  }
  if (has(kStiffness)) {
    // Edges point from the row to its neighbours, opposite to those in RingRotations
    // (kernels/kernels.h); the two signs cancel.
    const real4 own = turn_of(row);
    const Place here = place_of(row);
    for (uint k = starts[r]; k < starts[r + 1]; ++k) {
      const uint j = neighbours[k];
      const real3 e = edge_of(k);
      const real3 shift = difference(here, place_of(j));
      real3 off = shift - transform_change(row, own, e);
      if (j < all_rows) off += shift - transform_change(j, turn_of(j), e);
      sum -= stiffness[k] * off;
    }
  }
  result[unknown] = sum.x;
  result[unknown_count + unknown] = sum.y;
  result[2 * unknown_count + unknown] = sum.z;
}
