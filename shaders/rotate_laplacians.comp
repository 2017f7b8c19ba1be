#version 450
#extension GL_GOOGLE_include_directive : require

// What the rotations of the rings ask of each unknown, a gather over its ring (twin:
// kernels/rotate_laplacians.cpp). One invocation per row of a range.

#include "invocation.glsl"
#include "precision.glsl"
#include "rotation.glsl"

// Of all rows, from fit_rotations.
layout(std430, binding = 0) readonly buffer Turned { real turned[]; };
layout(std430, binding = 1) readonly buffer Turns { real turns[]; };
// Of the range.
layout(std430, binding = 2) readonly buffer Unknowns { uint unknowns[]; };  // or kNone
layout(std430, binding = 3) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 4) readonly buffer Neighbours { uint neighbours[]; };
layout(std430, binding = 5) readonly buffer Edges { real edges[]; };
layout(std430, binding = 6) readonly buffer ReverseWeights { real reverse_weights[]; };
layout(std430, binding = 7) readonly buffer Stiffness { real stiffness[]; };
// x of all unknowns, then y, then z.
layout(std430, binding = 8) writeonly buffer Result { real result[]; };

#include "rotations.glsl"

const uint kNone = 0xffffffffu;

real3 turned_of(uint row) {
  return real3(turned[3 * row], turned[3 * row + 1], turned[3 * row + 2]);
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
  real3 sum = turned_of(row);
  for (uint k = starts[r]; k < starts[r + 1]; ++k) {
    const uint j = neighbours[k];
    if (j < all_rows) sum -= reverse_weights[k] * turned_of(j);
  }
  if (has(kStiffness)) {
    const real4 own = turn_of(row);
    for (uint k = starts[r]; k < starts[r + 1]; ++k) {
      const uint j = neighbours[k];
      const real3 was = -edge_of(k);
      real3 wish = turn(own, was) - was;
      if (j < all_rows) wish += turn(turn_of(j), was) - was;
      sum += stiffness[k] * wish;
    }
  }
  result[unknown] = sum.x;
  result[unknown_count + unknown] = sum.y;
  result[2 * unknown_count + unknown] = sum.z;
}
