#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lapwing/json/json_node.h"
#include "lapwing/step/step.h"

namespace lapwing {

/// The version of the format that this program reads and writes, the file's "lapwing".
inline constexpr int kRecipeVersion = 1;

/// A whole edit: a mesh, what is done to it, and where the result goes.
struct Recipe {
  std::filesystem::path mesh;            ///< as written
  std::vector<Step> steps;               ///< in order; may be empty
  std::filesystem::path save;            ///< as written; empty when the recipe does not say
  std::filesystem::path base_directory;  ///< what the relative paths above are relative to
  /// The result is saved as a morph target of this name, beside the mesh as it was: "save_as":
  /// {"morph_target": NAME}. Empty: as the mesh itself.
  std::string morph_target;

  std::filesystem::path mesh_path() const { return base_directory / mesh; }
  /// Empty when `save` is.
  std::filesystem::path save_path() const { return save.empty() ? save : base_directory / save; }
  bool operator==(const Recipe&) const = default;
};

/// Reads a recipe from JSON text; `name` is what messages call it. Everything that needs no mesh is
/// checked. Throws InputError with the JSON pointer of the place, what is expected there and what
/// was found; line and column when the text is no JSON (see parse_json).
Recipe parse_recipe(std::string_view json_text, const std::filesystem::path& base_directory,
                    const std::string& name);

/// The same of a document that is no text (json/parse_json.h).
Recipe parse_recipe(JsonNode::Document document, const std::filesystem::path& base_directory,
                    const std::string& name);

/// Reads a recipe file; its folder is the base directory. Throws IoError when it cannot be read,
/// and what `parse_recipe` throws.
Recipe read_recipe(const std::filesystem::path& path);

/// The recipe as JSON that `parse_recipe` reads back to an equal one. Two spaces of indentation;
/// what fits on a line stays on one. Numbers must be finite. Throws InputError when a path is not
/// UTF-8.
std::string to_json(const Recipe& recipe);

}  // namespace lapwing
