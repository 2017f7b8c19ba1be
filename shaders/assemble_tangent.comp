#version 450
#extension GL_GOOGLE_include_directive : require

// Assembles rows of the energy's tangent at rest (ENERGY.md section 5; CPU twin:
// kernels/assemble_tangent.cpp):
//     G_ij = -F_i^-1 [k_ij e_ij + om_i w_ij delta_i]x,   G_ii = minus their sum,
//     F_i F_i' = tr(C_i) I - C_i,   C_i = om_i delta_i delta_i' + sum_j k_ij e_ij e_ij'
// Each invocation computes one row.

#include "invocation.glsl"
#include "ring.glsl"
#include "blocks.glsl"

layout(std430, binding = 6) readonly buffer RowWeights { real row_weights[]; };
layout(std430, binding = 7) readonly buffer Stiffness { real stiffness[]; };

// Returns F^-1, where F is the lower Cholesky factor of K. If a pivot is almost 0, as for a
// collinear ring, its row in the result is 0.
real3x3 inverse_cholesky_factor(real3x3 K) {
  const real least = kCollinearShare * (K[0][0] + K[1][1] + K[2][2]);
  real3x3 F = real3x3(0);        // F[c][r]: column c
  real3x3 inverse = real3x3(0);
  for (int c = 0; c < 3; ++c) {
    real pivot = K[c][c];
    for (int k = 0; k < c; ++k) pivot -= F[k][c] * F[k][c];
    if (!(pivot > least)) continue;
    const real root = sqrt(pivot);
    F[c][c] = root;
    for (int r = c + 1; r < 3; ++r) {
      real entry = K[c][r];
      for (int k = 0; k < c; ++k) entry -= F[k][r] * F[k][c];
      F[c][r] = entry / root;
    }
    inverse[c][c] = 1 / root;
    for (int k = 0; k < c; ++k) {
      real sum = real(0);
      for (int m = k; m < c; ++m) sum += F[m][c] * inverse[k][m];
      inverse[k][c] = -sum / root;
    }
  }
  return inverse;
}

// Writes M [v]x.
void write_block(uint block, real3x3 M, real3 v) {
  write_block(block, M[1] * v.z - M[2] * v.y, M[2] * v.x - M[0] * v.z, M[0] * v.y - M[1] * v.x);
}

void main() {
  const uint r = invocation();
  if (r >= row_count) return;
  const uint begin = starts[r];
  const uint end = starts[r + 1];
  const uint first_block = begin + r;
  const real weight = row_weights[r];
  const Place here = place_of(rows[r]);
  real3 delta = real3(0);
  real3x3 C = real3x3(0);
  for (uint k = begin; k < end; ++k) {
    const real3 e = -difference(here, place_of(neighbours[k]));
    delta += weights[k] * e;
    C += outerProduct(stiffness[k] * e, e);
  }
  C += outerProduct(weight * delta, delta);
  const real trace = C[0][0] + C[1][1] + C[2][2];
  const real3x3 inverse_F = inverse_cholesky_factor(real3x3(trace) - C);
  real3 sum = real3(0);
  for (uint k = begin; k < end; ++k) {
    const real3 e = -difference(here, place_of(neighbours[k]));
    const real3 arm = stiffness[k] * e + weight * weights[k] * delta;
    write_block(first_block + 1 + k - begin, inverse_F, -arm);
    sum += arm;
  }
  write_block(first_block, inverse_F, sum);
}
