#pragma once

#include <CLI/App.hpp>

namespace lapwing::cli {

/// Each function adds a subcommand to `app`. CLI11 runs the subcommand that the arguments name.
/// Errors are thrown as exceptions.
void add_run(CLI::App& app);
/// Adds one command per operation of a recipe, such as "deform" and "coat". Other functions add the
/// remaining operations, such as "wrap".
void add_steps(CLI::App& app);
void add_batch(CLI::App& app);
void add_peel(CLI::App& app);
void add_wrap(CLI::App& app);
void add_transfer(CLI::App& app);
void add_cut(CLI::App& app);
void add_parts(CLI::App& app);
void add_render(CLI::App& app);
void add_parameterize(CLI::App& app);
void add_convert(CLI::App& app);
void add_shape(CLI::App& app);
void add_subdivide(CLI::App& app);
void add_remesh(CLI::App& app);
void add_check(CLI::App& app);
void add_info(CLI::App& app);
void add_keys(CLI::App& app);

/// The help text of every argument that is a mesh file.
inline constexpr const char* kMeshHelp = "OBJ, OFF, PLY, STL or glTF";

/// Exit codes of the command line.
enum ExitCode : int {
  kDone = 0,
  kFault = 1,  ///< a bug in the program
  kUsage = 2,
  kInput = 3,  ///< invalid mesh or recipe
  kSolver = 4,
  kDevice = 5,
  kFile = 6,
  kSignalled = 128,  ///< plus the number of the signal that ended the program, as in shells
  kCancelled = 130,  ///< cancelled by an interrupt (Ctrl+C)
};

/// Thrown by a finished command to set the exit code.
struct ExitWith {
  int code;
};

}  // namespace lapwing::cli
