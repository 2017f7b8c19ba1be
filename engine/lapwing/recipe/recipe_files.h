#pragma once

#include <filesystem>
#include <vector>

#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// The files that a recipe names, as they are from the current folder.
struct RecipeFiles {
  std::vector<std::filesystem::path> read;     ///< the mesh first
  std::vector<std::filesystem::path> written;  ///< the result first, if there is one; each once
};
/// With what is carried beside a result at `result`; empty: where the recipe saves it, if it does.
RecipeFiles files_of(const Recipe& recipe, std::filesystem::path result = {});

/// Throws InputError that names the file unless all that the recipe names, to read or to write, lie
/// in `folder` or below (is_inside), with what is carried beside its result: for recipes from
/// people whom one does not know.
void require_inside(const Recipe& recipe, const std::filesystem::path& folder);

}  // namespace lapwing
