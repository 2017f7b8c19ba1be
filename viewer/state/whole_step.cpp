#include "state/whole_step.h"

#include <algorithm>
#include <cctype>
#include <functional>

#include "lapwing/recipe/recipe_files.h"
#include "lapwing/run/run_step.h"
#include "state/command.h"

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

bool same_faces(const Mesh& a, const Mesh& b) {
  return a.vertex_count() == b.vertex_count() && a.face_starts() == b.face_starts() &&
         a.face_vertices() == b.face_vertices();
}

std::shared_ptr<const AppliedStep> difference(const AppState& before, const Step& step,
                                              RunResult result) {
  if (same_faces(*before.rest, result.mesh)) {
    MovedVertices moved = moved_vertices(before.rest->positions, result.mesh.positions);
    const auto* deform = std::get_if<DeformRequest>(&step);
    if (deform != nullptr && !deform->carry.empty()) {
      moved.carried = share(std::move(result.carried));
    }
    return std::make_shared<const AppliedStep>(std::move(moved));
  }
  return std::make_shared<const AppliedStep>(std::make_shared<const Mesh>(std::move(result.mesh)));
}

}  // namespace

std::string describe(const Step& step) {
  const std::vector<fs::path> paths = files_read(step);
  const Operation& operation = operation_of(step);
  std::string words(operation.name);
  words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  std::ranges::replace(words, '_', ' ');
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

CarriedOut apply_step(const AppState& state, const Step& step,
                      const std::filesystem::path& base_directory, Kernels& kernels,
                      const Progress& progress) {
  const AppState committed = apply(state, Commit{});
  RunResult result;
  result.mesh = *committed.rest;
  result.original = committed.rest->positions;
  result.carried = carried_at_rest(committed.carried);
  CarriedOut out;
  out.report =
      run_step(step, {committed.steps.size() + 1, base_directory, kernels, progress, result, {}});
  out.warnings = std::move(result.report.warnings);
  const std::vector<std::string>& notes = result.report.notes;
  out.warnings.insert(out.warnings.end(), notes.begin(), notes.end());
  result.deformed = {};
  out.result = difference(committed, step, std::move(result));
  return out;
}

}  // namespace lapwing::viewer
