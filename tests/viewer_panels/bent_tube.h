#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing::viewer::test {

/// Writes a tube and a recipe, which fixes the lower end of the tube and moves the upper end by
/// `distance` along x. `more` contains further keys of the step and begins with a comma. Returns
/// the path of the recipe.
inline std::filesystem::path write_bent_tube(const std::filesystem::path& folder, int distance,
                                             const std::string& more = {}) {
  write_mesh(rippled_cylinder(24, 41), folder / "tube.obj");
  const std::filesystem::path recipe = folder / "bend.json";
  std::ofstream(recipe) << R"({"lapwing": 1, "mesh": "tube.obj", "steps": [
      {"op": "deform", "roi": {"all": true},
       "belt": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.6]}},
       "handles": [{"region": {"box": {"min": [-1, -1, 5.4], "max": [1, 1, 7]}},
                    "move": {"translate": [)"
                        << distance << ", 0, 0]}}]" << more << "}]}";
  return recipe;
}

}  // namespace lapwing::viewer::test
