#pragma once

#include <filesystem>
#include <string>

#include "lapwing/io/mesh_file.h"

namespace lapwing::cli {

/// Prints a line to standard error, after "lapwing: ", that any terminal can show (printable).
void say(const std::string& line);
void note(const std::string& text);  ///< likewise, after "lapwing: note: "

/// Prints to standard error what a file could not carry and what else to look after.
void print_notes(const WriteReport& report);

/// A name of a file or of anything in it, for standard output.
std::string shown(const std::filesystem::path& name);

}  // namespace lapwing::cli
