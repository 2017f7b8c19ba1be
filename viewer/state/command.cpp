#include "state/command.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/deform/modifiers/mirror.h"
#include "lapwing/recipe/step.h"
#include "lapwing/region/joined_regions.h"
#include "state/waypoints.h"
#include "state/whole_step.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

void require_handle(const AppState& state, std::size_t handle) {
  if (handle < state.selection.handles.size()) return;
  throw InputError("There is no handle " + std::to_string(handle + 1) + ". Select a handle first.");
}

void require_vertices(const AppState& state, const VertexSet& vertices) {
  if (vertices.empty() || vertices.back() < state.rest->vertex_count()) return;
  throw InputError("Vertex " + std::to_string(vertices.back()) + " is not in the mesh.");
}

// Throws InputError if the falloff is invalid, or if its painted weights are not one per vertex.
void require_falloff_here(const AppState& state, const Falloff& falloff, const std::string& where) {
  require_falloff(falloff, where);
  const std::size_t count = state.rest->vertex_count();
  if (falloff.field.empty() || falloff.field.size() == count) return;
  throw InputError(where + ": expected a weight for each of the mesh's " + std::to_string(count) +
                   " vertices, got " + std::to_string(falloff.field.size()));
}

// Updates the selection after a change of the rest shape. ROI, handles and a belt chosen by hand
// keep their vertices.
void carry_selection_over(AppState& state) {
  EditSelection& selection = state.selection;
  const JoinedSurface* joined = joined_seams(state);
  selection.roi = carried_over(selection.roi, *state.rest, joined);
  for (ChosenRegion& handle : selection.handles) {
    handle = carried_over(handle, *state.rest, joined);
  }
  if (!selection.belt_fraction) {
    selection.belt = carried_over(selection.belt, *state.rest, joined);
  }
  renew_belt(selection, *state.rest, joined);
}

// Updates the selection after the seam policy has changed. If the seams are joined, the selection
// contains only the leader of each group of joined vertices; if they are open, all vertices.
void choose_seams_anew(AppState& state) {
  if (!state.joined) return;
  const auto choose_anew = [&](ChosenRegion& region) {
    VertexSet vertices = region.vertices;
    if (joined_seams(state) == nullptr) {
      vertices = with_followers(vertices, *state.joined);
    } else {
      std::erase_if(vertices, [&](Index v) { return state.joined->is_follower(v); });
    }
    region = choose({ListedVertices{std::move(vertices)}}, *state.rest);
  };
  choose_anew(state.selection.roi);
  for (ChosenRegion& handle : state.selection.handles) choose_anew(handle);
  if (!state.selection.belt_fraction) choose_anew(state.selection.belt);
  renew_belt(state.selection, *state.rest, joined_seams(state));
}

std::vector<CarriedObject>::iterator find_carried(AppState& state, const fs::path& file) {
  return std::ranges::find(state.carried, file, &CarriedObject::file);
}

// Returns whether an earlier step carries the file, so that a run of the recipe opens and saves it.
bool was_carried(const AppState& state, const fs::path& file) {
  return std::ranges::any_of(state.steps, [&](const auto& step) {
    const auto* deform = std::get_if<DeformRequest>(step.get());
    return deform != nullptr &&
           std::ranges::find(deform->carry, file, &CarrySpec::file) != deform->carry.end();
  });
}

// Updates the carried files to those after a step. Files that the step has opened are added.
void take_over(AppState& state, const CarriedFiles& carried) {
  for (std::size_t k = 0; k < carried.size(); ++k) {
    if (k == state.carried.size()) {
      state.carried.push_back({carried[k], carried[k]});
    } else {
      state.carried[k].rest = carried[k];
    }
  }
}

// Makes the settled surface the rest shape, and adds the open edit to the steps.
void commit(AppState& state) {
  if (!is_moved(state)) return;
  if (!state.settled) {
    throw InputError("The last move is not refined yet. Wait for its result, or undo it.");
  }
  state.steps.push_back(std::make_shared<const Step>(open_step(state)));
  set_rest(state, std::make_shared<const Mesh>(mesh_of(state)));
  take_over(state, state.settled->carried);
  state.settled = nullptr;
  for (HandleMove& to : state.moves) to = HandleMove();
  carry_selection_over(state);
}

