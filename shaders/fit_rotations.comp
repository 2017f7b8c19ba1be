#version 450
#extension GL_GOOGLE_include_directive : require

// Fits T_i of each row from rest to rest + displacement, and computes the remaining energy. CPU
// twin: kernels/ring_loops.inl. Each invocation computes one row of a range.

#include "invocation.glsl"
#include "place.glsl"
#include "rotation.glsl"

// Row r of the range is vertex first_row + r, and has the entries [starts[r], starts[r + 1]).
layout(std430, binding = 1) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 2) readonly buffer Neighbours { uint neighbours[]; };
layout(std430, binding = 3) readonly buffer Edges { real edges[]; };  // x, y, z of v_j - v_i
layout(std430, binding = 4) readonly buffer Weights { real weights[]; };
layout(std430, binding = 5) readonly buffer Stiffness { real stiffness[]; };
// For all rows: om_i, and S_i - I as xx, yy, zz, yz, xz, xy.
layout(std430, binding = 6) readonly buffer RowWeights {
  real row_weights[];
};
layout(std430, binding = 10) readonly buffer Stretch {
  real stretch[];
};
// For all rows: R_i as a quaternion, om_i (L(v')_i - T_i delta_i), and the row's part of the
// energy.
layout(std430, binding = 7) writeonly buffer Turns { real turns[]; };
layout(std430, binding = 8) writeonly buffer Residuals { real residuals[]; };
layout(std430, binding = 9) writeonly buffer Energies { real energies[]; };

#include "rotations.glsl"

void main() {
  const uint r = invocation();
  if (r >= row_count) return;
  const uint begin = starts[r];
  const uint end = starts[r + 1];
  const uint row = first_row + r;
  const real weight = row_weights[row];
  const Place here = place_of(row);
  real3x3 C = real3x3(0);
  real3 delta = real3(0);
  real3 shift_sum = real3(0);
  for (uint k = begin; k < end; ++k) {
    const real3 e = edge_of(k);
    const real3 shift = difference(here, place_of(neighbours[k]));
    if (has(kStiffness)) C += outerProduct(stiffness[k] * (e + shift), e);
    delta -= weights[k] * e;
    shift_sum -= weights[k] * shift;
  }
  const real3 moved = delta + shift_sum;
  C += outerProduct(weight * moved, delta);

  if (has(kStretch)) C += C * stretch_of(row);
  const real4 q = nearest_rotation(C);
  const real3 off = shift_sum - transform_change(row, q, delta);
  real energy = weight * dot(off, off);
  if (has(kStiffness)) {
    for (uint k = begin; k < end; ++k) {
      const real3 missing =
          difference(here, place_of(neighbours[k])) - transform_change(row, q, edge_of(k));
      energy += stiffness[k] * dot(missing, missing);
    }
  }
  turns[4 * row] = q.x;
  turns[4 * row + 1] = q.y;
  turns[4 * row + 2] = q.z;
  turns[4 * row + 3] = q.w;
  residuals[3 * row] = weight * off.x;
  residuals[3 * row + 1] = weight * off.y;
  residuals[3 * row + 2] = weight * off.z;
  energies[row] = energy;
}
