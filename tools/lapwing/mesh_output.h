#pragma once

#include "lapwing/io/mesh_file.h"

namespace lapwing::cli {

/// Prints to standard error what a file could not carry and what else to look after.
void print_notes(const WriteReport& report);

}  // namespace lapwing::cli