// Moves the vertices of the rest shape. Rejects a result with vertices that the mesh does not have.
void take_over(AppState& state, const MovedVertices& moved) {
  require_vertices(state, moved.vertices);
  auto mesh = std::make_shared<Mesh>(*state.rest);
  place(moved, mesh->positions);
  set_rest(state, std::move(mesh));
  take_over(state, moved.carried);
  carry_selection_over(state);
}

// Replaces the rest shape by a mesh with new connectivity. Clears the selection, because vertex
// numbers have changed.
void take_over(AppState& state, const std::shared_ptr<const Mesh>& other) {
  set_rest(state, other);
  state.moves.clear();
  const auto fraction = state.selection.belt_fraction;
  state.selection = {};
  if (fraction) state.selection.belt_fraction = fraction;
}

// Returns the ROI and, with mirroring, its mirror image.
VertexSet both_sides(const VertexSet& roi, const AppState& state) {
  if (!state.selection.mirror) return roi;
  const auto images = mirror_images(*surface_of(state), *state.selection.mirror, "mirror");
  return unite(roi, mirrored(roi, images));
}

void erase_handle(AppState& state, std::size_t handle) {
  const auto offset = static_cast<std::ptrdiff_t>(handle);
  state.selection.handles.erase(state.selection.handles.begin() + offset);
  state.moves.erase(state.moves.begin() + offset);
}

// Removes vertices outside the ROI from handles and belt, because vertices outside do not move. If
// the ROI is empty, handles and belt do not change.
void let_go_outside_roi(AppState& state) {
  EditSelection& selection = state.selection;
  const VertexSet& roi = selection.roi.vertices;
  const auto leaves = [](const ChosenRegion& region, const VertexSet& held) {
    return !subtract(region.vertices, held).empty();
  };
  const bool belt_leaves = !selection.belt_fraction && leaves(selection.belt, roi);
  const bool handle_leaves = std::ranges::any_of(
      selection.handles, [&](const ChosenHandle& handle) { return leaves(handle, roi); });
  if (roi.empty() || (!belt_leaves && !handle_leaves)) return;
  const VertexSet held = both_sides(roi, state);
  for (std::size_t h = selection.handles.size(); h-- > 0;) {
    ChosenRegion& handle = selection.handles[h];
    if (!leaves(handle, held)) continue;
    VertexSet inside = intersect(handle.vertices, held);
    if (inside.empty()) {
      erase_handle(state, h);
    } else {
      handle = repainted(handle, std::move(inside));
    }
  }
  if (selection.belt_fraction || !leaves(selection.belt, held)) return;
  selection.belt = repainted(selection.belt, intersect(selection.belt.vertices, held));
  if (selection.belt.vertices.empty()) selection.belt_fraction = BoundaryAnchors{}.fraction;
}

// Returns the region of `part`. Creates the handle if its index equals the number of handles.
ChosenRegion& region_of(AppState& state, const Part& part) {
  if (part.role == Part::Role::roi) return state.selection.roi;
  if (part.role == Part::Role::belt) return state.selection.belt;
  auto& handles = state.selection.handles;
  if (part.handle == handles.size()) {
    handles.emplace_back();
    state.moves.emplace_back();
  }
  require_handle(state, part.handle);
  return handles[part.handle];
}

// Applies a command to `state`, with one overload per command.
struct Applier {
  AppState& state;

  void replace(const Part& part, ChosenRegion region) const {
    region_of(state, part) = std::move(region);
    if (part.role == Part::Role::belt) state.selection.belt_fraction.reset();
    if (part.role == Part::Role::roi) let_go_outside_roi(state);
    renew_belt(state.selection, *state.rest, joined_seams(state));
  }

