#pragma once

#include <optional>

#include "state/command.h"

namespace lapwing::viewer {

/// What `part` holds; nothing for a handle that is yet to be made.
const VertexSet& vertices_of(const EditSelection& selection, const Part& part);

/// The part gains `vertices`, or loses them. A handle or belt gains only what may be its: in the
/// ROI where there is one, and in no handle, nor in a belt chosen by hand, that holds it already.
/// Nothing when nothing would change.
std::optional<Command> paint(const AppState& state, const Part& part, const VertexSet& vertices,
                             bool erase);

/// The part with its ring neighbours, without its outermost vertices, all that it may hold, and
/// what it did not hold of that. Nothing when nothing would change.
std::optional<Command> grow(const AppState& state, const Part& part);
std::optional<Command> shrink(const AppState& state, const Part& part);
std::optional<Command> choose_all(const AppState& state, const Part& part);
std::optional<Command> invert(const AppState& state, const Part& part);

/// The part without any vertex: a handle goes, a belt chosen by hand goes by its width again.
/// Nothing when nothing would change.
std::optional<Command> clear(const AppState& state, const Part& part);

}  // namespace lapwing::viewer
