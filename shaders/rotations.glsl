// What the kernels fit_rotations and energy_gradient share. Included once Edges is declared.

layout(push_constant) uniform Push {
  uint row_count;  // of the range
  uint first_row;  // of the range
  uint all_rows;   // vertices from here on are no rows
  uint unknown_count;
  uint flags;
};
const uint kStiffness = 1;

bool has(uint flag) { return (flags & flag) != 0; }

real3 edge_of(uint entry) {
  return real3(edges[3 * entry], edges[3 * entry + 1], edges[3 * entry + 2]);
}
