#pragma once

#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// A scalar per vertex that measures the difference between a pose and its rest pose.
enum class PoseMeasure {
  displacement,  ///< distance that the vertex has moved, in mesh units
  rotation,      ///< rotation angle of its one-ring, in degrees
  detail,        ///< relative change of its uniform Laplacian in the frame of its one-ring
  stretch,       ///< relative change of the lengths of its edges
};

std::span<const PoseMeasure> all_pose_measures();

/// Returns "displacement", "rotation", "detail" or "stretch".
std::string_view name_of(PoseMeasure measure);

/// Returns the legend's title with the unit, in one or two lines.
std::string_view legend_title(PoseMeasure measure);

/// Returns one nonnegative number per vertex. It is NaN (no colour) if the vertex and all its
/// neighbours moved by at most 1e-5 of the largest displacement. `rest` and `current` have one
/// position per vertex. Linear time.
std::vector<float> measure_pose(PoseMeasure measure, const Topology& topology,
                                std::span<const Eigen::Vector3d> rest,
                                std::span<const Eigen::Vector3d> current);

}  // namespace lapwing
