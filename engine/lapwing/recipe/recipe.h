#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lapwing/json/json_node.h"
#include "lapwing/recipe/step.h"

namespace lapwing {

/// The version of the format: the value of "lapwing" in the file.
inline constexpr int kRecipeVersion = 1;

/// A whole edit: a mesh, its steps, and the file to save.
struct Recipe {
  std::filesystem::path mesh;            ///< path as in the recipe
  std::vector<Step> steps;               ///< in order; may be empty
  std::filesystem::path save;            ///< path as in the recipe; empty if there is none
  std::filesystem::path base_directory;  ///< base of the relative paths above
  /// Name of the morph target to save, from "save_as": {"morph_target": NAME}. The mesh itself is
  /// then saved unchanged. If empty, the edited mesh is saved.
  std::string morph_target;

  std::filesystem::path mesh_path() const { return base_directory / mesh; }
  /// Returns an empty path if `save` is empty.
  std::filesystem::path save_path() const { return save.empty() ? save : base_directory / save; }
  bool operator==(const Recipe&) const = default;
};

/// Reads a step. Throws InputError with the JSON pointer of the first mistake.
Step read_step(const JsonNode& node);

/// Reads a recipe from JSON text. `name` is its name in messages. Checks everything that does not
/// depend on the mesh. Throws InputError with the JSON pointer and the expected and actual value,
/// or with line and column if the text is not JSON (see parse_json).
Recipe parse_recipe(std::string_view json_text, const std::filesystem::path& base_directory,
                    const std::string& name);

/// Reads a recipe from a parsed document (json/parse_json.h).
Recipe parse_recipe(JsonNode::Document document, const std::filesystem::path& base_directory,
                    const std::string& name);

/// Reads a recipe file; its folder is the base directory. Throws IoError if it cannot be read, and
/// as `parse_recipe` does.
Recipe read_recipe(const std::filesystem::path& path);

/// Returns the recipe as JSON. `parse_recipe` reads it back as an equal recipe. Objects and lists
/// that fit on one line are not broken; others are indented by two spaces. Numbers must be finite.
/// Throws InputError if a path is not UTF-8.
std::string to_json(const Recipe& recipe);

}  // namespace lapwing
