// Blocks of 9 numbers in column-major order. Row r begins at block starts[r] + r.
layout(std430, binding = 5) writeonly buffer Blocks { real blocks[]; };

void write_block(uint block, real3 a, real3 b, real3 c) {
  const uint at = 9 * block;
  blocks[at] = a.x;
  blocks[at + 1] = a.y;
  blocks[at + 2] = a.z;
  blocks[at + 3] = b.x;
  blocks[at + 4] = b.y;
  blocks[at + 5] = b.z;
  blocks[at + 6] = c.x;
  blocks[at + 7] = c.y;
  blocks[at + 8] = c.z;
}
