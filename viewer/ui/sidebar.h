#pragma once

#include <memory>
#include <optional>

#include "ui/viewport.h"

namespace lapwing::viewer {

/// Draws the panels at the left: tabs by task, the result of the task, and the history, each in a
/// fixed place. Sets the sizes of the panels in the viewport.
class Sidebar {
 public:
  Sidebar(const std::unique_ptr<Document>& document, Viewport& viewport, Preferences& preferences,
          DisplayChoices& display)
      : document_(document), viewport_(viewport), preferences_(preferences), display_(display) {}

  /// What the user has requested from other parts of the window.
  struct Wish {
    std::optional<PathPurpose> path;
    std::optional<Action> action;
  };

  /// Selects the first tab. Call this when a document has been opened.
  void begin() { task_to_show_ = begun_task_ = Task::deform; }
  /// Measures the panels with the font of this frame, which may not exist outside a frame.
  void measure();
  /// Call this once per frame, after the document is updated.
  void update(gpu::Context& context);
  Wish draw();
  void release_device() { part_pictures_.release(); }

 private:
  void draw_edge(float right, float top, float height);
  void follow_task();
  void draw_tabs();
  void draw_task(Task task);
  void draw_mesh_commands();
  void take(const WrapWish& wish);
  void draw_result();

  const std::unique_ptr<Document>& document_;
  Viewport& viewport_;
  Preferences& preferences_;
  DisplayChoices& display_;
  PanelDrafts drafts_;
  PartPictures part_pictures_;        // outlive the document, which a frame may show
  std::optional<Task> task_to_show_;  // the tab to bring to the front
  Task begun_task_ = Task::deform;    // the task that is open
  Wish wish_;                         // of this frame
};

}  // namespace lapwing::viewer
