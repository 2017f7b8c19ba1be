#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace lapwing::cli {

/// Returns the message for arguments that `app` could not parse. For an unknown option or command,
/// it suggests the nearest known one. Each message names the help to read.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace lapwing::cli
