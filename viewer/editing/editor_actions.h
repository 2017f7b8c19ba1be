#pragma once

#include <functional>
#include <optional>

#include "editing/wrap_tool.h"
#include "navigation/keymap.h"

namespace lapwing::viewer {

/// Carries out a key's action on the edit. Returns false for actions of the camera, files and
/// panels.
bool perform_on(Editor& editor, Action action);
/// The same for a coat or mix in progress.
bool perform_on(DetailTransferTool& desk, Editor& editor, Action action);
/// Like the function above, for a wrap in progress. Undoes changes of its landmarks first.
bool perform_on(WrapTool& wrap, Editor& editor, Action action);

/// Makes the result the rest shape and clears the selection, once the last edit has settled.
void new_edit(Editor& editor);
/// Calls `change` (for example `grow`) with the active part, and performs the returned command.
using PartChange = std::function<std::optional<Command>(const AppState&, const Part&)>;
void change_part(Editor& editor, const PartChange& change);
/// Adds all vertices to the part that the active tool chooses. If the tool chooses no part, adds
/// them to the ROI. After the ROI, the user chooses the handle.
void choose_all(Editor& editor);
/// Finds the symmetry plane of the surface and turns mirroring on in this plane. Reports how far
/// the surface is from its mirror image.
void mirror_by_shape(Editor& editor);

/// Returns whether handles have vertices outside the ROI.
bool handles_leave_roi(const EditSelection& selection);
/// Adds the handle vertices outside the ROI, and some rings of neighbours, to the ROI. If there are
/// none, adds a margin of half as many vertices as the ROI has. The handles keep their moves.
void enlarge_roi(Editor& editor);
/// Carries out the advice of a warning.
void carry_out(Editor& editor, Remedy remedy);

}  // namespace lapwing::viewer
