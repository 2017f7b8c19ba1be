#pragma once

#include <CLI/App.hpp>

namespace lapwing::cli {

/// Adds examples to the help of `app` and of all its commands: shell lines that run in an empty
/// folder, at least two of them with the command.
void add_examples(CLI::App& app);

}  // namespace lapwing::cli
