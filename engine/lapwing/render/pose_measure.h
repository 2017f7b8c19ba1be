#pragma once

#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// How a pose differs from its rest pose, as one number per vertex that a picture can show.
enum class PoseMeasure {
  displacement,  ///< how far the vertex has moved, in mesh units
  rotation,      ///< how far its ring has turned, in degrees
  detail,        ///< how far its uniform Laplacian is from the rest one turned with its ring
  stretch,       ///< how much its ring's edges have changed their lengths
};

/// Every measure, in the order of the enumeration.
std::span<const PoseMeasure> all_pose_measures();

/// Returns "displacement", "rotation", "detail" or "stretch".
std::string_view name_of(PoseMeasure measure);

/// Returns the legend's title with the unit, in one or two lines.
std::string_view legend_title(PoseMeasure measure);

/// Returns one nonnegative number per vertex of the mesh, or NaN (no colour) if the vertex and its
/// whole ring moved by at most 1e-5 of the largest displacement. `rest` and `current` have one
/// position per vertex. Linear time.
std::vector<float> measure_pose(PoseMeasure measure, const Topology& topology,
                                std::span<const Eigen::Vector3d> rest,
                                std::span<const Eigen::Vector3d> current);

}  // namespace lapwing
