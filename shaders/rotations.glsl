// Shared by the kernels fit_rotations and energy_gradient. Include this file after the declarations
// of Edges and Stretch.

layout(push_constant) uniform Push {
  uint row_count;  // of the range
  uint first_row;  // of the range
  uint all_rows;   // number of rows of all ranges; vertices with a higher index are not rows
  uint unknown_count;
  uint flags;
};
const uint kStiffness = 1;
const uint kStretch = 2;  // set if some S_i is not the identity

bool has(uint flag) { return (flags & flag) != 0; }

real3 edge_of(uint entry) {
  return real3(edges[3 * entry], edges[3 * entry + 1], edges[3 * entry + 2]);
}

// Returns S - I of a row. Unlike S, it represents small stretches accurately.
real3x3 stretch_of(uint row) {
  const real xx = stretch[6 * row];
  const real yy = stretch[6 * row + 1];
  const real zz = stretch[6 * row + 2];
  const real yz = stretch[6 * row + 3];
  const real xz = stretch[6 * row + 4];
  const real xy = stretch[6 * row + 5];
  return real3x3(xx, xy, xz, xy, yy, yz, xz, yz, zz);
}

// Returns (T - I) e of a row, where T = R(q) S.
real3 transform_change(uint row, real4 q, real3 e) {
  if (!has(kStretch)) return turn_change(q, e);
  const real3 f = stretch_of(row) * e;
  return f + turn_change(q, e + f);
}
