#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "state/command.h"
#include "tools/input.h"
#include "tools/projection.h"

namespace lapwing::viewer {

/// Decides what the key R does. It rotates in Blender and scales in Maya.
enum class GizmoKeys { blender, maya };

/// The scene that a tool works on.
struct ToolScene {
  const AppState& state;
  std::span<const Eigen::Vector3d> positions;  ///< of the visible surface
  const Projection& projection;
  std::function<std::optional<SurfacePoint>(const Eigen::Vector2d& pixel)> pick = {};
  /// Whether the surface does not hide a vertex (SeenVertices). If empty, all are visible.
  std::function<bool(Index vertex)> is_visible = {};
  Part part = {};          ///< what is being chosen
  std::size_t handle = 0;  ///< index of the handle to move
  GizmoKeys keys = GizmoKeys::blender;
  /// Picks like `pick`, but only the part of the surface that the edit leaves in place.
  std::function<std::optional<SurfacePoint>(const Eigen::Vector2d& pixel)> pick_still = {};
};

/// Returns whether the surface hides `place`, a point on the surface that projects to `pixel`. The
/// surface must be nearer to the eye by more than the tip that a pin pulls out.
bool is_hidden(const Eigen::Vector3d& place, const Eigen::Vector2d& pixel, const ToolScene& scene);

/// The response of a tool to one event.
struct ToolAnswer {
  bool taken = false;                     ///< no one else should handle the event
  std::optional<Command> command = {};    ///< to perform
  std::string message = {};               ///< for the user, if something failed
  std::optional<std::size_t> holds = {};  ///< handle to select after the command
  bool drags_held = false;                ///< drag it in the view plane until the button goes up
  bool resizes = false;                   ///< the command only resizes the last choice

  static ToolAnswer passed_on() { return {}; }
  static ToolAnswer only_taken() { return {.taken = true}; }
};

/// A grip on the rim of a disk: dragging it resizes the disk.
struct RimGrip {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;  ///< unit normal of the surface

  /// Whether the surface faces the eye at the grip. Something nearer may still hide it.
  bool faces_eye(const Projection& projection) const {
    return normal.dot(projection.toward_eye(position)) > 0.0;
  }
};

/// The marks that a tool draws over the surface.
struct ToolMarks {
  std::vector<Index> line = {};  ///< the vertices of a drawn line
  bool line_is_done = false;
  std::vector<Index> dots = {};
  std::vector<RimGrip> grips = {};            ///< points that the user can drag
  std::optional<std::size_t> grip = {};       ///< index of the grip under the cursor
  std::vector<Eigen::Vector2d> outline = {};  ///< a closed line, in pixels
  double brush_pt = 0.0;                      ///< radius of a circle around the cursor
};

/// What the left button does on the surface. It is one of the window's tools
/// (editing/tool_table.h), or one that a panel lends to the editor.
class SceneTool {
 public:
  virtual ~SceneTool() = default;

  virtual ToolAnswer handle(const InputEvent& event, const ToolScene& scene) = 0;
  /// Whether a stroke is under way, which nothing else may interrupt.
  virtual bool is_dragging() const { return false; }
  /// Whether the tool works on its own preview, even if its triangles are not those of the state.
  virtual bool draws_preview() const { return false; }
  /// Returns what to do next to choose `part` of `state`.
  virtual const char* hint(const AppState& state, const Part& part) const = 0;

  /// The vertices of the stroke under way, and whether it erases them.
  virtual VertexSet live() const { return {}; }
  virtual bool erases() const { return false; }
  /// Returns how many vertices would be chosen, instead of `chosen`, if the stroke ended now.
  virtual std::size_t count_with(const VertexSet& chosen) const { return chosen.size(); }
  /// Whether the last choice may still change, so that nothing else should follow yet.
  virtual bool may_change_choice() const { return false; }

  virtual ToolMarks marks() const { return {}; }
  /// Whether the marks follow the cursor.
  virtual bool follows_cursor() const { return false; }

 protected:
  /// Returns the hint for the role of `part`.
  static const char* of_part(const Part& part, const char* roi, const char* belt,
                             const char* handle) {
    return part.role == Part::Role::roi ? roi : part.role == Part::Role::belt ? belt : handle;
  }
};

}  // namespace lapwing::viewer