  void operator()(const Choose& command) const {
    commit(state);
    if (command.falloff) require_falloff_here(state, *command.falloff, "handle");
    replace(command.part, choose(command.region, *state.rest, joined_seams(state)));
    if (command.falloff && command.part.role == Part::Role::handle) {
      state.selection.handles[command.part.handle].falloff = *command.falloff;
    }
  }
  void operator()(const Paint& command) const {
    require_vertices(state, command.added);
    commit(state);
    const ChosenRegion& before = region_of(state, command.part);
    VertexSet vertices = subtract(unite(before.vertices, command.added), command.removed);
    replace(command.part, repainted(before, std::move(vertices)));
  }
  void operator()(const EnlargeRoi& command) const {
    require_vertices(state, command.added);
    const ChosenRegion& before = state.selection.roi;
    VertexSet vertices = unite(before.vertices, command.added);
    if (vertices.size() == before.vertices.size()) return;
    replace({Part::Role::roi}, repainted(before, std::move(vertices)));
    state.settled = nullptr;
  }
  void operator()(const Grab& command) const {
    require_falloff_here(state, command.falloff, "handle");
    (*this)(NewEdit{});
    const JoinedSurface* joined = joined_seams(state);
    state.selection.roi = command.roi;
    ChosenHandle handle = choose(command.handle, *state.rest, joined);
    handle.falloff = command.falloff;
    state.selection.handles.push_back(std::move(handle));
    state.moves.emplace_back();
    renew_belt(state.selection, *state.rest, joined);
  }
  void operator()(const SetFalloff& command) const {
    require_handle(state, command.handle);
    ChosenHandle& handle = state.selection.handles[command.handle];
    if (handle.falloff == command.falloff) return;
    require_falloff_here(state, command.falloff, "handle " + std::to_string(command.handle + 1));
    handle.falloff = command.falloff;
    renew_belt(state.selection, *state.rest, joined_seams(state));
    state.settled = nullptr;
  }
  void operator()(const RemoveHandle& command) const {
    require_handle(state, command.handle);
    commit(state);
    erase_handle(state, command.handle);
    renew_belt(state.selection, *state.rest, joined_seams(state));
  }
  void operator()(const SetBeltWidth& command) const {
    if (!(command.fraction >= 0.0 && command.fraction <= 1.0)) {
      throw InputError(
          "The width of the fixed border is a fraction of the radius. Choose a value from 0 to 1.");
    }
    if (state.selection.belt_fraction == command.fraction) return;
    state.selection.belt_fraction = command.fraction;
    renew_belt(state.selection, *state.rest, joined_seams(state));
    state.settled = nullptr;
  }
  void operator()(const SetMirror& command) const {
    if (state.selection.mirror == command.plane) return;
    if (command.plane) require_through(*command.plane, *surface_of(state), "mirror");
    state.selection.mirror = command.plane;
    state.settled = nullptr;
  }
  void operator()(const SetStiffness& command) const {
    if (state.selection.stiffness == command.parts) return;
    resolve_stiffness(command.parts, {}, *state.rest);  // throws if a part is invalid
    state.selection.stiffness = command.parts;
    state.settled = nullptr;
  }
  void operator()(const MoveHandle& command) const {
    require_handle(state, command.handle);
    HandleMove& now = state.moves[command.handle];
    const HandleMove& to = command.to;
    if (now.move == to.move && now.orientation == to.orientation) return;
    require_move(to);
    extend_path(state, command.handle, to);
    now.move = to.move;
    now.orientation = to.orientation;
    // With substeps, the surface does not depend on the path.
    if (!is_moved(state) || state.parameters.commit_every) clear_paths();
    state.settled = nullptr;
  }
  void operator()(const MoveHandles& command) const {
    if (command.to.size() != state.moves.size()) {
      throw InputError("There are " + std::to_string(state.moves.size()) + " handles, but " +
                       std::to_string(command.to.size()) + " moves. Give one per handle.");
    }
    for (const HandleMove& to : command.to) require_move(to);
    if (state.moves == command.to) return;
    state.moves = command.to;
    state.settled = nullptr;
  }
  void clear_paths() const {
    for (HandleMove& to : state.moves) to.path.clear();
  }
  void require_move(const HandleMove& to) const {
    require_valid(to.move, state.parameters);
    for (const Move& waypoint : to.path) require_valid(waypoint, state.parameters);
    if (to.orientation == HandleOrientation::free && !allows_free_handles(state.parameters)) {
      throw InputError(
          "A handle rotates freely only if \"Refine\" is on and \"Hold exactly\" and \"Split into "
          "steps of\" are off in the solver settings.");
    }
  }
  void operator()(const Settle& command) const {
    if (!is_moved(state)) throw InputError("No handle has been moved. Drag a handle first.");
    if (!command.result) throw InputError("The result is missing. Refine the edit first.");
    if (any_follows(state.carried) && command.result->carried.size() != state.carried.size()) {
      throw InputError("The result lacks an attached object. Refine the edit again.");
    }
    state.settled = command.result;
  }
  void operator()(const Commit&) const { commit(state); }
  void operator()(const NewEdit&) const {
    commit(state);
    EditSelection cleared;
    cleared.mirror = state.selection.mirror;
    cleared.stiffness = state.selection.stiffness;
    if (state.selection.belt_fraction) cleared.belt_fraction = state.selection.belt_fraction;
    state.selection = std::move(cleared);
    state.moves.clear();
  }
  void operator()(const SetParameters& command) const {
    if (state.parameters == command.parameters) return;
    // Reject values that a recipe cannot contain, because the journal could not restore them.
    require_valid(command.parameters);
    for (const HandleMove& to : state.moves) require_valid(to.move, command.parameters);
    if (command.parameters.commit_every) clear_paths();
    if (!allows_free_handles(command.parameters)) {
      for (std::size_t h = 0; h < state.moves.size(); ++h) {
        state.moves[h].move = shown_move(state, h);
        state.moves[h].orientation = HandleOrientation::kept;
      }
    }
    const SeamPolicy before = std::exchange(state.parameters, command.parameters).seams;
    if (state.parameters.seams != before) choose_seams_anew(state);
    state.settled = nullptr;
  }
  void operator()(const CarryAlong& command) const {
    if (!command.file) throw InputError("The file to attach is missing.");
    const auto at = find_carried(state, command.file->file());
    const fs::path& save = command.file->save;
    if (at == state.carried.end()) {
      state.carried.push_back({command.file, command.file});
    } else {
      const bool is_saved_so = save.empty() || save == at->rest->save;
      if (at->follows && is_saved_so) return;
      at->follows = true;
      if (!is_saved_so) {
        auto renamed = std::make_shared<AttachmentFile>(*at->rest);
        renamed->save = save;
        at->rest = std::move(renamed);
      }
    }
    state.settled = nullptr;
  }
  void operator()(const StopCarrying& command) const {
    const auto at = find_carried(state, command.file);
    if (at == state.carried.end()) {
      throw InputError(command.file.string() + " is not attached.");
    }
    if (!at->follows) return;
    if (was_carried(state, command.file)) {
      at->follows = false;
    } else {
      state.carried.erase(at);
    }
    state.settled = nullptr;
  }
  void operator()(const Apply& command) const {
    if (!command.result)
      throw InputError("The result of the step is missing. Apply the step first.");
    commit(state);
    state.steps.push_back(std::make_shared<const Step>(command.step));
    std::visit([this](const auto& result) { take_over(state, result); }, *command.result);
  }
  void operator()(const Revise& command) const {
    if (!command.result)
      throw InputError("The result of the steps is missing. Run the steps first.");
    state = *command.result;
  }
};

