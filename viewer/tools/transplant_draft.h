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

/// A part to place on a surface, and how a step names it.
struct TransplantPart {
  std::filesystem::path file;        ///< absolute; empty: the surface itself
  std::optional<RegionSpec> region;  ///< the region to cut from it
  std::optional<std::size_t> loop_number;
  Mesh mesh;                          ///< in the coordinates of its file
  std::vector<Eigen::Vector3d> loop;  ///< points of `mesh` in order, the surface on the left
};

/// Reads a part, with the loop that its folder names. Throws what `read_part` throws.
TransplantPart read_transplant_part(const std::filesystem::path& file);

/// A part that is being placed on a surface: its placement and how it will be joined.
struct TransplantDraft {
  std::shared_ptr<const TransplantPart> part;               ///< null: no part
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();  ///< of the part's mesh
  bool stands = false;                                      ///< whether it has been placed
  double hole_share = 1.15;  ///< radius of the hole's disk, in radii of the part's loop
  std::optional<RegionSpec> chosen_hole;  ///< replaces the disk
  TransplantParameters parameters;

  /// Moves the part to a point by the smallest rotation, so that it follows a path without
  /// spinning.
  void stand_at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);
  /// Turn the part about its normal, or scale it about the centre of its loop. Do nothing before it
  /// stands.
  void turn_by(double degrees);
  void scale_by(double factor);

  /// Returns the frame of the part's loop as placed.
  LoopFrame frame() const;
  /// Returns the region to cut from the surface: the chosen one, or else the largest disk around
  /// the part's loop.
  RegionSpec hole() const;
  /// Returns the step, whose replay gives the same placement bit for bit.
  TransplantStep step() const;
};

/// Returns a draft of a part that has not been placed. It is scaled only if its size is out of
/// proportion to a surface of this diagonal.
TransplantDraft draft_with(std::shared_ptr<const TransplantPart> part, double diagonal);

/// Returns the draft of an earlier step. The step names files by absolute paths; `host` is the
/// state before it. Throws what `cut_hole` and `place_part` throw.
TransplantDraft taken_up(const TransplantStep& step, const AppState& host);

/// Returns a weighted mean of the outward normals of the triangles within the geodesic distance
/// `radius` of `point`. Nearer triangles have larger weights. The mean is used because small detail
/// of the surface would tilt a placed part. If the mean is zero, returns the normal of the triangle
/// that contains the point.
Eigen::Vector3d normal_around(const SurfacePoint& point, double radius, const Topology& topology,
                              const Positions& positions);

}  // namespace lapwing::viewer
