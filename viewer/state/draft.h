#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/kernels/kernels.h"
#include "state/applied_step.h"
#include "state/history.h"

namespace lapwing::viewer {

/// An edit as its recipe and what stands open before it: everything of a state that cannot be
/// computed again.
struct Draft {
  std::vector<Step> steps;  ///< committed or applied
  DeformRequest open;       ///< chosen and moved; what is not chosen is an empty list
  bool settled = false;     ///< whether the open step has its result

  bool operator==(const Draft&) const = default;
};

Draft draft_of(const AppState& state);

/// Whether all that a step does can be chosen and moved by hand: it has no targets.
bool is_selection(const DeformRequest& step);

/// The recipe of what the surface is now: the steps so far, and the open one if it is settled.
/// `run_recipe` makes the positions of the state of it. Files that the steps name are named from
/// `base_directory`, as `mesh` is already.
Recipe to_recipe(const AppState& state, const std::filesystem::path& mesh,
                 const std::filesystem::path& base_directory);

/// What a state's moves come to.
using Solve = std::function<std::shared_ptr<const MovedVertices>(const AppState&)>;

/// Runs the open step as `run_recipe` does, in parts where it says so, and then certifies all of
/// them as one. Throws what that does.
std::shared_ptr<const MovedVertices> solve_open_step(const AppState& state, Kernels& kernels,
                                                     const Progress& progress = {});

/// How the steps of a recipe are carried out. What throws ends the replay.
struct CarryOut {
  Solve solve;  ///< the moves of a deform step
  /// Any other step, on the surface of a state.
  std::function<std::shared_ptr<const AppliedStep>(const AppState&, const Step&)> apply;
};
/// As `run_recipe` does it. `kernels` must outlive it.
CarryOut carry_out_with(Kernels& kernels, Progress progress = {});

/// Makes `files`, named by absolute paths, those that the open step takes along, by commands. Opens
/// those that are not there: throws what `open_carried` does.
void carry_along(History& history, const std::vector<CarrySpec>& files);

/// Carries a deform step that is a selection out by the commands that a person would have used,
/// which can then be undone one by one. Without `solve` its handles are left moved and not settled.
void perform(History& history, const DeformRequest& step, const Solve& solve);
/// Carries any step out: a deform of that kind as above, another as one command.
void perform(History& history, const Step& step, const CarryOut& carry_out);

/// The history that leads from `start` to `draft`. Throws what `apply` and `carry_out` do.
History restore(AppState start, const Draft& draft, const CarryOut& carry_out);

/// A recipe's steps from `start`, whose mesh need not be the recipe's own; a last deform stays
/// open. Files that steps name are looked for in the recipe's base directory. Throws what `apply`
/// and `carry_out` do.
History from_recipe(AppState start, const Recipe& recipe, const CarryOut& carry_out);
/// The same, going on with `history`.
void perform(History& history, const Recipe& recipe, const CarryOut& carry_out);

}  // namespace lapwing::viewer
