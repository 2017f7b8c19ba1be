#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// Calls `read` for every file that the step reads, and `written` for every output file that it
/// names. Both functions get the paths as in the recipe and may change them. An empty path means
/// the mesh itself.
void for_each_file(Step& step, const std::function<void(std::filesystem::path&)>& read,
                   const std::function<void(std::filesystem::path&)>& written);

/// Returns the files that the step reads, with paths as in the recipe.
std::vector<std::filesystem::path> files_read(const Step& step);

/// Returns the default path of a carried file. It is in the folder of the result, and its name has
/// "-carried" appended to the stem: hat-carried.obj for hat.obj, and F-carried.mrk.json for
/// F.mrk.json.
std::filesystem::path carried_path(const std::filesystem::path& file,
                                   const std::filesystem::path& result);

/// The files that a recipe names, relative to the current folder.
struct RecipeFiles {
  std::vector<std::filesystem::path> read;     ///< the mesh comes first
  std::vector<std::filesystem::path> written;  ///< the result, if any, comes first; no duplicates
};
/// Returns all files of `recipe`, including attachment files. `result` is the path of the result;
/// by default, the recipe determines it.
RecipeFiles files_of(const Recipe& recipe, std::filesystem::path result = {});

/// Throws InputError, naming the file, unless all files that the recipe reads or writes are inside
/// `folder` (is_inside). For untrusted recipes.
void require_inside(const Recipe& recipe, const std::filesystem::path& folder);

}  // namespace lapwing