// Returns whether the command may change an input of the mirrored edit: the surface, the selection
// or the parameters. Returns false for `Revise`, because its state contains the new mirrored edit.
bool changes_choice(const Command& command) {
  return !is_one_of<MoveHandle, MoveHandles, Settle, CarryAlong, StopCarrying, Revise>(command);
}

std::string capitalized(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string name_of(const Part& part) {
  if (part.role == Part::Role::roi) return "region";
  if (part.role == Part::Role::belt) return "fixed border";
  return "handle " + std::to_string(part.handle + 1);
}

// Returns the name of a region's form, with one overload per form.
struct FormName {
  std::string operator()(const AllVertices&) const { return "all vertices"; }
  std::string operator()(const ListedVertices& list) const {
    return list.vertices.empty() ? "none" : std::to_string(list.vertices.size()) + " vertices";
  }
  std::string operator()(const GeodesicDisk&) const { return "disk"; }
  std::string operator()(const Box&) const { return "box"; }
  std::string operator()(const LoopRegion&) const { return "loop"; }
  std::string operator()(const UnionRegion&) const { return "union"; }
  std::string operator()(const DifferenceRegion&) const { return "difference"; }
  std::string operator()(const DiskInRegion&) const { return "disk in a region"; }
};

std::string with_number(const char* format, double number) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, number);
  return text.data();
}

