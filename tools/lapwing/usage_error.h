#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace lapwing::cli {

/// Returns the error message for arguments that `app` could not parse. For an unknown option or
/// command, the message suggests the most similar known one. Each message names the command that
/// prints the help.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace lapwing::cli
