#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace lapwing::cli {

/// Returns the message for arguments that `app` could not parse. An unknown option or command is
/// answered with the nearest known one, and each message names the help to read.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace lapwing::cli
