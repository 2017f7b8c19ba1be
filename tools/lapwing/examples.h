#pragma once

#include <CLI/App.hpp>

namespace lapwing::cli {

/// Adds examples to the help of `app` and of all its commands. The examples of a command are shell
/// lines that can be run in an empty folder. At least two of them use the command.
void add_examples(CLI::App& app);

}  // namespace lapwing::cli
