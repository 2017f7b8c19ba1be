#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace lapwing::cli {

/// Adds the flags of a move, which set the keys of a recipe's move as they are parsed. `move`
/// returns the move that they belong to. `what` names what moves, and `default_pivot` its pivot:
/// "the handle", "its centroid".
void add_move_flags(CLI::App& command, const std::string& what, const std::string& default_pivot,
                    const std::function<nlohmann::ordered_json&()>& move);

/// Flags for handles: their regions, moves, and how much the vertices follow. Each --handle begins
/// one, and the flags after it belong to it. Flags before the first --handle belong to the first.
class HandleFlags {
 public:
  /// Adds --handle and its move, and the other flags if handles are `graded`. Returns --handle. The
  /// flags refer to this object.
  CLI::Option* add_to(CLI::App& command, bool graded);
  /// Returns the handles, or null if there are none. `mesh` is the file with the vertex properties
  /// of
  /// --handle-field. Throws CLI::ParseError if the flags of a handle do not fit each other.
  nlohmann::ordered_json json(const std::string& mesh) const;

 private:
  using Json = nlohmann::ordered_json;

  Json& current();
  template <class Value>
  CLI::Option* add_flag(CLI::App& command, const std::string& name, const char* place,
                        const std::string& help);

  std::vector<Json> handles_;
};

/// Flags for the place of a part: fitted to the hole, or moved.
struct PlaceFlags {
  nlohmann::ordered_json move = nlohmann::ordered_json::object();
  std::optional<double> degrees;
  std::optional<double> scale;
  bool keep_size = false;

  void add_to(CLI::App& command);
  nlohmann::ordered_json json(bool snap) const;
};

}  // namespace lapwing::cli
