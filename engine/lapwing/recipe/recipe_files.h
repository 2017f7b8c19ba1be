#pragma once

#include <filesystem>
#include <vector>

#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// The files that a recipe names, relative to the current folder.
struct RecipeFiles {
  std::vector<std::filesystem::path> read;     ///< the mesh first
  std::vector<std::filesystem::path> written;  ///< the result first, if any; no duplicates
};
/// `result` is the path of the result, by default the recipe's own. Files carried along are
/// included.
RecipeFiles files_of(const Recipe& recipe, std::filesystem::path result = {});

/// Throws InputError, naming the file, unless all files that the recipe reads or writes lie inside
/// `folder` (is_inside). For untrusted recipes.
void require_inside(const Recipe& recipe, const std::filesystem::path& folder);

}  // namespace lapwing
