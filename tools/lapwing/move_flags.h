#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

namespace lapwing::cli {

/// A handle and how it moves, by flags.
struct MoveFlags {
  std::string handle;
  std::vector<double> translate;
  std::vector<double> rotate;
  std::vector<double> pivot;
  std::vector<double> matrix;
  double scale = 1.0;

  /// Returns the option "--handle".
  CLI::Option* add_to(CLI::App& command);
  /// The handle with its region and move, as in a recipe.
  nlohmann::ordered_json json() const;
};

}  // namespace lapwing::cli
