#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace lapwing::cli {

/// Flags for the move of a handle or part, with the keys of a recipe's move.
struct MoveFlags {
  std::vector<double> translate;
  std::vector<double> rotate;
  std::vector<double> pivot;
  std::vector<double> matrix;
  std::vector<double> scale;

  /// `what` names what moves, and `default_pivot` its pivot: "the handle", "its centroid".
  void add_to(CLI::App& command, const std::string& what, const std::string& default_pivot);
  bool are_given() const;
  nlohmann::ordered_json json() const;
};

}  // namespace lapwing::cli
