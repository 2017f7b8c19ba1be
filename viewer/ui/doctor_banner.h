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

/// What a person wants of the banner that the viewer has to do.
enum class BannerWish {
  look_at_places,  ///< frame `places`
  look_back,       ///< as it was before that
  keep_repair,     ///< ask where to, and open it from there
  open_another,
};

/// What the doctor found in the mesh that was opened, over the picture: which vertices are meant,
/// and what a repair would come to, shown in place of the mesh before anything is kept. A recipe
/// begins with a file, so that a repair that is kept is a file of its own. For a mesh in which
/// there is nothing to see it says so instead.
class DoctorBanner {
 public:
  /// `report`, of `mesh`, lists all places. `wake` is called, on another thread, when a repair is
  /// there.
  DoctorBanner(std::string name, std::shared_ptr<const Mesh> mesh, CheckReport report,
               std::function<void()> wake);

  /// Whether there is nothing to see or to edit.
  bool is_empty() const { return report_.find(DefectKind::no_faces) != nullptr; }

  /// Once a frame, before `draw`: takes what the worker has, and lets go of the picture what an
  /// edit, or `others_preview`, shows instead.
  void update(Editor& editor, bool others_preview);
  /// Lays it out with its upper left corner at `corner`, at most so wide; below `free_height` where
  /// there is nothing to see. Changes what `editor` shows.
  std::optional<BannerWish> draw(Editor& editor, const Eigen::Vector2d& corner,
                                 const Eigen::Vector2d& free_size);
  /// How much of the picture's height it took in the last frame, in ImGui's units.
  double height() const { return height_; }

  /// Whether the picture shows which vertices are meant.
  bool marks() const { return state_ == State::marking; }
  /// Whether the picture shows something else than the edit, marks or a repair.
  bool has_picture() const { return marks() || state_ == State::previewing; }
  std::span<const Index> places() const { return places_; }
  /// From where they show (side_of).
  const std::optional<Eigen::Vector3d>& side() const { return side_; }
  /// The mesh to keep; null unless it is previewed.
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
