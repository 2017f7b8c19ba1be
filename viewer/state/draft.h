#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/kernels/kernels.h"
#include "state/history.h"
#include "state/whole_step.h"

namespace lapwing::viewer {

/// An edit as its committed steps and its open step: everything in a state that cannot be computed
/// again.
struct Draft {
  std::vector<Step> steps;  ///< committed or applied
  DeformRequest open;       ///< the open step; parts that are not chosen are empty lists
  bool settled = false;     ///< whether the open step has its result

  bool operator==(const Draft&) const = default;
};

Draft draft_of(const AppState& state);

/// Returns whether the user can make the whole step in the viewer, because it has no targets.
bool is_selection(const DeformRequest& step);

/// Returns the recipe of the current surface. It consists of the past steps, and of the open step
/// if it has settled. File names in the steps become relative to `base_directory`. `mesh` must
/// already be relative to `base_directory`.
Recipe to_recipe(const AppState& state, const std::filesystem::path& mesh,
                 const std::filesystem::path& base_directory);

/// Computes the result of a state's moves.
using Solve = std::function<std::shared_ptr<const MovedVertices>(const AppState&)>;

/// Computes the result of the open step as `run_recipe` does, including substeps. Throws what
/// `run_recipe` throws.
std::shared_ptr<const MovedVertices> solve_open_step(const AppState& state, Kernels& kernels,
                                                     const Progress& progress = {});

/// The functions that carry out the steps of a recipe. An exception ends the replay.
struct CarryOut {
  Solve solve;  ///< the moves of a deform step
  /// Carries out any other step on the surface of a state.
  std::function<std::shared_ptr<const AppliedStep>(const AppState&, const Step&)> apply;
};
/// Returns functions that work as `run_recipe` does. `kernels` must outlive them.
CarryOut carry_out_with(Kernels& kernels, Progress progress = {});

/// Makes the open step carry exactly `files`, named by absolute paths, with commands. Opens files
/// that are new; throws what `open_carried` throws.
void carry_along(History& history, const std::vector<CarrySpec>& files);

/// Carries out a step. If the step is a deform and `is_selection` is true, performs the commands
/// that a user would give, so that each of them can be undone. Performs any other step as one
/// command. If `solve` is null, the handles of a deform move, but the surface does not settle.
void perform(History& history, const DeformRequest& step, const Solve& solve);
void perform(History& history, const Step& step, const CarryOut& carry_out);
/// Carries out the steps of a recipe. If the last step is a deform, it remains the open step. File
/// names are relative to the recipe's base directory.
void perform(History& history, const Recipe& recipe, const CarryOut& carry_out);

/// Return the history that begins at `start` and carries out the steps of the draft or recipe. The
/// mesh of `start` may differ from the mesh that the recipe names. Throw what `apply` and
/// `carry_out` throw.
History from_draft(AppState start, const Draft& draft, const CarryOut& carry_out);
History from_recipe(AppState start, const Recipe& recipe, const CarryOut& carry_out);

}  // namespace lapwing::viewer
