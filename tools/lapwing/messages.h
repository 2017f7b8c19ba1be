#pragma once

#include <filesystem>
#include <string>

#include "lapwing/io/mesh_file.h"

namespace lapwing::cli {

/// Prints "lapwing: " and a line to standard error, as printable text (printable).
void say(const std::string& line);
/// Prints a line about a decision that the program made: "lapwing: note: ". On a terminal, the word
/// is coloured (unless NO_COLOR is set), so that notes and warnings are told apart.
void note(const std::string& text);
/// Prints a line about a result that may be wrong or incomplete: "lapwing: warning: ".
void warn(const std::string& text);

/// Warns if `mesh`, which was read from `path`, has no surface, such as a point cloud.
void warn_without_surface(const Mesh& mesh, const std::string& path);

/// Prints the report of a written file to standard error: what was lost as warnings.
void print_notes(const WriteReport& report);

/// Returns a file name, or a name inside a file, as printable text for standard output.
std::string shown(const std::filesystem::path& name);

}  // namespace lapwing::cli
