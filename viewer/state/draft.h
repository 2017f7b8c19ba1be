#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/kernels/kernels.h"
#include "state/history.h"
#include "state/whole_step.h"

namespace lapwing::viewer {

/// The committed steps and the open step of an edit. The rest of the state can be recomputed from
/// them.
struct Draft {
  std::vector<Step> steps;  ///< committed or applied
  /// A part that is not selected yet is an empty vertex list.
  DeformRequest open = {.roi = {ListedVertices{}}};
  bool settled = false;  ///< whether the state contains the result of `open`

  bool operator==(const Draft&) const = default;
};

Draft draft_of(const AppState& state);

/// Returns whether the viewer's tools can create the step. They cannot create targets.
bool is_selection(const DeformRequest& step);

/// Returns whether the step is a grab that has not moved yet, which is not a step of the history.
bool is_begun_grab(const DeformRequest& step);

/// Returns the recipe of the current surface: the committed steps, and the open step if it has
/// settled. File paths in the steps become relative to `base_directory`; `mesh` must already be
/// relative to it.
Recipe to_recipe(const AppState& state, const std::filesystem::path& mesh,
                 const std::filesystem::path& base_directory);

/// Computes the settled surface for the moves of a state.
using Solve = std::function<std::shared_ptr<const MovedVertices>(const AppState&)>;

/// Computes the result of the open step as `run_recipe` does, including substeps. Throws the errors
/// of `run_recipe`.
std::shared_ptr<const MovedVertices> solve_open_step(const AppState& state, Kernels& kernels,
                                                     const Progress& progress = {});

/// The functions that carry out the steps of a recipe. An exception ends the replay.
struct CarryOut {
  Solve solve;  ///< computes the result of a deform step
  /// Computes the result of any other step on the surface of a state.
  std::function<std::shared_ptr<const AppliedStep>(const AppState&, const Step&)> apply;
};
/// Returns functions that work as `run_recipe` does. `kernels` must outlive them.
CarryOut carry_out_with(Kernels& kernels, Progress progress = {});

/// Performs commands after which the open step carries exactly `files`, whose paths are absolute.
/// Opens new files. Throws the errors of `open_carried`.
void carry_along(History& history, const std::vector<CarrySpec>& files);

/// Carries out a step. If the step is a deform and `is_selection` is true, performs the commands
/// that a user would give, so that each of them can be undone; a grab is one step. Performs any
/// other step as one command. If `solve` is null, the handles of a deform move, but the surface
/// does not settle.
void perform(History& history, const DeformRequest& step, const Solve& solve);
void perform(History& history, const Step& step, const CarryOut& carry_out);
/// Carries out the steps of a recipe. If the last step is a deform, it remains the open step. File
/// paths are relative to the recipe's base directory.
void perform(History& history, const Recipe& recipe, const CarryOut& carry_out);

/// Return a history that begins at `start` and contains the steps of the draft or recipe. The mesh
/// of `start` may differ from the mesh that the recipe names. Throw the errors of `apply` and
/// `carry_out`.
History from_draft(AppState start, const Draft& draft, const CarryOut& carry_out);
History from_recipe(AppState start, const Recipe& recipe, const CarryOut& carry_out);

}  // namespace lapwing::viewer
