#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/recipe/key_table.h"

namespace lapwing::cli {

void add_keys(CLI::App& app) {
  auto* command = app.add_subcommand("keys", "the keys of a recipe's step, with their defaults");
  auto wanted = std::make_shared<std::string>();
  std::vector<std::string> names;
  for (const Operation& operation : operations()) names.emplace_back(operation.name);
  command->add_option("OPERATION", *wanted, "the step; by default all of them")
      ->check(CLI::IsMember(names));
  command->callback([wanted] {
    bool first = true;
    for (const Operation& operation : operations()) {
      if (!wanted->empty() && *wanted != operation.name) continue;
      if (!first) std::printf("\n");
      first = false;
      const std::string title = std::string(operation.name) + ": " + std::string(operation.help);
      std::printf("%s\n\n%s", title.c_str(), key_table(operation).c_str());
    }
  });
}

}  // namespace lapwing::cli
