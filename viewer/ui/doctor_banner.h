#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "editing/editor.h"
#include "lapwing/doctor/check.h"
#include "work/job.h"
#include "work/mesh_repair.h"

namespace lapwing::viewer {

/// Requests from the banner to the viewer.
enum class BannerWish {
  look_at_places,  ///< frame `places`
  look_back,       ///< restore the view before that
  keep_repair,     ///< ask for a path, save and open the file
  open_another,
};

/// Draws a banner over the 3D view with the defects that the mesh doctor found in the opened mesh.
/// Marks the faulty vertices and previews a repair. If the user accepts a repair, the repaired mesh
/// is saved to a new file, because a recipe must start from a file.
class DoctorBanner {
 public:
  /// `report` lists all places in `mesh`. `wake` is called on another thread when a repair is
  /// ready.
  DoctorBanner(std::string name, std::shared_ptr<const Mesh> mesh, CheckReport report,
               std::function<void()> wake);

  /// Returns whether the mesh has no faces. The banner then tells the user that the view is empty.
  bool is_empty() const { return report_.find(DefectKind::no_faces) != nullptr; }

  /// Call this once per frame, before `draw`. Shows the preview of a finished repair. Ends this
  /// preview if the user edits the mesh or `others_preview` is true.
  void update(Editor& editor, bool others_preview);
  /// Draws the banner at `corner`, at most `free_size` large. For an empty mesh it is centred in
  /// that area. May change what `editor` shows.
  std::optional<BannerWish> draw(Editor& editor, const Eigen::Vector2d& corner,
                                 const Eigen::Vector2d& free_size);
  /// Returns the banner's height in the last frame, in ImGui's units.
  double height() const { return height_; }

  /// Returns whether the view marks the faulty vertices.
  bool marks() const { return state_ == State::marking; }
  /// Returns whether the view shows these marks or a repair instead of the edit.
  bool has_picture() const { return marks() || state_ == State::previewing; }
  std::span<const Index> places() const { return places_; }
  /// Returns the direction from which `places` are visible (side_of).
  const std::optional<Eigen::Vector3d>& side() const { return side_; }
  /// Returns the repaired mesh while it is previewed, else null.
  std::shared_ptr<const Mesh> repair() const;

 private:
  enum class State { offering, marking, repairing, previewing, ignored };

  std::optional<BannerWish> draw_offer(Editor& editor);
  void draw_repairing();
  std::optional<BannerWish> draw_preview(Editor& editor);
  std::optional<BannerWish> draw_empty();
  void mark(Editor& editor);
  void show_as_before(Editor& editor);

  std::string name_;
  std::shared_ptr<const Mesh> mesh_;
  CheckReport report_;
  std::string problems_;  // a sentence
  std::string hindrance_;
  State state_ = State::offering;
  std::vector<Index> places_;
  std::optional<Eigen::Vector3d> side_;
  Job<RepairedMesh> job_;
  std::optional<RepairedMesh> repaired_;
  std::string trouble_;  // why it cannot be repaired
  double height_ = 0.0;
};

}  // namespace lapwing::viewer
