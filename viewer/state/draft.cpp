#include "state/draft.h"

#include <algorithm>

#include "lapwing/run/run_step.h"
#include "state/whole_step.h"

namespace lapwing::viewer {
namespace {

// Removes all handles, because they could conflict with the handles of the next step.
void remove_handles(History& history) {
  while (!history.state().selection.handles.empty()) {
    history.perform(RemoveHandle{history.state().selection.handles.size() - 1});
  }
}

void choose_belt(History& history, const BeltSpec& belt) {
  if (const auto* border = std::get_if<BoundaryAnchors>(&belt)) {
    history.perform(SetBeltWidth{border->fraction});
  } else {
    history.perform(Choose{{Part::Role::belt}, std::get<RegionSpec>(belt)});
  }
}

// Returns the intermediate move at `share` between rest (0) and `move` (1), as `run_recipe` does.
Move part_of(const Move& move, const Eigen::Vector3d& centroid, double share) {
  if (const auto* similarity = std::get_if<SimilarityMove>(&move)) {
    SimilarityMove part = *similarity;
    part.translate *= share;
    part.rotate.degrees *= share;
    part.scale = part.scale.array().pow(share);
    return part;
  }
  return MatrixMove{to_affine(move, centroid, share).affine()};
}

// Returns the moves of all handles, with paths of equal length.
std::vector<HandleMove> moves_of(const DeformRequest& step, const AppState& state) {
  std::size_t count = 0;
  for (const MovedHandle& handle : step.handles) count = std::max(count, handle.path.size());
  std::vector<HandleMove> moves;
  for (const MovedHandle& handle : step.handles) {
    const Eigen::Vector3d centroid = handle_centroid(state, moves.size());
    HandleMove& to = moves.emplace_back(handle.move, handle.orientation, handle.path);
    for (std::size_t k = to.path.size(); k < count; ++k) {
      const double share = static_cast<double>(k + 1) / static_cast<double>(count + 1);
      to.path.push_back(part_of(handle.move, centroid, share));
    }
  }
  return moves;
}

// Returns the step's mirror plane. If the step does not specify one, finds it on the surface.
std::optional<MirrorPlane> plane_of(const DeformRequest& step, const Mesh& surface) {
  if (!step.mirror) return std::nullopt;
  const auto* plane = std::get_if<MirrorPlane>(&step.mirror->plane);
  return plane != nullptr ? *plane : find_mirror_plane(surface, step.mirror->where).plane;
}

// Returns whether the state's selection equals the regions of the step.
bool is_chosen(const AppState& state, const DeformRequest& step) {
  const DeformRequest there = open_step(state);
  return there.roi == step.roi && there.belt == step.belt &&
         std::ranges::equal(there.handles, step.handles, {}, &MovedHandle::region,
                            &MovedHandle::region);
}

// Returns whether the regions are those of a Grab: a disk, possibly with the vertices that it cuts
// off, and a falloff about the centre of this disk.
bool is_grab(const DeformRequest& step) {
  if (step.handles.size() != 1 || !step.handles[0].falloff.transition) return false;
  const auto* both = std::get_if<UnionRegion>(&step.roi.form);
  const RegionSpec& first = both != nullptr ? both->parts.at(0) : step.roi;
  const auto* roi = std::get_if<GeodesicDisk>(&first.form);
  const auto* handle = std::get_if<GeodesicDisk>(&step.handles[0].region.form);
  return roi != nullptr && handle != nullptr && roi->center == handle->center;
}

}  // namespace

bool is_begun_grab(const DeformRequest& step) {
  return is_grab(step) && step.handles[0].move == Move(SimilarityMove{});
}

namespace {

// Carries out a Grab as one step, as it was made. Returns false if the step is not a Grab, or if it
// also changes other settings of the edit.
bool perform_grab(History& history, const DeformRequest& step) {
  if (!is_grab(step)) return false;
  const AppState next = apply(history.state(), NewEdit{});
  DeformRequest other = open_step(next);
  other.roi = step.roi;
  other.handles = step.handles;
  if (other != step) return false;
  history.perform(Grab{choose(step.roi, *next.rest, joined_seams(next)), step.handles[0].region,
                       step.handles[0].falloff});
  history.perform(MoveHandles{moves_of(step, history.state())}, Joining::with_last);
  return true;
}

void grade_handles(History& history, const DeformRequest& step) {
  const auto& handles = history.state().selection.handles;
  for (std::size_t h = 0; h < handles.size(); ++h) {
    if (handles[h].falloff != step.handles[h].falloff) {
      history.perform(SetFalloff{h, step.handles[h].falloff});
    }
  }
}

}  // namespace

Draft draft_of(const AppState& state) {
  Draft draft;
  for (const auto& step : state.steps) draft.steps.push_back(*step);
  draft.open = open_step(state);
  draft.settled = state.settled != nullptr;
  return draft;
}

bool is_selection(const DeformRequest& step) {
  return step.targets.empty();
}

Recipe to_recipe(const AppState& state, const std::filesystem::path& mesh,
                 const std::filesystem::path& base_directory) {
  Recipe recipe;
  recipe.mesh = mesh;
  recipe.base_directory = base_directory;
  for (const auto& step : state.steps) {
    recipe.steps.push_back(with_paths_from(*step, base_directory));
  }
  if (state.settled) recipe.steps.push_back(with_paths_from(open_step(state), base_directory));
  return recipe;
}

std::shared_ptr<const MovedVertices> solve_open_step(const AppState& state, Kernels& kernels,
                                                     const Progress& progress) {
  RunResult result;
  result.mesh = *state.rest;
  result.carried = carried_at_rest(state.carried);
  StepReport report =
      run_step(open_step(state), {state.steps.size() + 1, {}, kernels, progress, result, {}});
  MovedVertices moved = moved_vertices(state.rest->positions, result.mesh.positions);
  if (any_follows(state.carried)) moved.carried = share(std::move(result.carried));
  moved.certificate = std::make_shared<const Certificate>(std::move(report.deform->certificate));
  return std::make_shared<const MovedVertices>(std::move(moved));
}

CarryOut carry_out_with(Kernels& kernels, Progress progress) {
  return {[&kernels, progress](const AppState& state) {
            return solve_open_step(state, kernels, progress);
          },
          [&kernels, progress](const AppState& state, const Step& step) {
            return apply_step(state, step, {}, kernels, progress).result;
          }};
}

void carry_along(History& history, const std::vector<CarrySpec>& files) {
  const std::vector<CarriedObject> before = history.state().carried;
  for (const CarriedObject& object : before) {
    const bool is_named = std::ranges::find(files, object.file(), &CarrySpec::file) != files.end();
    if (object.follows && !is_named) history.perform(StopCarrying{object.file()});
  }
  for (const CarrySpec& spec : files) {
    const auto at = std::ranges::find(before, spec.file, &CarriedObject::file);
    if (at == before.end()) {
      history.perform(CarryAlong{open_carried(spec.file, spec.save)});
      continue;
    }
    auto file = std::make_shared<AttachmentFile>(*at->rest);
    file->save = spec.save;
    history.perform(CarryAlong{std::move(file)});
  }
}

namespace {

// Chooses regions and moves handles by the same commands as a user.
void perform_by_hand(History& history, const DeformRequest& step) {
  history.perform(Commit{});
  carry_along(history, step.carry);
  history.perform(SetParameters{step.parameters});
  const auto mirror = plane_of(step, *surface_of(history.state()));
  if (!is_chosen(history.state(), step)) {
    // Turn mirroring off, because a mirror image could overlap the next handle.
    history.perform(SetMirror{});
    remove_handles(history);
    history.perform(Choose{{Part::Role::roi}, step.roi});
    for (std::size_t h = 0; h < step.handles.size(); ++h) {
      history.perform(Choose{{Part::Role::handle, h}, step.handles[h].region});
    }
    choose_belt(history, step.belt);
  }
  grade_handles(history, step);
  if (history.state().selection.stiffness != step.stiffness) {
    history.perform(SetStiffness{step.stiffness});
  }
  history.perform(SetMirror{mirror});
  const auto is_plain = [](const MovedHandle& handle) {
    return handle.path.empty() && handle.orientation == HandleOrientation::kept;
  };
  if (std::ranges::all_of(step.handles, is_plain)) {
    for (std::size_t h = 0; h < history.state().moves.size(); ++h) {
      history.perform(MoveHandle{h, step.handles[h].move});
    }
  } else {
    history.perform(MoveHandles{moves_of(step, history.state())});
  }
}

}  // namespace

void perform(History& history, const DeformRequest& step, const Solve& solve) {
  if (!perform_grab(history, step)) perform_by_hand(history, step);
  if (solve && is_moved(history.state())) history.perform(Settle{solve(history.state())});
}

void perform(History& history, const Step& step, const CarryOut& carry_out) {
  const auto* deform = std::get_if<DeformRequest>(&step);
  // The viewer's tools cannot create a deform with targets, so it is applied as a whole step.
  if (deform != nullptr && is_selection(*deform)) {
    return perform(history, *deform, carry_out.solve);
  }
  if (deform != nullptr) {
    history.perform(Commit{});
    carry_along(history, deform->carry);
  }
  history.perform(Apply{step, carry_out.apply(history.state(), step)});
}

void perform(History& history, const Recipe& recipe, const CarryOut& carry_out) {
  for (const Step& step : recipe.steps) {
    perform(history, with_absolute_paths(step, recipe.base_directory), carry_out);
  }
}

History from_draft(AppState start, const Draft& draft, const CarryOut& carry_out) {
  History history(std::move(start));
  for (const Step& step : draft.steps) perform(history, step, carry_out);
  if (is_begun_grab(draft.open)) return history;
  perform(history, draft.open, draft.settled ? carry_out.solve : Solve{});
  return history;
}

History from_recipe(AppState start, const Recipe& recipe, const CarryOut& carry_out) {
  History history(std::move(start));
  perform(history, recipe, carry_out);
  return history;
}

}  // namespace lapwing::viewer
