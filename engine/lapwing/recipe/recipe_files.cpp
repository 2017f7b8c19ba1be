#include "lapwing/recipe/recipe_files.h"

#include <algorithm>

#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/io/number_table.h"
#include "lapwing/io/paths.h"
#include "lapwing/recipe/key_visitor.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Visit = std::function<void(fs::path&)>;

class StepFiles final : public KeyVisitor {
 public:
  StepFiles(const Visit& read, const Visit& written) : read_(read), written_(written) {}

  void file(const StepKey&, fs::path& value) override {
    if (!value.empty()) read_(value);
  }
  void targets(const StepKey&, TargetSpec& value) override {
    if (!value.file.empty()) read_(value.file);
  }
  void landmarks(const StepKey&, LandmarkSpec& value) override {
    if (!value.file.empty()) read_(value.file);
    if (!value.scan_file.empty()) read_(value.scan_file);
  }
  void carry(const StepKey&, std::vector<CarrySpec>& value) override {
    for (CarrySpec& carry : value) {
      read_(carry.file);
      if (!carry.save.empty()) written_(carry.save);
    }
  }
  void part(const StepKey&, fs::path& mesh, std::optional<RegionSpec>&) override {
    if (!mesh.empty()) read_(mesh);
  }

 private:
  const Visit& read_;
  const Visit& written_;
};

}  // namespace

void for_each_file(Step& step, const Visit& read, const Visit& written) {
  StepFiles files(read, written);
  describe(step, files);
}

std::vector<fs::path> files_read(const Step& step) {
  std::vector<fs::path> paths;
  Step copy = step;
  for_each_file(
      copy, [&](const fs::path& path) { paths.push_back(path); }, [](fs::path&) {});
  return paths;
}

fs::path carried_path(const fs::path& file, const fs::path& result) {
  const fs::path whole = split_mesh_path(file).file;
  std::string name = whole.filename().string();
  const std::size_t of_table = table_extension(whole).size();
  name.insert(of_table > 0 ? name.size() - of_table : whole.stem().string().size(), "-carried");
  return result.parent_path() / name;
}

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
