#pragma once

#include "lapwing/io/number_table.h"

namespace lapwing {

/// Parses the text `table.bytes` and adds its rows to `table`. Throws what read_number_table
/// throws.
void read_text_table(NumberTable& table);

/// Parses the 3D Slicer markups file (.mrk.json) in `table.bytes`. Adds one row x, y, z for each
/// control point that has a position, in the order of the file.
void read_markups(NumberTable& table);

}  // namespace lapwing
