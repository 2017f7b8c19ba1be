#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/deform/certificate.h"
#include "lapwing/kernels/kernels.h"
#include "state/history.h"

namespace lapwing::viewer {

/// An edit as its recipe and what stands open before it: everything of a state that cannot be
/// computed again.
struct Draft {
  std::vector<DeformStep> steps;  ///< committed
  DeformStep open;                ///< chosen and moved; what is not chosen is an empty list
  bool settled = false;           ///< whether the open step has its result

  bool operator==(const Draft&) const = default;
};

Draft draft_of(const AppState& state);

/// The recipe of what the surface is now: the committed steps, and the open one if it is settled.
/// `run_recipe` makes the positions of the state of it.
Recipe to_recipe(const AppState& state, const std::filesystem::path& mesh,
                 const std::filesystem::path& base_directory);

/// What a state's moves come to.
using Solve = std::function<std::shared_ptr<const MovedVertices>(const AppState&)>;

struct Solved {
  std::shared_ptr<const MovedVertices> moved;
  Certificate certificate;
};
/// Runs the open step as `run_recipe` does, in parts where it says so. Throws what that does.
Solved solve_open_step(const AppState& state, Kernels& kernels, const Progress& progress = {});

/// A Solve that does that. `kernels` must outlive it.
Solve solve_with(Kernels& kernels, Progress progress = {});

/// Carries a step of a recipe out by the commands that a person would have used, which can then be
/// undone one by one. Without `solve` its handles are left moved and not settled.
void perform(History& history, const DeformStep& step, const Solve& solve);

/// The history that leads to `draft` on `mesh`. Throws what `apply` and `solve` do.
History restore(Mesh mesh, const Draft& draft, const Solve& solve);

/// The steps of `recipe`, all of which the viewer can replay. Throws InputError, naming the step
/// and what to do, where one is no deform.
std::vector<DeformStep> deform_steps(const Recipe& recipe);

/// A recipe's steps on `mesh`, which need not be its own; the last one stays open. Throws what
/// `deform_steps`, `apply` and `solve` do.
History from_recipe(Mesh mesh, const Recipe& recipe, const Solve& solve);

}  // namespace lapwing::viewer
