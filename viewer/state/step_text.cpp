#include "state/step_text.h"

#include <functional>

#include "lapwing/step/step_files.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

Step with_paths(Step step, const std::function<fs::path(const fs::path&)>& change) {
  const auto change_it = [&](fs::path& path) {
    if (!path.empty()) path = change(path);
  };
  for_each_file(step, change_it, change_it);
  return step;
}

}  // namespace

std::string describe(const Step& step) {
  const std::vector<fs::path> paths = files_read(step);
  const Operation& operation = operation_of(step);
  std::string words(operation.name);
  if (paths.empty() || (paths.size() == 1 && paths.front().empty())) return words;
  std::string_view before = operation.before_files;
  for (const fs::path& path : paths) {
    words.append(before).append(path.empty() ? "the mesh itself" : path.filename().string());
    before = " and ";
  }
  return words;
}

Step with_absolute_paths(Step step, const fs::path& base_directory) {
  return with_paths(std::move(step), [&](const fs::path& path) {
    return fs::absolute(base_directory / path).lexically_normal();
  });
}

Step with_paths_from(Step step, const fs::path& base_directory) {
  const fs::path folder = fs::absolute(base_directory).lexically_normal();
  return with_paths(std::move(step),
                    [&](const fs::path& path) { return path.lexically_proximate(folder); });
}

}  // namespace lapwing::viewer
