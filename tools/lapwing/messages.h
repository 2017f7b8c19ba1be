#pragma once

#include <filesystem>
#include <string>

#include "lapwing/io/mesh_file.h"

namespace lapwing::cli {

/// Prints "lapwing: " and a line to standard error. Escapes unprintable characters (`printable`).
void say(const std::string& line);
/// Prints a line about a decision of the program. The line begins with "lapwing: note: ". On a
/// terminal, the word "note" is coloured unless NO_COLOR is set. The colour distinguishes notes
/// from warnings.
void note(const std::string& text);
/// Prints a line about a result that may be wrong or incomplete. The line begins with
/// "lapwing: warning: ".
void warn(const std::string& text);

/// Prints a warning if `mesh`, which was read from `path`, has no surface. A point cloud has none.
void warn_without_surface(const Mesh& mesh, const std::string& path);

/// Reads a mesh (read_mesh), and prints the notes of the reader.
Mesh read_with_notes(const std::filesystem::path& path);

/// Prints the report of a written file to standard error. Lost data are warnings.
void print_notes(const WriteReport& report);

/// Returns a file name, or a name inside a file, as printable text for standard output.
std::string shown(const std::filesystem::path& name);

}  // namespace lapwing::cli
