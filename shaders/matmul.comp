#version 450
#extension GL_GOOGLE_include_directive : require

// Computes C = A B for square row-major matrices whose size is a multiple of kTile. The benchmark
// measures the arithmetic rate of a device with this kernel. A work group computes a tile of C from
// shared strips of A and B. Each invocation computes kOwn x kOwn numbers in registers, so that
// arithmetic is the limit and not memory.

layout(local_size_x_id = 0) in;

#include "precision.glsl"

const uint kTile = 64;
const uint kDepth = 16;
const uint kOwn = 4;
const uint kAcross = kTile / kOwn;
const uint kInvocations = kAcross * kAcross;

layout(std430, binding = 0) readonly buffer A { real a[]; };
layout(std430, binding = 1) readonly buffer B { real b[]; };
layout(std430, binding = 2) writeonly buffer C { real c[]; };

layout(push_constant) uniform Push { uint size; };

shared real strip_a[kDepth][kTile];
shared real strip_b[kDepth][kTile];

void main() {
  const uint tiles = size / kTile;
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  const uint row = group / tiles * kTile;
  const uint column = group % tiles * kTile;
  const uint own = gl_LocalInvocationID.x;
  const uint own_row = own / kAcross * kOwn;
  const uint own_column = own % kAcross * kOwn;
  real sums[kOwn][kOwn];
  for (uint i = 0; i < kOwn; ++i) {
    for (uint j = 0; j < kOwn; ++j) sums[i][j] = real(0);
  }
  for (uint depth = 0; depth < size; depth += kDepth) {
    for (uint e = own; e < kTile * kDepth; e += kInvocations) {
      strip_a[e % kDepth][e / kDepth] = a[(row + e / kDepth) * size + depth + e % kDepth];
      strip_b[e / kTile][e % kTile] = b[(depth + e / kTile) * size + column + e % kTile];
    }
    barrier();
    for (uint k = 0; k < kDepth; ++k) {
      real left[kOwn];
      real right[kOwn];
      for (uint i = 0; i < kOwn; ++i) {
        left[i] = strip_a[k][own_row + i];
        right[i] = strip_b[k][own_column + i];
      }
      for (uint i = 0; i < kOwn; ++i) {
        for (uint j = 0; j < kOwn; ++j) sums[i][j] += left[i] * right[j];
      }
    }
    barrier();
  }
  for (uint i = 0; i < kOwn; ++i) {
    for (uint j = 0; j < kOwn; ++j) {
      c[(row + own_row + i) * size + column + own_column + j] = sums[i][j];
    }
  }
}
