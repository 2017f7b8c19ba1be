#pragma once

#include <span>
#include <string>

#include "lapwing/region/boundary_loops.h"

namespace lapwing::cli {

/// Returns text such as "63 vertices from vertex 12, 1.234 long".
std::string loop_text(const BoundaryLoop& loop, std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing::cli
