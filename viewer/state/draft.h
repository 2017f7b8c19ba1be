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

/// Returns whether the whole step can be chosen and moved by hand: it has no targets.
bool is_selection(const DeformRequest& step);

/// Returns the recipe of the current surface: the steps so far, and the open one if it is settled.
/// Steps name files relative to `base_directory`, to which `mesh` must already be relative.
Recipe to_recipe(const AppState& state, const std::filesystem::path& mesh,
                 const std::filesystem::path& base_directory);

/// Computes the result of a state's moves.
using Solve = std::function<std::shared_ptr<const MovedVertices>(const AppState&)>;

/// Solves the open step as `run_recipe` does, with substeps if the step uses them. Throws what
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

/// Carries out a step. A deform that `is_selection` becomes the commands that a user would give, so
/// that each can be undone. Any other step is one command. Without `solve`, the handles of a deform
/// move, but the deform does not settle.
void perform(History& history, const DeformRequest& step, const Solve& solve);
void perform(History& history, const Step& step, const CarryOut& carry_out);
/// Carries out the steps of a recipe. A deform at the end stays the open step. Looks for files in
/// the recipe's base directory.
void perform(History& history, const Recipe& recipe, const CarryOut& carry_out);

/// Return the history that leads from `start` to the draft, or through the steps of the recipe. The
/// mesh of `start` may differ from the mesh of the recipe. Throw what `apply` and `carry_out`
/// throw.
History from_draft(AppState start, const Draft& draft, const CarryOut& carry_out);
History from_recipe(AppState start, const Recipe& recipe, const CarryOut& carry_out);

}  // namespace lapwing::viewer
