#version 450
#extension GL_GOOGLE_include_directive : require

// Computes R_i, the rotation from the source's frame to the target's frame, times the ratio of edge
// lengths. CPU twin: kernels/rotate_frames.cpp. Each invocation computes one row.

#include "invocation.glsl"
#include "mapped_ring.glsl"
#include "rotation.glsl"

layout(std430, binding = 5) readonly buffer Edges { real edges[]; };  // x, y, z of v_j - v_i
layout(std430, binding = 6) readonly buffer SourceNormals { real source_normals[]; };  // per vertex
layout(std430, binding = 7) readonly buffer TargetNormals { real target_normals[]; };  // per row
// One column-major matrix per row.
layout(std430, binding = 8) writeonly buffer Transforms { real transforms[]; };

// Must equal the constant in kernels/rotate_frames.cpp.
const real kMostScale = real(1e12);

void write_row(uint r, real3x3 T) {
  for (uint column = 0; column < 3; ++column) {
    transforms[9 * r + 3 * column] = T[column].x;
    transforms[9 * r + 3 * column + 1] = T[column].y;
    transforms[9 * r + 3 * column + 2] = T[column].z;
  }
}

real3 source_normal_at(uint v) {
  real3 normal = real3(0);
  for (uint c = 3 * v; c < 3 * v + 3; ++c) {
    const uint at = 3 * corners[c];
    normal += point_weights[c] *
              real3(source_normals[at], source_normals[at + 1], source_normals[at + 2]);
  }
  return normal;
}

real3 unit_or_zero(real3 normal) {
  const real size = length(normal);
  return size > kRoundingShare ? normal / size : real3(0);
}

// Returns a right-handed orthonormal frame with `normal` as the third axis (Duff et al., "Building
// an orthonormal basis, revisited", 2017).
real3x3 frame_of(real3 normal) {
  const real s = normal.z < 0 ? real(-1) : real(1);
  const real a = -1 / (s + normal.z);
  const real b = normal.x * normal.y * a;
  return real3x3(real3(1 + s * normal.x * normal.x * a, s * b, -s * normal.x),
                 real3(b, s + normal.y * normal.y * a, -normal.y), normal);
}

// Returns (length * cosine, length * sine, length) for the turn about the third axis that maximizes
// trace(turn' H).
real3 plane_turn(real3x3 H) {
  const real cosine = H[0][0] + H[1][1];
  const real sine = H[0][1] - H[1][0];
  // Scaled, because the squares may underflow for a small mesh.
  const real larger = max(abs(cosine), abs(sine));
  if (!(larger > 0)) return real3(0);
  const real c = cosine / larger;
  const real s = sine / larger;
  return real3(cosine, sine, larger * sqrt(c * c + s * s));
}

// Returns the rotation from the source's to the target's frame. `moment` is sum_j b_j a_j', and
// `spread` is sqrt(sum_j |a_j|^2 sum_j |b_j|^2).
real3x3 turn_of_frames(real3 source_normal, real3 target_normal, real3x3 moment, real spread) {
  const real3x3 source = frame_of(source_normal);
  const real3x3 target = frame_of(target_normal);
  real3 t = plane_turn(transpose(target) * moment * source);
  // If the edges determine no turn, the coordinate axes replace them, which leads to the smallest
  // rotation.
  if (t.z <= kRoundingShare * spread) t = plane_turn(transpose(target) * source);
  const real c = t.z > 0 ? t.x / t.z : real(1);
  const real s = t.z > 0 ? t.y / t.z : real(0);
  const real3x3 turn = real3x3(c, s, 0, -s, c, 0, 0, 0, 1);
  return target * turn * transpose(source);
}

void main() {
  const uint r = invocation();
  if (r >= row_count) return;
  const uint i = first_row + r;
  if (is_nowhere(i)) {
    write_row(r, real3x3(1));
    return;
  }
  const Place anchor = anchor_of(i);
  const real3 own = offset_from(anchor, i);
  real3x3 moment = real3x3(0);
  real source_spread = real(0);
  real target_spread = real(0);
  for (uint e = starts[r]; e < starts[r + 1]; ++e) {
    const uint j = neighbours[e];
    if (is_nowhere(j)) continue;
    const real3 a = offset_from(anchor, j) - own;
    const real3 b = real3(edges[3 * e], edges[3 * e + 1], edges[3 * e + 2]);
    moment += outerProduct(b, a);
    source_spread += dot(a, a);
    target_spread += dot(b, b);
  }
  const real3 source_normal = unit_or_zero(source_normal_at(i));
  const real3 target_normal =
      unit_or_zero(real3(target_normals[3 * r], target_normals[3 * r + 1], target_normals[3 * r + 2]));
  real3x3 T;
  if (source_normal != real3(0) && target_normal != real3(0)) {
    T = turn_of_frames(source_normal, target_normal, moment,
                       sqrt(source_spread * target_spread));
  } else {
    const real4 q = nearest_rotation(moment);
    T = real3x3(turn(q, real3(1, 0, 0)), turn(q, real3(0, 1, 0)), turn(q, real3(0, 0, 1)));
  }
  if (target_spread < kMostScale * kMostScale * source_spread) {
    T *= sqrt(target_spread / source_spread);
  }
  write_row(r, T);
}
