#include "lapwing/run/session.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/memory_use.h"

namespace lapwing {
namespace {

std::size_t steps_in_common(const Recipe& a, const Recipe& b) {
  const auto [end, _] =
      std::mismatch(a.steps.begin(), a.steps.end(), b.steps.begin(), b.steps.end());
  return static_cast<std::size_t>(end - a.steps.begin());
}

DeformWorkspace workspace_with(const std::optional<JoinedSurface>& joined) {
  DeformWorkspace workspace;
  workspace.joined = joined;
  return workspace;
}

}  // namespace

// Keeps the checkpoints within the initial steps that `recipe` and the last recipe have in common,
// and deletes all others. If the mesh is different, creates a checkpoint before the first step.
void Session::find_checkpoints(const Recipe& recipe, const Progress& progress) {
  const std::shared_ptr<const Mesh> mesh = meshes_.mesh(recipe.base_directory, recipe.mesh);
  const bool begins_alike = !checkpoints_.empty() && checkpoints_.front().read == mesh &&
                            last_.mesh == recipe.mesh &&
                            last_.base_directory == recipe.base_directory;
  common_ = begins_alike ? steps_in_common(last_, recipe) : 0;
  last_ = recipe;
  if (begins_alike) {
    std::erase_if(checkpoints_, [&](const Checkpoint& checkpoint) {
      return checkpoint.after.report.steps.size() > common_;
    });
    return;
  }
  checkpoints_.clear();
  RunResult begun;
  begin_run(recipe, meshes_, kernels_, progress, begun);
  checkpoints_.push_back({mesh, std::move(begun), {}, {}});
}

// The workspace is moved to the result while the step runs. If the step fails, the workspace is
// lost.
void Session::run_step_at(Checkpoint& checkpoint, const Recipe& recipe, const Progress& progress,
                          RunResult& result) {
  const bool deforms =
      std::holds_alternative<DeformRequest>(recipe.steps[result.report.steps.size()]);
  if (deforms) {
    result.deformed = std::exchange(checkpoint.workspace, workspace_with(checkpoint.joined));
  }
  run_next_step(recipe, meshes_, kernels_, progress, result);
  if (deforms) {
    checkpoint.workspace = std::exchange(result.deformed, {});
    result.deformed = workspace_with(checkpoint.workspace.joined);
  }
}

std::unique_ptr<RunResult> Session::run(const Recipe& recipe, const Progress& progress) {
  const ProgressScope scope(progress);
  find_checkpoints(recipe, progress);
  auto result = std::make_unique<RunResult>();
  static_cast<RunState&>(*result) = checkpoints_.back().after;
  result->deformed = workspace_with(checkpoints_.back().joined);
  const std::vector<StepReport>& done = result->report.steps;
  while (done.size() < recipe.steps.size()) {
    const auto is_here = [&] {
      return checkpoints_.back().after.report.steps.size() == done.size();
    };
    if (done.size() == common_ && !is_here()) {
      const std::optional<JoinedSurface>& joined = result->deformed.joined;
      checkpoints_.push_back({checkpoints_.front().read, *result, joined, workspace_with(joined)});
    }
    if (is_here()) {
      run_step_at(checkpoints_.back(), recipe, progress, *result);
    } else {
      run_next_step(recipe, meshes_, kernels_, progress, *result);
    }
  }
  result->report.peak_memory_bytes = peak_memory_bytes();
  return result;
}

}  // namespace lapwing
