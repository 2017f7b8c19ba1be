#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/region/targets.h"
#include "lapwing/wrap/wrap.h"

namespace lapwing {

struct TransferRequest {
  /// For each vertex of the target, its counterpart on the source at rest, or `nowhere()`.
  std::vector<SurfacePoint> counterparts = {};
  /// The position of each vertex of the target on the source, such as `Wrapped::positions`. If
  /// `counterparts` is empty, `counterparts_on` finds the counterparts of these positions. If both
  /// lists are empty, vertices with the same number correspond, provided that the meshes have the
  /// same faces and there are no landmarks. Otherwise `wrap` finds the counterparts.
  Positions on_source = {};
  /// Points of the target and their positions on the source, for `wrap`.
  TargetSpec landmarks = {.where = "landmarks"};
  bool aligned = false;  ///< `WrapRequest::aligned`
  /// Vertices of the target that do not move, such as feet. Without them, the target moves on
  /// average as the source does.
  std::optional<RegionSpec> held = {};
};

/// Compares the target's pose with its rest pose, without loose components. The fields have the
/// same meaning as in `Certificate`.
struct TransferReport {
  double largest_rotation_degrees = 0.0;
  std::size_t flipped_triangles = 0;
  double edge_stretch = 0.0;
  double inside_out_share = 0.0;
};

struct Transferred {
  Positions positions;  ///< of the target's vertices
  TransferReport report;
};

/// Throws InputError, naming `where`, unless there is one finite position per vertex of the source.
void require_pose(const Mesh& source, std::span<const Eigen::Vector3d> posed,
                  const std::string& where);

/// Transfers poses of a source mesh to a target mesh (Sumner and Popovic 2004).
///
/// Each triangle of the source has a linear map from rest to pose. A triangle of the target gets
/// the map at its counterpart (`PoseMaps`). The pose of the target is the one whose edges fit these
/// maps best (`TargetGraph`). The similarity transformation that fits the counterparts to the
/// target at rest maps the poses into the frame of the target. Therefore the meshes may have
/// different positions, orientations and sizes, but their rest poses should be similar.
///
/// Parts of a component without counterparts get maps that interpolate the others harmonically.
/// Components without any counterpart move rigidly with the nearest surface (`LooseParts`).
/// Vertices without triangles do not move. Seams of both meshes are joined.
///
/// The construction prepares everything that does not depend on the pose, in O(n log n) plus the
/// time of `wrap`. Each pose then takes one solve with the factor of an n x n matrix. Threads may
/// share an object. Results are bitwise independent of the number of threads.
class TransferSolver {
 public:
  /// Copies the meshes' data. Throws InputError if a mesh has no surface or a position that is not
  /// finite, or if the counterparts do not fit the meshes. Throws it also if fewer than three
  /// vertices have a counterpart, or if `held` contains no vertex that can be solved. Also throws
  /// the errors of `resolve` and `wrap`, and Cancelled. Reports the stages "align" and "wrap" if it
  /// wraps, and then "prepare".
  TransferSolver(const Mesh& source, const Mesh& target, const TransferRequest& request,
                 Kernels& kernels, const Progress& progress = {});
  TransferSolver(TransferSolver&&) noexcept;
  TransferSolver& operator=(TransferSolver&&) noexcept;
  ~TransferSolver();

  /// Returns the target in a pose of the source. Throws the errors of `require_pose`, and
  /// Cancelled.
  Transferred solve(std::span<const Eigen::Vector3d> posed,
                    const std::string& where = "pose") const;

  const std::vector<SurfacePoint>& counterparts() const;
  /// The fraction of the target's area that has no counterpart.
  double unmatched_area() const;
  /// The report of `wrap`, if it found the counterparts.
  const std::optional<WrapReport>& wrap_report() const;
  /// Reasons why the results may be wrong.
  const std::vector<std::string>& warnings() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lapwing