// Returns the name of a command, with one overload per command.
struct CommandDescriber {
  std::string operator()(const Choose& command) const {
    return capitalized(name_of(command.part)) + ": " + std::visit(FormName{}, command.region.form);
  }
  std::string operator()(const Paint& command) const {
    const char* verb = command.removed.empty() ? "Paint "
                       : command.added.empty() ? "Erase "
                                               : "Change ";
    return verb + name_of(command.part);
  }
  std::string operator()(const EnlargeRoi&) const { return "Enlarge region"; }
  std::string operator()(const Grab&) const { return "Grab"; }
  std::string operator()(const SetFalloff& command) const {
    const Falloff& falloff = command.falloff;
    const std::string of = "Handle " + std::to_string(command.handle + 1);
    if (!falloff.field.empty()) return of + ": painted weights";
    if (falloff.transition) return of + with_number(": falloff %.4g", falloff.transition->width);
    if (falloff.weight) return of + with_number(": weight %.4g", *falloff.weight);
    return of + ": held exactly";
  }
  std::string operator()(const RemoveHandle& command) const {
    return "Remove handle " + std::to_string(command.handle + 1);
  }
  std::string operator()(const SetBeltWidth& command) const {
    return with_number("Fixed border: %.3g%%", 100.0 * command.fraction);
  }
  std::string operator()(const SetMirror& command) const {
    return command.plane ? "Mirror on" : "Mirror off";
  }
  std::string operator()(const SetStiffness& command) const {
    return command.parts.empty() ? "Remove stiffness" : "Paint stiffness";
  }
  std::string operator()(const MoveHandle& command) const {
    const double degrees = turn_of(command.to.move).degrees;
    return "Move handle " + std::to_string(command.handle + 1) +
           (degrees == 0.0 ? "" : with_number(", rotate %.4g°", degrees));
  }
  std::string operator()(const MoveHandles&) const { return "Move handles"; }
  std::string operator()(const Settle&) const { return "Refine"; }
  std::string operator()(const Commit&) const { return "Apply edit"; }
  std::string operator()(const NewEdit&) const { return "New edit"; }
  std::string operator()(const SetParameters&) const { return "Solver settings"; }
  std::string operator()(const CarryAlong& command) const {
    return "Attach " + command.file->file().filename().string();
  }
  std::string operator()(const StopCarrying& command) const {
    return "Detach " + command.file.filename().string();
  }
  std::string operator()(const Apply& command) const { return describe(command.step); }
  std::string operator()(const Revise& command) const { return "Edit: " + describe(command.step); }
};

}  // namespace

AppState apply(AppState state, const Command& command) {
  if (!changes_choice(command)) {
    std::visit(Applier{state}, command);
    return state;
  }
  // Renewing the mirrored edit takes up to a second, so renew it only if its inputs have changed.
  const AppState before = state;
  std::visit(Applier{state}, command);
  const bool same = before.mirrored && surface_of(state) == surface_of(before) &&
                    state.selection == before.selection && state.parameters == before.parameters;
  if (!same) renew_mirror(state);
  return state;
}

std::string describe(const Command& command) {
  return std::visit(CommandDescriber{}, command);
}

}  // namespace lapwing::viewer
