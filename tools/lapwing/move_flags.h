#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace lapwing::cli {

/// Adds the flags of a move. When the parser reads a flag, it sets a key of the JSON object that
/// `move` returns. The help texts contain the name of the moved object, `what`, such as "the
/// handle", and the words for its default pivot, such as "the handle's centroid".
void add_move_flags(CLI::App& command, const std::string& what, const std::string& default_pivot,
                    const std::function<nlohmann::ordered_json&()>& move);

/// The flags for the regions, moves and weights of handles. Each --handle begins a new handle, and
/// the flags after it belong to this handle. Flags before the first --handle belong to the first
/// handle.
class HandleFlags {
 public:
  /// Adds --handle and the flags of its move. If `graded` is true, also adds the flags for weights
  /// and orientation. Returns --handle. This object must outlive `command`.
  CLI::Option* add_to(CLI::App& command, bool graded);
  /// Returns the handles in the form of a recipe, or null if there are none. `mesh` is the file
  /// that contains the vertex properties of --handle-field. Throws CLI::ParseError if the flags of
  /// a handle cannot be combined.
  nlohmann::ordered_json json(const std::string& mesh) const;

 private:
  using Json = nlohmann::ordered_json;

  Json& current();
  template <class Value>
  CLI::Option* add_flag(CLI::App& command, const std::string& name, const char* place,
                        const std::string& help);

  std::vector<Json> handles_;
};

/// The flags for the placement of a part, which is either fitted to the hole or moved by the user.
struct PlaceFlags {
  nlohmann::ordered_json move = nlohmann::ordered_json::object();
  std::optional<double> degrees;
  std::optional<double> scale;
  bool keep_size = false;

  void add_to(CLI::App& command);
  nlohmann::ordered_json json(bool snap) const;
};

}  // namespace lapwing::cli
