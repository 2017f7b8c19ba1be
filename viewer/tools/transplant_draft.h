#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/recipe/recipe.h"
#include "lapwing/transplant/loop_curve.h"
#include "state/app_state.h"
#include "tools/projection.h"

namespace lapwing::viewer {

/// A part to be put on a surface, and what a step calls it.
struct TransplantPart {
  std::filesystem::path file;        ///< absolute; empty: the surface itself
  std::optional<RegionSpec> region;  ///< what is cut from it
  std::optional<std::size_t> loop_number;
  Mesh mesh;                          ///< where its file has it
  std::vector<Eigen::Vector3d> loop;  ///< of `mesh`, in order, the surface on its left
};

/// Reads a part by itself, with the loop that its folder says. Throws what `read_part` does.
TransplantPart read_transplant_part(const std::filesystem::path& file);

/// A part on its way onto a surface: where it stands, and how it is to be sewn on.
struct TransplantDraft {
  std::shared_ptr<const TransplantPart> part;               ///< null: none is in hand
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();  ///< of the part's mesh
  bool stands = false;                                      ///< whether it has been put anywhere
  double hole_share = 1.15;  ///< how large the hole's disk is, in radii of the part's loop
  std::optional<RegionSpec> chosen_hole;  ///< in place of the disk
  TransplantParameters parameters;

  /// Stands it at a point: from where it is by the least turn, so that it follows a path without
  /// spinning.
  void stand_at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);
  /// About its normal, and about the middle of its loop; nothing while it stands nowhere.
  void turn_by(double degrees);
  void scale_by(double factor);

  /// How the part's loop lies where it is.
  LoopFrame frame() const;
  /// What is cut out of the surface: around the part's loop the largest disk, unless it is chosen.
  RegionSpec hole() const;
  /// The same placement to the bit wherever it is replayed.
  TransplantStep step() const;
};

/// A part in hand that nobody has put anywhere. It keeps its size, unless that is out of proportion
/// to a surface of that diagonal.
TransplantDraft draft_with(std::shared_ptr<const TransplantPart> part, double diagonal);

/// A step that names files by absolute paths taken up again; `host` is what it was carried out on.
/// Throws what `cut_hole` and `place_part` do.
TransplantDraft taken_up(const TransplantStep& step, const AppState& host);

/// The outward direction of a surface around `point`: that of the triangles within `radius` along
/// the surface, the nearer the more, so that small detail does not make a part reel. Of its own
/// triangle, where there are no others.
Eigen::Vector3d normal_around(const SurfacePoint& point, double radius, const Topology& topology,
                              const Positions& positions);

}  // namespace lapwing::viewer
