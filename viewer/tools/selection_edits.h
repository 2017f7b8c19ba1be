#pragma once

#include <optional>

#include "state/command.h"

namespace lapwing::viewer {

/// Return the region of `part` and its vertices. Both are empty if `part` is a handle that the user
/// has not chosen yet.
const ChosenRegion& region_of(const EditSelection& selection, const Part& part);
const VertexSet& vertices_of(const EditSelection& selection, const Part& part);

/// Returns the command that adds `vertices` to the part, or removes them. A handle or belt gains
/// only vertices in the ROI, if there is one, and outside other handles. A handle gains none from a
/// belt chosen by hand. Nullopt if nothing would change.
std::optional<Command> paint(const AppState& state, const Part& part, const VertexSet& vertices,
                             bool erase);

/// Return the commands that add the ring neighbours of the part, remove its outermost vertices, add
/// all that it may hold, or invert it. Nullopt if nothing would change.
std::optional<Command> grow(const AppState& state, const Part& part);
std::optional<Command> shrink(const AppState& state, const Part& part);
std::optional<Command> choose_all(const AppState& state, const Part& part);
std::optional<Command> invert(const AppState& state, const Part& part);

/// Returns the command that empties the part: it removes a handle, or makes a belt chosen by hand
/// follow its width again. Nullopt if nothing would change.
std::optional<Command> clear(const AppState& state, const Part& part);

}  // namespace lapwing::viewer
