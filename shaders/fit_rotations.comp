#version 450
#extension GL_GOOGLE_include_directive : require

// T_i of each row from rest to rest + displacement, what it does to delta_i, and the energy left
// (twin: kernels/fit_rotations.cpp). One invocation per row of a range.

#include "invocation.glsl"
#include "place.glsl"
#include "rotation.glsl"

// Row r of the range is vertex first_row + r, with entries [starts[r], starts[r + 1]).
layout(std430, binding = 1) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 2) readonly buffer Neighbours { uint neighbours[]; };
layout(std430, binding = 3) readonly buffer Edges { real edges[]; };  // x, y, z of v_j - v_i
layout(std430, binding = 4) readonly buffer Weights { real weights[]; };
layout(std430, binding = 5) readonly buffer Stiffness { real stiffness[]; };
// Of all rows: T_i as a quaternion whose square is its scale, T_i delta_i - delta_i, the energy.
layout(std430, binding = 6) writeonly buffer Turns { real turns[]; };
layout(std430, binding = 7) writeonly buffer Turned { real turned[]; };
layout(std430, binding = 8) writeonly buffer Energies { real energies[]; };

#include "rotations.glsl"

void main() {
  const uint r = invocation();
  if (r >= row_count) return;
  const uint begin = starts[r];
  const uint end = starts[r + 1];
  const uint row = first_row + r;
  const Place here = place_of(row);
  real3x3 H = real3x3(0);
  real3 edge_sum = real3(0);
  real3 moved_sum = real3(0);
  real3 delta = real3(0);
  real3 moved = real3(0);
  real spread = real(0);
  for (uint k = begin; k < end; ++k) {
    const real3 e = edge_of(k);
    const real3 d = e + difference(here, place_of(neighbours[k]));
    H += outerProduct(d, e);
    edge_sum += e;
    moved_sum += d;
    delta -= weights[k] * e;
    moved -= weights[k] * d;
    spread += dot(e, e);
  }
  // The x_k sum to 0 over K_i, so d_k need not be centred.
  const real3 center = edge_sum / real(end - begin + 1);
  H -= outerProduct(moved_sum, center);
  spread -= dot(edge_sum, center);

  real4 q = nearest_rotation(H);
  if (has(kSimilarity) && spread > 0) {
    const real s = (dot(turn(q, real3(1, 0, 0)), H[0]) + dot(turn(q, real3(0, 1, 0)), H[1]) +
                    dot(turn(q, real3(0, 0, 1)), H[2])) /
                   spread;
    q *= sqrt(max(s, real(0)));
  }
  const real3 wish = turn(q, delta);
  const real3 change = wish - delta;
  const real3 off = moved - wish;
  real energy = dot(off, off);
  if (has(kStiffness)) {
    for (uint k = begin; k < end; ++k) {
      const real3 e = edge_of(k);
      const real3 missing = e + difference(here, place_of(neighbours[k])) - turn(q, e);
      energy += stiffness[k] * dot(missing, missing);
    }
  }
  turns[4 * row] = q.x;
  turns[4 * row + 1] = q.y;
  turns[4 * row + 2] = q.z;
  turns[4 * row + 3] = q.w;
  turned[3 * row] = change.x;
  turned[3 * row + 1] = change.y;
  turned[3 * row + 2] = change.z;
  energies[row] = energy;
}
