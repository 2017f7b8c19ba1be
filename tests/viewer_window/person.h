#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/mesh/mesh.h"
#include "lapwing/render/camera.h"
#include "state/draft.h"
#include "tools/gizmo.h"
#include "viewer_window/desktop.h"

namespace lapwing::test {

/// Edits a mesh in the window with the mouse and the keys alone. What came of it is read from the
/// journal, which has every step on the disk as soon as it is done.
class Person {
 public:
  using Vector2d = Eigen::Vector2d;
  using Vector3d = Eigen::Vector3d;

  /// `folder` holds the mesh, the journals and what the viewer says.
  Person(const Desktop& desktop, std::filesystem::path folder);

  /// Starts the viewer; waits until the mesh is on the screen.
  void open(const std::filesystem::path& mesh, const std::vector<std::string>& flags = {});
  /// Starts it without a mesh.
  void start();
  void kill();
  int quit();
  /// Quits an edit that is not saved.
  int discard_and_quit();
  /// Presses keys that open a dialog; waits until it is there.
  void open_dialog(const std::string& names) const;
  /// The exit code of a viewer that is about to quit.
  int wait();
  bool waits_for_window();
  std::string errors() const;

  /// Hides the panels and looks from a side at all of `positions`: then the person knows where
  /// everything shows.
  void look_from(View view, const Positions& positions);
  /// The same where the panels are hidden already and something covers that share of the window at
  /// its left.
  void look_again_from(View view, const Positions& positions, double covered);
  viewer::Projection projection() const;
  Vector2d pixel_of(const Vector3d& point) const;

  void keys(const std::string& names) const;
  void type(const std::string& text) const;
  void move_to(const Vector2d& pixel) const;
  void click(const Vector2d& pixel) const;
  void scroll(const Vector2d& pixel, int notches, const std::string& held = "") const;
  /// Presses the left button at the first pixel and lets go at the last; `held` is a key.
  void drag(const std::vector<Vector2d>& pixels, const std::string& held = "") const;
  /// Presses the button at one point of the mesh and releases it at another.
  void drag_between(const Vector3d& from, const Vector3d& to) const;
  /// Takes the disk tool and drags a disk from its centre to its rim.
  void drag_disk(const Vector3d& center, const Vector3d& rim) const;
  /// Drags without releasing the button. `let_go` releases it.
  void hold(const std::vector<Vector2d>& pixels) const;
  void let_go() const;

  /// Returns the edit in the journal of the running viewer, or nothing before the first step.
  std::optional<viewer::Draft> draft() const;
  /// Waits until the draft in the journal satisfies `wanted`. Returns whether it does.
  bool eventually_is(const std::function<bool(const viewer::Draft&)>& wanted) const;
  /// Where the viewer keeps parts.
  std::filesystem::path parts() const { return folder_ / "data" / "lapwing" / "parts"; }
  std::filesystem::path journals() const { return folder_ / "cache" / "lapwing"; }

 private:
  const Desktop& desktop_;
  std::filesystem::path folder_;
  std::unique_ptr<Process> viewer_;
  Camera camera_;
};

/// The middle of a part of a gizmo as it shows.
Eigen::Vector2d middle_of(const viewer::Gizmo& gizmo, viewer::GizmoPart part,
                          const viewer::Projection& projection);

}  // namespace lapwing::test
