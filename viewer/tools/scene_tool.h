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

/// Determines the meaning of the key R: rotate as in Blender, or scale as in Maya.
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

/// `place` is a point on the surface that projects to `pixel`. Returns whether another part of the
/// surface hides it. That part must be nearer to the camera by more than a tolerance, so that the
/// tip that a dragged pin forms does not hide the pin.
bool is_hidden(const Eigen::Vector3d& place, const Eigen::Vector2d& pixel, const ToolScene& scene);

/// The response of a tool to one event.
struct ToolAnswer {
  bool taken = false;                     ///< whether the tool has handled the event
  std::optional<Command> command = {};    ///< to perform
  std::string message = {};               ///< for the user, if something failed
  std::optional<std::size_t> holds = {};  ///< handle to select after the command
  bool drags_held = false;                ///< drag this handle until the button is released
  bool resizes = false;                   ///< the command only resizes the last choice

  static ToolAnswer passed_on() { return {}; }
  static ToolAnswer only_taken() { return {.taken = true}; }
};

/// A grip on the rim of a disk: dragging it resizes the disk.
struct RimGrip {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;  ///< unit normal of the surface

  /// Returns whether the surface at the grip faces the camera. A nearer part may still hide it.
  bool faces_eye(const Projection& projection) const {
    return normal.dot(projection.toward_eye(position)) > 0.0;
  }
};

/// The marks that a tool draws over the surface.
struct ToolMarks {
  std::vector<Index> line = {};  ///< the vertices of a polyline
  bool line_is_done = false;
  std::vector<Index> dots = {};
  std::vector<RimGrip> grips = {};            ///< the grips that resize a disk
  std::optional<std::size_t> grip = {};       ///< index in `grips` of the grip under the cursor
  std::vector<Eigen::Vector2d> outline = {};  ///< a closed polyline, in pixels
  double brush_pt = 0.0;                      ///< radius of the brush circle at the cursor
};

/// Determines what the left mouse button does on the surface. The tools are those of
/// editing/tool_table.h and those that panels lend to the editor.
class SceneTool {
 public:
  virtual ~SceneTool() = default;

  virtual ToolAnswer handle(const InputEvent& event, const ToolScene& scene) = 0;
  /// Returns whether a stroke or drag is in progress, which no other tool may interrupt.
  virtual bool is_dragging() const { return false; }
  /// Whether the tool works on its own preview, even if its triangles are not those of the state.
  virtual bool draws_preview() const { return false; }
  /// Returns what to do next to choose `part` of `state`.
  virtual const char* hint(const AppState& state, const Part& part) const = 0;

  /// Return the vertices of the current stroke, and whether it erases them.
  virtual VertexSet live() const { return {}; }
  virtual bool erases() const { return false; }
  /// Returns how many vertices would be chosen, instead of `chosen`, if the stroke ended now.
  virtual std::size_t count_with(const VertexSet& chosen) const { return chosen.size(); }
  /// Returns whether the user may still change the last selection, so that it is not yet final.
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
