#include "lapwing/recipe/recipe_files.h"

#include <algorithm>

#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/io/real_path.h"
#include "lapwing/step/attachment_file.h"
#include "lapwing/step/step_files.h"

namespace lapwing {

namespace fs = std::filesystem;

RecipeFiles files_of(const Recipe& recipe, fs::path result) {
  RecipeFiles files;
  files.read.push_back(split_mesh_path(recipe.mesh_path()).file);
  if (result.empty()) result = recipe.save_path();
  if (!result.empty()) files.written.push_back(result);
  const auto write = [&](const fs::path& path) {
    if (std::ranges::count(files.written, path) == 0) files.written.push_back(path);
  };
  for (const Step& step : recipe.steps) {
    for (const fs::path& path : files_read(step)) {
      if (!path.empty()) {
        files.read.push_back(split_mesh_path(recipe.base_directory / path).file);
      }
    }
    const auto* deform = std::get_if<DeformRequest>(&step);
    if (deform == nullptr) continue;
    for (const CarrySpec& carry : deform->carry) {
      if (!carry.save.empty()) {
        write(recipe.base_directory / carry.save);
      } else if (!result.empty()) {
        write(carried_path(carry.file, result));
      }
    }
  }
  return files;
}

void require_inside(const Recipe& recipe, const fs::path& folder) {
  const auto require = [&](const fs::path& path, const char* what) {
    if (is_inside(path, folder)) return;
    throw InputError("the recipe " + std::string(what) + " " + path.string() +
                     ", which is outside " + folder.string() +
                     "; move it there, or run the recipe without --sandbox if you trust it");
  };
  const RecipeFiles files = files_of(recipe);
  for (const fs::path& path : files.read) require(path, "reads");
  for (const fs::path& path : files.written) require(path, "writes");
}

}  // namespace lapwing
