#version 450
#extension GL_GOOGLE_include_directive : require

// Moves each vertex by the weighted motions of up to eight coarse vertices, or to its prescribed
// displacement. CPU twin: CpuDragFrame (elastic/drag_frame.cpp). Each invocation computes one
// vertex.

#include "invocation.glsl"
#include "place.glsl"
#include "moved.glsl"

layout(std430, binding = 2) readonly buffer Rest { real rest[]; };  // relative to the origin
// Node k of vertex v at k * vertex_count + v: number of the node in the low 16 bits, weight in the
// high 16 bits.
layout(std430, binding = 3) readonly buffer Nodes { uint nodes[]; };
// The three rows of A - I and t of each node.
layout(std430, binding = 4) readonly buffer Motions { real motions[]; };
// Entry of each vertex in Prescribed, or 0xffffffff.
layout(std430, binding = 5) readonly buffer Entries { uint entries[]; };
layout(std430, binding = 6) readonly buffer Prescribed { real prescribed[]; };

layout(push_constant) uniform Push {
  uint vertex_count;
  uint exact_count;  // vertices with entries below it have exactly the prescribed displacement
};

const uint kNodes = 8;
const real kWeightUnits = 65535;

void main() {
  const uint v = invocation();
  if (v >= vertex_count) return;
  const uint entry = entries[v];
  if (entry < exact_count) {
    set_moved(v, real3(prescribed[3 * entry], prescribed[3 * entry + 1], prescribed[3 * entry + 2]));
    return;
  }
  const real3 own = value_of(place_of(v));
  const real4 at = real4(real3(rest[3 * v], rest[3 * v + 1], rest[3 * v + 2]) + own, 1);
  real3 sum = real3(0);
  for (uint k = 0; k < kNodes; ++k) {
    const uint node = nodes[k * vertex_count + v];
    const real weight = real(node >> 16);
    if (weight == 0) break;
    const uint row = 12 * (node & 0xffffu);
    sum += weight *
           real3(dot(real4(motions[row], motions[row + 1], motions[row + 2], motions[row + 3]), at),
                 dot(real4(motions[row + 4], motions[row + 5], motions[row + 6], motions[row + 7]),
                     at),
                 dot(real4(motions[row + 8], motions[row + 9], motions[row + 10],
                           motions[row + 11]),
                     at));
  }
  set_moved(v, own + sum / kWeightUnits);
}
