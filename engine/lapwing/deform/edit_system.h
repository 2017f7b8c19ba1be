#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/base/progress.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/deform_options.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/laplacian/laplacian_system.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// One edit made ready: what its preview and its exact preparation share. Not changed after
/// construction, so both may use it from threads of their own, the n x n system excepted.
struct EditSystem {
  /// Stages "pattern", "order" and, with the n x n system, "laplacian". Throws what Deformer does.
  EditSystem(std::span<const Eigen::Vector3d> rest_positions, const Topology& mesh_topology,
             EditRegion edit_region, const DeformOptions& deform_options, bool with_laplacian,
             const Progress& progress);

  Positions rest;
  const Topology& topology;
  EditRegion region;
  DeformOptions options;
  StageTimings timings;
  std::vector<HandleFrame> frames;  ///< per handle
  Constraints constraints;
  std::unique_ptr<SystemPattern> pattern;
  std::unique_ptr<LaplacianSystem> laplacian;  ///< or null
  /// The vertices that any motion can displace: all of the region but loose vertices outside the
  /// handles and, with hard constraints, the belt.
  std::vector<Index> moving;

  std::size_t column_count() const { return kMotionParameters * region.handles.size(); }

  /// The column_count() parameters of one motion per handle. Throws InputError for another number.
  void set_parameters(std::span<const Eigen::Affine3d> motions, std::span<double> parameters) const;

  /// What the handles' motions ask for, over the whole mesh; 0 off the handles.
  std::vector<Eigen::Vector3d> wanted_displacement(std::span<const double> parameters) const;
};

}  // namespace lapwing
