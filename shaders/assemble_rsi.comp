#version 450
#extension GL_GOOGLE_include_directive : require

// Assembles rows of the RSI system (ENERGY.md section 2; CPU twins: kernels/assemble_rsi.cpp,
// laplacian/ring_fit.cpp):
//     B_ik = delta_i x_k' / S - [delta_i]x J^-1 [x_k]x - l_ik I
// Each invocation computes one row.

#include "invocation.glsl"
#include "ring.glsl"
#include "blocks.glsl"

// Returns the inverse of J = S I - C; the local variable J contains J / S. For a collinear ring, J
// is singular, with the eigenvalue 0 along the line and S across it. In this case, returns the
// pseudo-inverse.
real3x3 inverse_of_J(real3x3 C, real S) {
  const real3x3 J = real3x3(1) - C / S;
  const real3 u = cross(J[1], J[2]);
  const real3 v = cross(J[2], J[0]);
  const real3 w = cross(J[0], J[1]);
  const real determinant = dot(J[0], u);
  if (determinant > kCollinearShare) return real3x3(u, v, w) / (determinant * S);
  real3 line = C[0];
  if (C[1][1] > C[0][0]) line = C[1];
  if (C[2][2] > max(C[0][0], C[1][1])) line = C[2];
  return (real3x3(1) - outerProduct(line, line) / dot(line, line)) / S;
}

void write_block(uint block, real3 scaled_delta, real3x3 rotation, real3 x, real laplacian_entry) {
  const real3 a = scaled_delta * x.x - (rotation[1] * x.z - rotation[2] * x.y);
  const real3 b = scaled_delta * x.y - (rotation[2] * x.x - rotation[0] * x.z);
  const real3 c = scaled_delta * x.z - (rotation[0] * x.y - rotation[1] * x.x);
  write_block(block, real3(a.x - laplacian_entry, a.yz),
              real3(b.x, b.y - laplacian_entry, b.z), real3(c.xy, c.z - laplacian_entry));
}

// `precise`, because NVIDIA's compiler may otherwise add `center` and `here` first. Far from the
// origin, the difference would then lose most of its precision.
real3 from_center(Place here, uint neighbour, real3 center) {
  precise real3 x = difference(here, place_of(neighbour)) - center;
  return x;
}

void main() {
  const uint r = invocation();
  if (r >= row_count) return;
  const uint begin = starts[r];
  const uint end = starts[r + 1];
  const uint first_block = begin + r;
  if (begin == end) {
    write_block(first_block, real3(0), real3x3(0), real3(0), real(0));
    return;
  }
  const Place here = place_of(rows[r]);
  real3 sum = real3(0);
  real3 delta = real3(0);
  for (uint e = begin; e < end; ++e) {
    const real3 edge = difference(here, place_of(neighbours[e]));
    sum += edge;
    delta -= weights[e] * edge;
  }
  const real3 center = sum / real(end - begin + 1);
  real3x3 C = outerProduct(center, center);
  for (uint e = begin; e < end; ++e) {
    const real3 x = from_center(here, neighbours[e], center);
    C += outerProduct(x, x);
  }
  const real S = C[0][0] + C[1][1] + C[2][2];
  real3 scaled_delta = real3(0);
  real3x3 rotation = real3x3(0);
  if (S > 0) {
    const real3x3 inverse_J = inverse_of_J(C, S);
    scaled_delta = delta / S;
    rotation = real3x3(cross(delta, inverse_J[0]), cross(delta, inverse_J[1]),
                       cross(delta, inverse_J[2]));
  }
  write_block(first_block, scaled_delta, rotation, -center, real(1));
  for (uint e = begin; e < end; ++e) {
    const real3 x = from_center(here, neighbours[e], center);
    write_block(first_block + 1 + e - begin, scaled_delta, rotation, x, -weights[e]);
  }
}
