#include "usage_error.h"

#include <string_view>
#include <vector>

#include "lapwing/json/suggest.h"

namespace lapwing::cli {
namespace {

// Returns the innermost subcommand that was recognized. Appends the names of the commands that lead
// to it to `words`.
const CLI::App& command_of(const CLI::App& app, std::string& words) {
  words += (words.empty() ? "" : " ") + app.get_name();
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  return parsed.empty() ? app : command_of(*parsed.front(), words);
}

std::string question(std::string_view meant) {
  return meant.empty() ? "" : "Did you mean " + std::string(meant) + "? ";
}

std::string unknown_option(const CLI::App& command, const std::string& argument) {
  std::vector<std::string_view> known;
  for (const CLI::Option* option : command.get_options()) {
    known.insert(known.end(), option->get_lnames().begin(), option->get_lnames().end());
  }
  const std::string typed = argument.substr(0, argument.find('='));
  const std::size_t name = typed.find_first_not_of('-');
  std::string meant(name == std::string::npos ? "" : nearest(typed.substr(name), known));
  if (!meant.empty()) meant.insert(0, "--");
  return "unknown option " + typed + ". " + question(meant);
}

std::string unknown_command(const CLI::App& command, const std::string& typed) {
  std::vector<std::string_view> known;
  for (const CLI::App* sub : command.get_subcommands({})) known.push_back(sub->get_name());
  return "unknown command " + typed + ". " + question(nearest(typed, known));
}

bool is_option(std::string_view argument) {
  return argument.size() > 1 && argument.front() == '-';
}

// Returns a sentence about the first unknown argument, or an empty string if all arguments are
// known.
std::string unknown_argument(const CLI::App& app, const CLI::App& command) {
  const std::vector<std::string> unknown = app.remaining(true);
  if (unknown.empty()) return {};
  const bool takes_command = command.get_require_subcommand_min() > 0;
  if (takes_command && !is_option(unknown.front())) {
    return unknown_command(command, unknown.front());
  }
  for (const std::string& argument : unknown) {
    if (is_option(argument)) return unknown_option(command, argument);
  }
  return "unexpected argument " + unknown.front() + ". ";
}

}  // namespace

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  std::string words;
  const CLI::App& command = command_of(app, words);
  std::string message = unknown_argument(app, command);
  if (message.empty()) {
    message = error.what();
    message += message.ends_with('.') ? " " : ". ";
  }
  const bool takes_command = command.get_require_subcommand_min() > 0;
  return message + "`" + words + " --help` lists the " + (takes_command ? "commands" : "options");
}

}  // namespace lapwing::cli
