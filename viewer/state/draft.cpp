#include "state/draft.h"

#include "lapwing/base/errors.h"
#include "lapwing/session/run_deform.h"

namespace lapwing::viewer {
namespace {

bool is_nothing(const RegionSpec& spec) {
  const auto* list = std::get_if<ListedVertices>(&spec.form);
  return list != nullptr && list->vertices.empty();
}

// A handle too many would stand in the way of the step's own.
void remove_handles(History& history) {
  while (!history.state().selection.handles.empty()) {
    history.perform(RemoveHandle{history.state().selection.handles.size() - 1});
  }
}

void choose_belt(History& history, const BeltSpec& belt) {
  if (const auto* border = std::get_if<BorderBelt>(&belt)) {
    history.perform(SetBeltWidth{border->fraction});
  } else {
    history.perform(Choose{{Part::Role::belt}, std::get<RegionSpec>(belt)});
  }
}

// Whether the step's parts are what is chosen already.
bool is_chosen(const AppState& state, const DeformStep& step) {
  DeformStep there = open_step(state);
  if (there.roi != step.roi || there.belt != step.belt) return false;
  return std::equal(
      there.handles.begin(), there.handles.end(), step.handles.begin(), step.handles.end(),
      [](const MovedHandle& a, const MovedHandle& b) { return a.region == b.region; });
}

}  // namespace

Draft draft_of(const AppState& state) {
  Draft draft;
  for (const auto& step : state.steps) draft.steps.push_back(*step);
  draft.open = open_step(state);
  draft.settled = state.settled != nullptr;
  return draft;
}

Recipe to_recipe(const AppState& state, const std::filesystem::path& mesh,
                 const std::filesystem::path& base_directory) {
  Recipe recipe;
  recipe.mesh = mesh;
  recipe.base_directory = base_directory;
  for (const auto& step : state.steps) recipe.steps.emplace_back(*step);
  if (state.settled) recipe.steps.emplace_back(open_step(state));
  return recipe;
}

Solved solve_open_step(const AppState& state, Kernels& kernels, const Progress& progress) {
  RunResult result;
  result.mesh = *state.rest;
  result.topology = *state.topology;
  StepReport report = run_step(open_step(state), state.steps.size() + 1, kernels, progress, result);
  return {std::make_shared<const MovedVertices>(
              moved_vertices(state.rest->positions, result.mesh.positions)),
          std::move(report.certificate)};
}

Solve solve_with(Kernels& kernels, Progress progress) {
  return [&kernels, progress = std::move(progress)](const AppState& state) {
    return solve_open_step(state, kernels, progress).moved;
  };
}

void perform(History& history, const DeformStep& step, const Solve& solve) {
  history.perform(Commit{});
  history.perform(SetParameters{step.parameters});
  if (!is_chosen(history.state(), step)) {
    remove_handles(history);
    history.perform(Choose{{Part::Role::roi}, step.roi});
    for (std::size_t h = 0; h < step.handles.size(); ++h) {
      if (is_nothing(step.handles[h].region)) continue;
      history.perform(Choose{{Part::Role::handle, h}, step.handles[h].region});
    }
    choose_belt(history, step.belt);
  }
  for (std::size_t h = 0; h < history.state().moves.size(); ++h) {
    history.perform(MoveHandle{h, step.handles[h].move});
  }
  if (solve && is_moved(history.state())) history.perform(Settle{solve(history.state())});
}

History restore(Mesh mesh, const Draft& draft, const Solve& solve) {
  History history(open_state(std::move(mesh)));
  for (const DeformStep& step : draft.steps) perform(history, step, solve);
  perform(history, draft.open, draft.settled ? solve : Solve{});
  return history;
}

namespace {

// One overload per operation.
struct Operation {
  const char* operator()(const DeformStep&) const { return "deform"; }
  const char* operator()(const CoatStep&) const { return "coat"; }
  const char* operator()(const MixStep&) const { return "mix"; }
  const char* operator()(const TransplantStep&) const { return "transplant"; }
};

}  // namespace

std::vector<DeformStep> deform_steps(const Recipe& recipe) {
  std::vector<DeformStep> steps;
  for (const Step& step : recipe.steps) {
    const auto* deform = std::get_if<DeformStep>(&step);
    if (deform == nullptr) {
      throw InputError("step " + std::to_string(steps.size() + 1) + " is a " +
                       std::visit(Operation{}, step) +
                       ", which the viewer cannot replay; `lapwing run` carries it out, "
                       "and the viewer opens the mesh it saves");
    }
    steps.push_back(*deform);
  }
  return steps;
}

History from_recipe(Mesh mesh, const Recipe& recipe, const Solve& solve) {
  const std::vector<DeformStep> steps = deform_steps(recipe);
  History history(open_state(std::move(mesh)));
  for (const DeformStep& step : steps) perform(history, step, solve);
  return history;
}

}  // namespace lapwing::viewer
