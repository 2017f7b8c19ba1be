#pragma once

#include <filesystem>
#include <string>

#include "lapwing/io/mesh_file.h"

namespace lapwing::cli {

/// Prints "lapwing: " and a line to standard error, as printable text (printable).
void say(const std::string& line);
void note(const std::string& text);  ///< the same with "lapwing: note: "

/// Prints the report of a written file to standard error.
void print_notes(const WriteReport& report);

/// Returns a file name, or a name inside a file, as printable text for standard output.
std::string shown(const std::filesystem::path& name);

}  // namespace lapwing::cli
